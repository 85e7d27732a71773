#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "vigil/adapters/console/json_reader.hpp"
#include "vigil/runtime/target_edit.hpp"

namespace vigil::console {

/// `kind` and `name`. Throws JsonFault, as all of these.
[[nodiscard]] runtime::TargetName target_name_in(const JsonReader& reader);

/// A list of edits: "edits" of protocol/README.md. Numbers' ranges and names are left to the rules of mission files.
[[nodiscard]] std::vector<runtime::TargetEdit> edits_in(const JsonReader& reader, std::string_view member);

/// Entries with the keys of a mission file.
[[nodiscard]] nlohmann::ordered_json to_json(const runtime::ClusterEntry& entry);
[[nodiscard]] nlohmann::ordered_json to_json(const runtime::AreaEntry& entry);
[[nodiscard]] nlohmann::ordered_json to_json(const runtime::NoFlyEntry& entry);

}  // namespace vigil::console
