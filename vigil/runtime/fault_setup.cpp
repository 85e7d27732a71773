#include "vigil/runtime/fault_setup.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vigil/core/dynamics/failsafe.hpp"
#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

/// The greatest residual of a recording that the model was not fitted to, over its step (docs/vehicle-models.md).
double misfit_share(dynamics::VehicleKind kind) {
  switch (kind) {
    case dynamics::VehicleKind::kCrazyflie:
      return 0.006;
    case dynamics::VehicleKind::kArduCopter:
      return 0.016;
    case dynamics::VehicleKind::kPx4:
      return 0.058;
    case dynamics::VehicleKind::kIdeal:
    case dynamics::VehicleKind::kFirstOrderLag:
      break;
  }
  return 0.0;
}

double packet_period_s(const Mission& mission) {
  const LinkSection& link = mission.simulation.link;
  return link.rate_hz ? std::max(tick_s(mission), 1.0 / *link.rate_hz) : tick_s(mission);
}

/// Between two measurements while nothing is lost.
double measurement_period_s(const Mission& mission) {
  const TrackerSection& tracker = mission.simulation.tracker;
  const double measured_s = tracker.rate_hz ? std::max(tick_s(mission), 1.0 / *tracker.rate_hz) : tick_s(mission);
  return tracker.over_link ? std::max(measured_s, packet_period_s(mission)) : measured_s;
}

// GateParameters' slack_m is k sqrt(2) times the noise; its positions come up to late_s late, and velocities are
// differences of them over 50 ms. A Crazyflie flies 0.88 of what it is told, 0.2 s late (docs/vehicle-models.md).
constexpr double kRealNoiseM = 0.01;
constexpr double kRealVelocityNoise = std::numbers::sqrt2 * kRealNoiseM / 0.05;  // m/s
constexpr double kRealLateS = 0.15;
constexpr double kRealLagS = 0.35;
constexpr double kRealMisfit = 0.12;

swarm::FaultParameters parameters_of(const Mission& mission, const dynamics::FaultProblem& problem) {
  swarm::FaultParameters parameters;
  parameters.watches = true;
  parameters.loop = problem.loop;
  if (mission.safety.vehicle == AssumedVehicle::kSimulated)
    parameters.acceleration_limit_m_s2 = mission.simulation.vehicle.acceleration_limit_m_s2;
  parameters.bounds = dynamics::fault_bounds(problem);
  return parameters;
}

}  // namespace

dynamics::FaultProblem fault_problem(const Mission& mission) {
  const TrackerSection& tracker = mission.simulation.tracker;
  const MarginProblem margins = margin_problem(mission);
  dynamics::FaultProblem problem;
  problem.loop = assumed_vehicle(mission).horizontal;
  problem.u_max_m_s = mission.control.speed_limit_m_s;
  problem.dt_s = tick_s(mission);
  problem.period_s = measurement_period_s(mission);
  problem.jitter_s = tracker.jitter_s + (tracker.over_link ? mission.simulation.link.jitter_s : 0.0);
  problem.noise_m = tracker.noise_m;
  problem.velocity_noise_m_s = tracker.velocity_noise_m_s;
  problem.bias_m = tracker.bias_m;
  problem.bias_time_s = tracker.bias_time_s;
  problem.push_m_s2 = margins.push_m_s2;
  problem.push_time_s = margins.push_time_s;
  // One change of orders may be flown early and the next one late: both err to the same side.
  problem.held_s = longest_burst_s(mission) + 2.0 * margins.unsteady_delay_s;
  problem.packet_period_s = packet_period_s(mission);
  problem.hovers_after_s = dynamics::failsafe_of(assumed_vehicle(mission).kind).hover_after_s;
  problem.lost_share = mission.simulation.link.loss;
  problem.misfit_share = misfit_share(assumed_vehicle(mission).kind);
  return problem;
}

swarm::FaultParameters real_fault_parameters(const Mission& mission) {
  dynamics::FaultProblem problem = fault_problem(mission);
  problem.noise_m = std::max(problem.noise_m, kRealNoiseM);
  problem.velocity_noise_m_s = std::max(problem.velocity_noise_m_s, kRealVelocityNoise);
  problem.held_s += kRealLateS + kRealLagS;
  problem.misfit_share = std::max(problem.misfit_share, kRealMisfit);
  swarm::FaultParameters parameters = parameters_of(mission, problem);
  parameters.bounds.never_repeats = false;  // whether a tracker repeats itself is the adapter's to judge
  return parameters;
}

swarm::FaultParameters fault_parameters(const Mission& mission) {
  return parameters_of(mission, fault_problem(mission));
}

}  // namespace vigil::runtime
