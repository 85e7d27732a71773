#include "vigil/runtime/mission_margins.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/core/dynamics/failsafe.hpp"
#include "vigil/core/dynamics/response_bounds.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/parameters.hpp"

namespace vigil::runtime {
namespace {

/// Between two of what comes so often, or every tick.
double period_s(const Mission& mission, const std::optional<double>& rate_hz) {
  return rate_hz ? std::max(tick_s(mission), 1.0 / *rate_hz) : tick_s(mission);
}

/// How much longer a packet's order is flown than for its tick.
double hold_s(const Mission& mission) { return period_s(mission, mission.simulation.link.rate_hz) - tick_s(mission); }

bool is_steady(const Mission& mission) { return mission.simulation.link.jitter_s <= 0.0 && hold_s(mission) <= 0.0; }

double average_delay_s(const Mission& mission) {
  const LinkSection& link = mission.simulation.link;
  return mission.simulation.vehicle.command_delay_s + link.delay_s + 0.5 * link.jitter_s + 0.5 * hold_s(mission) +
         assumed_vehicle(mission).horizontal.response_delay_s;
}

double unsteady_delay_s(const Mission& mission) {
  const double off = std::abs(command_delay_s(mission) - derived_command_delay_s(mission));
  if (is_steady(mission)) return off;
  return off + 0.5 * (mission.simulation.link.jitter_s + hold_s(mission) + tick_s(mission));
}

/// Behind a rejection that follows the wind, a gust of correlation time T leaves T_r / (T + T_r) of its variance.
void add_gusts(const WindSection& wind, MarginProblem& problem) {
  const double both_s = wind.gust_time_s + wind.rejection_time_s;
  problem.push_m_s2 = wind.drag_per_s * wind.gust_m_s * std::sqrt(wind.rejection_time_s / both_s);
  problem.push_time_s = wind.gust_time_s * wind.rejection_time_s / both_s;
}

}  // namespace

dynamics::VehicleModel assumed_vehicle(const Mission& mission) {
  switch (mission.safety.vehicle) {
    case AssumedVehicle::kCrazyflie:
      return dynamics::crazyflie_vehicle();
    case AssumedVehicle::kArduCopter:
      return dynamics::arducopter_vehicle();
    case AssumedVehicle::kPx4:
      return dynamics::px4_vehicle();
    case AssumedVehicle::kSimulated:
      break;
  }
  return vehicle_model(mission);
}

/// Of packets lost, each but the first follows with the probability 1 - 1 / burst_packets.
double longest_burst_s(const Mission& mission) {
  constexpr double kOneIn = 1e6;
  const LinkSection& link = mission.simulation.link;
  if (link.loss <= 0.0) return 0.0;
  const double stays = 1.0 - 1.0 / link.burst_packets;
  const double more = stays > 0.0 ? std::ceil(-std::log(kOneIn) / std::log(stays)) : 0.0;
  return (1.0 + more) * period_s(mission, link.rate_hz);
}

double simulated_command_delay_s(const Mission& mission) { return average_delay_s(mission); }

double derived_command_delay_s(const Mission& mission) {
  const double dt_s = tick_s(mission);
  const double average_s = average_delay_s(mission);
  const double delay_s = is_steady(mission) ? dt_s * std::round(average_s / dt_s) : average_s;
  return std::min(delay_s, swarm::kLongestPredictionS);
}

double derived_observation_delay_s(const Mission& mission) {
  const TrackerSection& tracker = mission.simulation.tracker;
  const LinkSection& link = mission.simulation.link;
  double age_s = tracker.delay_s + tracker.jitter_s + period_s(mission, tracker.rate_hz) - tick_s(mission);
  if (tracker.over_link) age_s += link.delay_s + link.jitter_s + hold_s(mission);
  return std::min(age_s, swarm::kLongestPredictionS);
}

double derived_silence_s(const Mission& mission) {
  const dynamics::VehicleModel vehicle = assumed_vehicle(mission);
  const double hovers_after_s = dynamics::failsafe_of(vehicle.kind).hover_after_s;
  if (!std::isfinite(hovers_after_s)) return longest_burst_s(mission);  // cut off for good, it flies out of any field
  const double u_max = mission.control.speed_limit_m_s;
  return hovers_after_s + dynamics::stop_from(vehicle.horizontal, u_max).distance_m / u_max;
}

MarginProblem margin_problem(const Mission& mission) {
  const SafetySection& safety = mission.safety;
  const TrackerSection& tracker = mission.simulation.tracker;
  MarginProblem problem;
  problem.loop = assumed_vehicle(mission).horizontal;
  if (safety.vehicle == AssumedVehicle::kSimulated)
    problem.acceleration_limit_m_s2 = mission.simulation.vehicle.acceleration_limit_m_s2;
  problem.u_max_m_s = mission.control.speed_limit_m_s;
  problem.dt_s = tick_s(mission);
  problem.separation_m = safety.separation_m;
  problem.given_lag_s = safety.lag_s;
  problem.given_pair_gain = safety.pair_gain;
  problem.given_wall_gain = safety.wall_gain;
  problem.observation_delay_s = observation_delay_s(mission);
  problem.command_delay_s = command_delay_s(mission);
  problem.unsteady_delay_s = unsteady_delay_s(mission);
  problem.noise_m = tracker.noise_m;
  problem.velocity_noise_m_s = tracker.velocity_noise_m_s;
  problem.measurement_period_s = period_s(mission, tracker.rate_hz);
  problem.bias_m = tracker.bias_m;
  problem.silence_s = derived_silence_s(mission);
  problem.swap_s = tracker.swaps_per_h > 0.0 ? tracker.swap_s : 0.0;
  add_gusts(mission.simulation.wind, problem);
  return problem;
}

Margins derived_margins(const Mission& mission) { return derive_margins(margin_problem(mission)); }

}  // namespace vigil::runtime
