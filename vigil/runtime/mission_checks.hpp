#pragma once

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_source.hpp"

/// How the values of a mission fit together, beyond the range of each. Every check throws MissionError by `source`,
/// with the key, the value, what is allowed and what to do.
namespace vigil::runtime {

/// Field, control, safety, health, vehicle: numbers against each other.
void check_numbers(const Mission& mission, const MissionSource& source);
/// The simulated world alone: vehicle, wind, link, tracker. A part of check_numbers.
void check_simulation(const Mission& mission, const MissionSource& source);
/// Targets and no-fly polygons against the field and each other. Precondition: check_numbers has passed.
void check_places(const Mission& mission, const MissionSource& source);
/// Stations against the field, no-fly polygons and each other. Precondition: check_numbers and check_places have
/// passed.
void check_stations(const Mission& mission, const MissionSource& source);
/// Ids and starts. Precondition: check_numbers and check_places have passed; a drone_grid is resolved.
void check_drones(const Mission& mission, const MissionSource& source);
/// Times, names and numbers of targets, in the course of the mission. Precondition: all others have passed.
void check_events(const Mission& mission, const MissionSource& source);

/// How far a point may lie beyond a bound and still be on it: what rounding between the frames may cost. Metres.
[[nodiscard]] double rounding_m(const Mission& mission);

}  // namespace vigil::runtime
