#pragma once

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_source.hpp"

namespace vigil::runtime {

/// The mission that is written in `source`, as the description (mission_description.hpp) allows it: every key known,
/// every value of its type and in its range, nothing missing. Throws MissionError. Says nothing about how values fit
/// together: that is mission_checks.hpp. `drone_grid` is not turned into drones yet.
[[nodiscard]] Mission read_mission(const MissionSource& source);

}  // namespace vigil::runtime
