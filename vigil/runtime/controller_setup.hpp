#pragma once

#include <memory>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/cell_cover.hpp"
#include "vigil/runtime/flight_audit.hpp"
#include "vigil/runtime/flight_start.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/parameters.hpp"

namespace vigil::runtime {

/// The controller's parameters for a mission. `first_intent`: what every drone is to do before anyone commands
/// anything.
[[nodiscard]] swarm::SwarmParameters swarm_parameters(const Mission& mission, swarm::Intent first_intent);

/// The same for a flight that begins so: real drones are watched by what their adapter lets pass, not by the world that
/// the mission simulates.
[[nodiscard]] swarm::SwarmParameters swarm_parameters(const Mission& mission, const FlightStart& start);

/// What every drone of the simulated world is to do before anyone commands anything.
[[nodiscard]] swarm::Intent first_intent(const Mission& mission);

/// What counts as a violation.
[[nodiscard]] AuditLimits audit_limits(const Mission& mission);

/// Where the mission says to look, as coefficients of `basis`, with the no-fly edges. Some milliseconds; never in a
/// tick.
[[nodiscard]] std::shared_ptr<const swarm::CoverageTarget> coverage_target(const Mission& mission,
                                                                           const ergodic::Basis& basis);
/// The same from a density of this shape.
[[nodiscard]] std::shared_ptr<const swarm::CoverageTarget> coverage_target(const Mission& mission,
                                                                           const ergodic::Basis& basis,
                                                                           field::GridShape shape);

}  // namespace vigil::runtime
