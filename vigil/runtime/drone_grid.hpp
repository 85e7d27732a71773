#pragma once

#include <vector>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_source.hpp"

namespace vigil::runtime {

/// The drones that `mission.drone_grid` asks for, row by row: with spacing_m on a square grid in the middle of the
/// field, else as far apart as the field allows; always wall_distance_m from the field's border and far enough from
/// each other for the barrier. World frame. Same mission, same drones. Refuses, by `source`, a grid that does not fit.
/// Precondition: mission.drone_grid; check_numbers has passed.
[[nodiscard]] std::vector<DroneEntry> drones_on_grid(const Mission& mission, const MissionSource& source);

}  // namespace vigil::runtime
