#include "vigil/runtime/predicted_fleet.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {

using swarm::Action;
using swarm::DroneObservation;
using swarm::VehicleMode;

PredictedVehicle predicted_vehicle(const Mission& mission, double lag_s) {
  const VehicleSection& section = mission.simulation.vehicle;
  const bool is_simple =
      section.model == dynamics::VehicleKind::kIdeal || section.model == dynamics::VehicleKind::kFirstOrderLag;
  PredictedVehicle vehicle;
  if (is_simple)
    vehicle.motion = {.lag_s = section.lag_s, .acceleration_limit_m_s2 = section.acceleration_limit_m_s2};
  else
    vehicle.motion = {.lag_s = lag_s, .acceleration_limit_m_s2 = std::nullopt};
  vehicle.gain = is_simple ? 1.0 : dynamics::steady_gain(vehicle_model(mission).horizontal);
  vehicle.altitude_m = section.altitude_m;
  vehicle.take_off_s = section.take_off_s;
  vehicle.landing_s = section.landing_s;
  vehicle.emergency_s = section.emergency_s;
  return vehicle;
}

PredictedFleet::PredictedFleet(const swarm::SwarmState& now, const PredictedVehicle& vehicle)
    : vehicle_(vehicle),
      seen_within_s_(now.parameters().health.tracking_timeout_s),
      heard_within_s_(now.parameters().health.link_timeout_s),
      pads_(now.parameters().recharge.pads) {
  drones_.reserve(now.drones().size());
  for (std::size_t i = 0; i < now.drones().size(); ++i) {
    DroneObservation drone = now.drones()[i].last_good;
    const swarm::Motion motion = now.next_motion(swarm::DroneId(i));
    drone.position = motion.position;
    drone.velocity = motion.velocity;
    if (drone.age_s <= seen_within_s_) drone.age_s = 0.0;
    if (drone.link_age_s <= heard_within_s_) drone.link_age_s = 0.0;
    drones_.push_back(drone);
    rates_per_s_.push_back(now.drones()[i].energy.rate_per_s());
  }
}

void PredictedFleet::obey(DroneObservation& drone, Action action) const noexcept {
  const bool follows_orders = drone.mode == VehicleMode::kFlying || drone.mode == VehicleMode::kTakingOff;
  const bool is_down = drone.mode == VehicleMode::kGrounded;
  if (action == Action::kTakeOff && is_down) drone.mode = VehicleMode::kTakingOff;
  if (action == Action::kLand && follows_orders) drone.mode = VehicleMode::kLanding;
  if (action == Action::kStopMotors && !is_down) drone.mode = VehicleMode::kFalling;
}

void PredictedFleet::climb(DroneObservation& drone, double dt_s) const noexcept {
  const auto go = [&](double altitudes_per_s) {
    const double change_m = altitudes_per_s * vehicle_.altitude_m * dt_s;
    drone.height_m = std::clamp(drone.height_m + change_m, 0.0, std::max(vehicle_.altitude_m, drone.height_m));
  };
  if (drone.mode == VehicleMode::kTakingOff) go(1.0 / vehicle_.take_off_s);
  if (drone.mode == VehicleMode::kLanding) go(-1.0 / vehicle_.landing_s);
  if (drone.mode == VehicleMode::kFalling) go(-1.0 / vehicle_.emergency_s);
  const bool goes_down = drone.mode == VehicleMode::kLanding || drone.mode == VehicleMode::kFalling;
  if (goes_down && drone.height_m <= 0.0) drone.mode = VehicleMode::kGrounded;
  if (drone.mode == VehicleMode::kTakingOff && drone.height_m >= vehicle_.altitude_m) drone.mode = VehicleMode::kFlying;
}

void PredictedFleet::move(DroneObservation& drone, const swarm::DroneOrder& order, double dt_s) const noexcept {
  if (drone.mode == VehicleMode::kGrounded || drone.mode == VehicleMode::kUnknown) {
    drone.velocity.setZero();
    return;
  }
  const bool follows = order.action == Action::kVelocity && drone.mode == VehicleMode::kFlying;
  const Vec2 u = follows ? Vec2(vehicle_.gain * order.velocity) : Vec2::Zero();
  const dynamics::PlanarState after = dynamics::advance(vehicle_.motion, {drone.position, drone.velocity}, u, dt_s);
  drone.position = after.position;
  drone.velocity = after.velocity;
}

void PredictedFleet::wear(DroneObservation& drone, double rate_per_s, double dt_s) const noexcept {
  if (pads_.empty() || !std::isfinite(drone.battery)) return;
  if (drone.mode != VehicleMode::kGrounded) {
    drone.battery = std::max(0.0, drone.battery - rate_per_s * dt_s);
    return;
  }
  for (const swarm::ChargingPad& pad : pads_)
    if ((drone.position - pad.place).norm() <= pad.radius_m)
      drone.battery = std::min(1.0, drone.battery + dt_s / pad.full_in_s);
}

void PredictedFleet::advance(std::span<const swarm::DroneSnapshot> ordered, double dt_s) noexcept {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    DroneObservation& drone = drones_[i];
    if (drone.age_s > seen_within_s_) drone.age_s += dt_s;
    if (drone.link_age_s > heard_within_s_) drone.link_age_s += dt_s;
    obey(drone, ordered[i].order.action);
    climb(drone, dt_s);
    move(drone, ordered[i].order, dt_s);
    wear(drone, rates_per_s_[i], dt_s);
  }
}

}  // namespace vigil::runtime
