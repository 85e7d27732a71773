#pragma once

#include <string>
#include <string_view>

#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// The effective mission as YAML: every value that is set, defaults too; optional values only where they are set.
/// Reading it gives the same mission again, bit for bit. Where there is a `drone_grid`, it stands instead of its
/// drones.
[[nodiscard]] std::string mission_yaml(const Mission& mission);

/// A text as YAML on one line: in quotes, where a YAML reader would take it for something else.
[[nodiscard]] std::string text_in_yaml(std::string_view text);

}  // namespace vigil::runtime
