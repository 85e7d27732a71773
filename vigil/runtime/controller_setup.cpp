#include "vigil/runtime/controller_setup.hpp"

#include "vigil/core/dynamics/battery.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/runtime/fault_setup.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

swarm::HealthParameters health_parameters(const Mission& mission) {
  const HealthSection& health = mission.health;
  return {.tracking_timeout_s = health.tracking_timeout_s,
          .link_timeout_s = health.link_timeout_s,
          .battery_reserve = health.battery_reserve,
          .recovery_s = health.recovery_s,
          .landed_height_m = health.landed_height_m,
          .landing_s = mission.simulation.vehicle.landing_s};
}

/// What a full battery is worth, as far as the mission says.
std::optional<double> endurance_s(const Mission& mission) {
  if (mission.health.endurance_s) return mission.health.endurance_s;
  if (!mission.simulation.battery) return std::nullopt;
  if (mission.simulation.battery->endurance_s) return mission.simulation.battery->endurance_s;
  const bool is_outdoor = mission.simulation.vehicle.model == dynamics::VehicleKind::kArduCopter ||
                          mission.simulation.vehicle.model == dynamics::VehicleKind::kPx4;
  return is_outdoor ? dynamics::endurance_s(dynamics::outdoor_battery(), dynamics::kOutdoorHoverPower)
                    : dynamics::endurance_s(dynamics::crazyflie_battery(), dynamics::kCrazyflieHoverPower);
}

swarm::RechargeParameters recharge_parameters(const Mission& mission) {
  swarm::RechargeParameters parameters;
  if (mission.stations.empty()) return parameters;
  parameters.pads = charging_pads(mission);
  parameters.take_off_s = mission.simulation.vehicle.take_off_s;
  parameters.landing_s = mission.simulation.vehicle.landing_s;
  parameters.endurance_s = endurance_s(mission);
  return parameters;
}

/// A vehicle that never flies faster than it is ordered to: none of the recorded autopilots, and nobody in gusts.
bool follows_exactly(const SimulationSection& simulation) {
  const bool is_simple = simulation.vehicle.model == dynamics::VehicleKind::kIdeal ||
                         simulation.vehicle.model == dynamics::VehicleKind::kFirstOrderLag;
  return is_simple && simulation.wind.gust_m_s == 0.0 && simulation.wind.mean_m_s.isZero();
}

}  // namespace

swarm::SwarmParameters swarm_parameters(const Mission& mission, swarm::Intent first_intent) {
  swarm::SwarmParameters parameters;
  parameters.field = monitored_field(mission);
  parameters.drones = mission.drones.size();
  parameters.dt_s = tick_s(mission);
  parameters.basis_max_index = mission.control.basis_max_index;
  parameters.basis_smoothness = mission.control.basis_smoothness;
  parameters.accounting = mission.control.accounting;
  parameters.memory_s = memory_s(mission);
  parameters.controller = mission.control.controller;
  parameters.look_ahead_s = mission.control.look_ahead_s;
  parameters.fade = mission.control.fade;
  parameters.barrier = barrier_parameters(mission);
  parameters.command_delay_s = command_delay_s(mission);
  parameters.observation_delay_s = observation_delay_s(mission);
  parameters.only_active_are_obstacles = mission.safety.obstacles == Obstacles::kActiveOnly;
  parameters.health = health_parameters(mission);
  parameters.faults = fault_parameters(mission);
  parameters.recharge = recharge_parameters(mission);
  parameters.first_intent = first_intent;
  const field::WorldFrame frame = world_frame(mission);
  for (const DroneEntry& drone : mission.drones) parameters.starts.push_back(frame.point_to_field(drone.start_m));
  return parameters;
}

swarm::SwarmParameters swarm_parameters(const Mission& mission, const FlightStart& start) {
  swarm::SwarmParameters parameters = swarm_parameters(mission, start.first_intent);
  if (start.has_real_drones) parameters.faults = real_fault_parameters(mission);
  return parameters;
}

swarm::Intent first_intent(const Mission& mission) {
  return mission.simulation.start == StartState::kFlying ? swarm::Intent::kCover : swarm::Intent::kStayDown;
}

AuditLimits audit_limits(const Mission& mission) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  return {.field = monitored_field(mission),
          .no_fly = importance(mission).no_fly,
          .separation_m = barrier.separation_m,
          .wall_distance_m = barrier.wall_distance_m,
          .no_fly_buffer_m = barrier.no_fly_buffer_m,
          .speed_limit_m_s = barrier.u_max_m_s,
          .follows_exactly = follows_exactly(mission.simulation),
          .landed_height_m = mission.health.landed_height_m};
}

std::shared_ptr<const swarm::CoverageTarget> coverage_target(const Mission& mission, const ergodic::Basis& basis) {
  return coverage_target(mission, basis, field::grid_shape(basis.field(), importance(mission), basis.max_index()));
}

std::shared_ptr<const swarm::CoverageTarget> coverage_target(const Mission& mission, const ergodic::Basis& basis,
                                                             field::GridShape shape) {
  auto target = std::make_shared<swarm::CoverageTarget>();
  target->no_fly = no_fly_edges(mission);
  const field::Importance map = importance(mission);
  if (const auto density = field::rasterise(basis.field(), map, shape)) {
    target->phi_k = ergodic::target_coefficients(basis, *density);
    target->has_targets = true;
  }
  if (const auto density = field::rasterise_protected(basis.field(), map, shape); density && target->has_targets)
    target->protected_k = ergodic::target_coefficients(basis, *density);
  return target;
}

}  // namespace vigil::runtime
