#include "vigil/adapters/ros/stand_in_commander.hpp"

#include <algorithm>

namespace vigil::ros_bridge {
namespace {

using swarm::Action;
using swarm::VehicleMode;
using Told = StandInCrazyswarm::Told;

bool has_come_true(Action wanted, VehicleMode mode) {
  return wanted == Action::kTakeOff ? mode == VehicleMode::kFlying : mode == VehicleMode::kGrounded;
}

bool is_level(const Told& told) { return !told.follows_setpoints || told.silence_s > StandInCommander::kLevelsAfterS; }

}  // namespace

void StandInCommander::listen(const Told& told, VehicleMode mode) {
  if (told.take_off) wanted_ = Action::kTakeOff;
  if (told.land) wanted_ = Action::kLand;
  if (told.stop_motors) wanted_ = Action::kStopMotors;
  if (told.follows_setpoints && told.silence_s > kStopsAfterS && mode == VehicleMode::kFlying) {
    if (wanted_ != Action::kStopMotors) ++falls_;
    wanted_ = Action::kStopMotors;
  }
  if (has_come_true(wanted_, mode)) wanted_ = Action::kNone;
}

swarm::DroneOrder StandInCommander::step(const Told& told, VehicleMode mode, double vehicle_height_m, double dt_s) {
  listen(told, mode);
  if (mode == VehicleMode::kGrounded && told.setpoints != setpoints_) ++starts_by_setpoints_;
  setpoints_ = told.setpoints;
  move(told, mode, vehicle_height_m, dt_s);
  if (wanted_ != Action::kNone || mode != VehicleMode::kFlying) return {wanted_, Vec2::Zero()};
  return {Action::kVelocity, is_level(told) ? Vec2(0.0, 0.0) : Vec2(told.velocity_m_s.x, told.velocity_m_s.y)};
}

void StandInCommander::move(const Told& told, VehicleMode mode, double vehicle_height_m, double dt_s) {
  if (mode == VehicleMode::kGrounded) scale_ = 1.0;
  if (mode != VehicleMode::kFlying) {
    height_m_ = scale_ * vehicle_height_m;
    return;
  }
  if (!is_level(told)) height_m_ = std::max(0.0, height_m_ + told.velocity_m_s.z * dt_s);
  scale_ = height_m_ / altitude_m_;
}

}  // namespace vigil::ros_bridge
