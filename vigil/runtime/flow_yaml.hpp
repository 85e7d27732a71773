#pragma once

#include <string>
#include <vector>

#include "vigil/runtime/mission.hpp"

/// Parts of a mission as YAML on one line, for the command line: `--set key=value`. Reading gives the same part again,
/// bit for bit.
namespace vigil::runtime {

[[nodiscard]] std::string in_flow(const std::vector<Vec2>& points);
[[nodiscard]] std::string in_flow(const std::vector<DroneEntry>& drones);
[[nodiscard]] std::string in_flow(const std::vector<EventEntry>& events);

}  // namespace vigil::runtime
