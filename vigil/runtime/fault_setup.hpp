#pragma once

#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/fault.hpp"

namespace vigil::runtime {

/// What is known of a mission's vehicles, tracker, link and wind, as far as faults are told from it.
[[nodiscard]] dynamics::FaultProblem fault_problem(const Mission& mission);

/// What drones are held against.
[[nodiscard]] swarm::FaultParameters fault_parameters(const Mission& mission);

/// What real drones are held against. A mission says nothing of their tracker, their radio and, without safety.vehicle,
/// of themselves: what the adapter to Crazyswarm lets pass is taken for healthy, and a Crazyflie's gain and lag as
/// well.
[[nodiscard]] swarm::FaultParameters real_fault_parameters(const Mission& mission);

}  // namespace vigil::runtime
