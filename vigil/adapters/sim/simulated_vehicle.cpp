#include "vigil/adapters/sim/simulated_vehicle.hpp"

#include <algorithm>
#include <limits>

namespace vigil::sim {

using dynamics::FailsafePhase;
using swarm::Action;
using swarm::VehicleMode;

double response_delay_s(const MotionModel& motion) noexcept {
  const auto* const loop = std::get_if<dynamics::VelocityLoop>(&motion);
  return loop == nullptr ? 0.0 : loop->response_delay_s;
}

SimulatedVehicle::SimulatedVehicle(const VehicleParameters& parameters, const Vec2& position, bool starts_flying,
                                   std::size_t dead_ticks)
    : parameters_(parameters), motion_(parameters.motion, dead_ticks), hold_(parameters.position_hold_per_s) {
  motion_.rest_at(position);
  if (parameters.battery) battery_.emplace(*parameters.battery);
  truth_.position = position;
  truth_.height_m = starts_flying ? parameters.altitude_m : 0.0;
  truth_.mode = starts_flying ? VehicleMode::kFlying : VehicleMode::kGrounded;
}

double SimulatedVehicle::reported_battery() const noexcept {
  return battery_ ? battery_->reported() : std::numeric_limits<double>::quiet_NaN();
}

void SimulatedVehicle::obey(const swarm::DroneOrder& order) noexcept {
  failsafe_ = dynamics::received(parameters_.failsafe, failsafe_);
  if (deaf_s_ > 0.0 && order.action != Action::kStopMotors) return;
  const VehicleMode mode = truth_.mode;
  const bool follows_orders = mode == VehicleMode::kFlying || mode == VehicleMode::kTakingOff;
  switch (order.action) {
    case Action::kStopMotors:
      if (is_airborne()) truth_.mode = VehicleMode::kFalling;
      break;
    case Action::kTakeOff:
      if (mode == VehicleMode::kGrounded && !has_empty_battery()) truth_.mode = VehicleMode::kTakingOff;
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

void SimulatedVehicle::climb_or_descend(double dt_s) noexcept {
  switch (truth_.mode) {
    case VehicleMode::kTakingOff:
      return climb(parameters_.altitude_m / parameters_.take_off_s, dt_s);
    case VehicleMode::kLanding:
      return climb(-parameters_.altitude_m / parameters_.landing_s, dt_s);
    case VehicleMode::kFalling:
      return climb(-parameters_.altitude_m / parameters_.emergency_s, dt_s);
    default:
      return;
  }
}

/// Its own autopilot has it, and nobody's velocity.
bool SimulatedVehicle::stays_by_itself() const noexcept {
  const VehicleMode mode = truth_.mode;
  const bool is_on_its_own =
      mode == VehicleMode::kTakingOff || mode == VehicleMode::kLanding || mode == VehicleMode::kFailed;
  return is_on_its_own || (mode == VehicleMode::kFlying && failsafe_.phase == FailsafePhase::kHovering);
}

void SimulatedVehicle::move(double dt_s, const Vec2& push) noexcept {
  if (!stays_by_itself()) hold_.release();
  Vec2 command = stays_by_itself() ? hold_.command(truth_.position, truth_.velocity) : command_;
  if (drifts_s_ > 0.0) command += drift_;
  motion_.advance(command, dt_s, push);
  truth_.position = motion_.position();
  truth_.velocity = motion_.velocity();
}

void SimulatedVehicle::arrive() noexcept {
  const bool came_down = truth_.mode == VehicleMode::kLanding || truth_.mode == VehicleMode::kFalling;
  if (came_down && truth_.height_m <= 0.0) {
    truth_.mode = VehicleMode::kGrounded;
    truth_.velocity.setZero();
    motion_.rest_at(truth_.position);
  } else if (truth_.mode == VehicleMode::kTakingOff && truth_.height_m >= parameters_.altitude_m) {
    truth_.mode = VehicleMode::kFlying;
  }
}

void SimulatedVehicle::watch_battery(double dt_s) noexcept {
  if (!battery_) return;
  battery_->advance(is_airborne(), dt_s);
  truth_.charge = battery_->state_of_charge();
  truth_.ran_empty = truth_.ran_empty || (is_airborne() && battery_->is_empty());
  if (!is_airborne() || truth_.mode == VehicleMode::kFalling || !battery_->is_empty()) return;
  truth_.mode = VehicleMode::kLanding;
  command_.setZero();
}

void SimulatedVehicle::act_on_silence() noexcept {
  switch (failsafe_.phase) {
    case FailsafePhase::kFollowing:
      return;
    case FailsafePhase::kHovering:
      if (parameters_.failsafe.latches_hovering) truth_.mode = VehicleMode::kFailed;
      break;
    case FailsafePhase::kLanding:
      truth_.mode = VehicleMode::kLanding;
      break;
    case FailsafePhase::kMotorsCut:
      truth_.mode = VehicleMode::kFalling;
      break;
  }
  command_.setZero();
}

/// Only who flies by velocities misses them: take-offs, landings and pilots need no orders.
void SimulatedVehicle::watch_orders(double dt_s) noexcept {
  if (truth_.mode != VehicleMode::kFlying) {
    failsafe_ = {};
    return;
  }
  act_on_silence();
  failsafe_ = dynamics::advance(parameters_.failsafe, failsafe_, dt_s);
}

void SimulatedVehicle::advance(double dt_s, const Vec2& push) noexcept {
  watch_battery(dt_s);
  if (!is_airborne()) {
    truth_.velocity.setZero();
    return;
  }
  watch_orders(dt_s);
  deaf_s_ = std::max(0.0, deaf_s_ - dt_s);
  drifts_s_ = std::max(0.0, drifts_s_ - dt_s);
  climb_or_descend(dt_s);
  move(dt_s, push);
  arrive();
}

void SimulatedVehicle::fail() noexcept {
  if (!is_airborne() || truth_.mode == VehicleMode::kFalling) return;
  truth_.mode = VehicleMode::kFailed;
  command_.setZero();
}

void SimulatedVehicle::land_by_itself() noexcept {
  if (truth_.mode != VehicleMode::kFlying) return;
  truth_.mode = VehicleMode::kLanding;
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
