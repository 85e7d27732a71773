#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vigil::runtime {

/// What a mission file may say, as a JSON Schema (draft 2020-12) for editors and other programs. It accepts every
/// mission that read_mission accepts; what it cannot say is how values fit together (mission_checks.hpp).
[[nodiscard]] nlohmann::ordered_json mission_schema_json();

}  // namespace vigil::runtime
