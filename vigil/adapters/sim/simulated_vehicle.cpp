#include "vigil/adapters/sim/simulated_vehicle.hpp"

#include <algorithm>

namespace vigil::sim {

using swarm::Action;
using swarm::VehicleMode;

SimulatedVehicle::SimulatedVehicle(const VehicleParameters& parameters, const Vec2& position, bool starts_flying)
    : parameters_(parameters) {
  truth_.position = position;
  truth_.height_m = starts_flying ? parameters.altitude_m : 0.0;
  truth_.mode = starts_flying ? VehicleMode::kFlying : VehicleMode::kGrounded;
}

void SimulatedVehicle::obey(const swarm::DroneOrder& order) noexcept {
  const VehicleMode mode = truth_.mode;
  const bool follows_orders = mode == VehicleMode::kFlying || mode == VehicleMode::kTakingOff;
  switch (order.action) {
    case Action::kStopMotors:
      if (is_airborne()) truth_.mode = VehicleMode::kFalling;
      break;
    case Action::kTakeOff:
      if (mode == VehicleMode::kGrounded) truth_.mode = VehicleMode::kTakingOff;
      break;
    case Action::kLand:
      if (follows_orders) truth_.mode = VehicleMode::kLanding;
      break;
    case Action::kVelocity:
      if (mode == VehicleMode::kFlying) command_ = order.velocity;
      return;
    case Action::kNone:
      break;
  }
  if (truth_.mode != VehicleMode::kManual) command_.setZero();
}

void SimulatedVehicle::climb(double rate_m_s, double dt_s) noexcept {
  truth_.height_m = std::clamp(truth_.height_m + rate_m_s * dt_s, 0.0, parameters_.altitude_m);
}

void SimulatedVehicle::advance(double dt_s) noexcept {
  if (!is_airborne()) {
    truth_.velocity.setZero();
    return;
  }
  switch (truth_.mode) {
    case VehicleMode::kTakingOff:
      climb(parameters_.altitude_m / parameters_.take_off_s, dt_s);
      break;
    case VehicleMode::kLanding:
      climb(-parameters_.altitude_m / parameters_.landing_s, dt_s);
      break;
    case VehicleMode::kFalling:
      climb(-parameters_.altitude_m / parameters_.emergency_s, dt_s);
      break;
    default:
      break;
  }
  const dynamics::PlanarState after =
      dynamics::advance(parameters_.motion, {truth_.position, truth_.velocity}, command_, dt_s);
  truth_.position = after.position;
  truth_.velocity = after.velocity;

  const bool came_down = truth_.mode == VehicleMode::kLanding || truth_.mode == VehicleMode::kFalling;
  if (came_down && truth_.height_m <= 0.0) {
    truth_.mode = VehicleMode::kGrounded;
    truth_.velocity.setZero();
  } else if (truth_.mode == VehicleMode::kTakingOff && truth_.height_m >= parameters_.altitude_m) {
    truth_.mode = VehicleMode::kFlying;
  }
}

void SimulatedVehicle::fail() noexcept {
  if (!is_airborne() || truth_.mode == VehicleMode::kFalling) return;
  truth_.mode = VehicleMode::kFailed;
  command_.setZero();
}

void SimulatedVehicle::take_over(const Vec2& velocity) noexcept {
  if (truth_.mode != VehicleMode::kFlying && truth_.mode != VehicleMode::kManual) return;
  truth_.mode = VehicleMode::kManual;
  command_ = velocity;
}

void SimulatedVehicle::give_back() noexcept {
  if (truth_.mode != VehicleMode::kManual) return;
  truth_.mode = VehicleMode::kFlying;
  command_.setZero();
}

}  // namespace vigil::sim
