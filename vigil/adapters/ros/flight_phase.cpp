#include "vigil/adapters/ros/flight_phase.hpp"

#include <algorithm>

namespace vigil::ros_bridge {
namespace {

using swarm::Action;
using swarm::VehicleMode;

constexpr double kDownForS = 0.3;
constexpr double kUpForS = 0.3;
constexpr double kComesUpWithinS =
    10.0;                            ///< of an order to take off, on top of how long it takes: services may be slow
constexpr double kGraceS = 2.0;      ///< on top of how long a manoeuvre takes
constexpr double kStopAgainS = 0.5;  ///< motors are told to stop until they have
constexpr double kShareOfAltitude = 0.9;
constexpr double kFreshS = 0.5;

}  // namespace

bool FlightPhase::is_airborne() const { return mode_ != VehicleMode::kUnknown && mode_ != VehicleMode::kGrounded; }

bool FlightPhase::is_streamed() const {
  if (mode_ != VehicleMode::kLanding) return mode_ == VehicleMode::kFlying;
  return descends() || (flew_ && landing_ == Landing::kAsked);
}

bool FlightPhase::descends() const { return mode_ == VehicleMode::kLanding && landing_ == Landing::kBySetpoints; }

bool FlightPhase::flies() const { return mode_ == VehicleMode::kFlying || mode_ == VehicleMode::kTakingOff; }

void FlightPhase::watch(double height_m, double age_s, double now_s) {
  if (!(age_s < kFreshS)) return;
  height_m_ = height_m;
  const bool is_low = height_m < parameters_.landed_height_m;
  if (mode_ == VehicleMode::kUnknown) mode_ = is_low ? VehicleMode::kGrounded : VehicleMode::kManual;
  if (mode_ == VehicleMode::kTakingOff) {
    if (height_m >= kShareOfAltitude * parameters_.altitude_m) mode_ = VehicleMode::kFlying;
    if (is_low && now_s - called_s_ > parameters_.take_off_s + kGraceS) mode_ = VehicleMode::kGrounded;
    return;
  }
  watch_height(height_m, now_s);
}

bool FlightPhase::may_come_up(double now_s) const {
  return now_s - take_off_s_ <= parameters_.take_off_s + kComesUpWithinS;
}

void FlightPhase::watch_above_ground(double height_m, double now_s) {
  down_since_s_ = -1.0;
  if (up_since_s_ < 0.0) up_since_s_ = now_s;
  if (mode_ != VehicleMode::kGrounded) return;
  if (!may_come_up(now_s)) {
    if (now_s - up_since_s_ >= kUpForS) mode_ = VehicleMode::kManual;
  } else if (height_m >= kShareOfAltitude * parameters_.altitude_m) {
    mode_ = VehicleMode::kFlying;
  }
}

void FlightPhase::watch_height(double height_m, double now_s) {
  if (height_m >= parameters_.landed_height_m) return watch_above_ground(height_m, now_s);
  up_since_s_ = -1.0;
  if (down_since_s_ < 0.0) down_since_s_ = now_s;
  if (now_s - down_since_s_ < kDownForS) return;
  is_stop_due_ = is_stop_due_ || descends();
  mode_ = VehicleMode::kGrounded;
}

std::optional<VehicleCall> FlightPhase::call_for(Action action, double age_s, double now_s) const {
  const double since_s = now_s - called_s_;
  if (is_stop_due_) return VehicleCall::kEmergency;
  if (action == Action::kStopMotors)
    return is_airborne() && (mode_ != VehicleMode::kFalling || since_s > kStopAgainS)
               ? std::optional(VehicleCall::kEmergency)
               : std::nullopt;
  if (mode_ == VehicleMode::kGrounded && action == Action::kTakeOff && age_s < kFreshS &&
      since_s > parameters_.take_off_s + kGraceS)
    return VehicleCall::kTakeOff;
  if (mode_ == VehicleMode::kLanding) return call_while_landing(age_s, now_s);
  if (flies() && (action == Action::kLand || age_s > parameters_.land_unseen_s)) return VehicleCall::kLand;
  return std::nullopt;
}

std::optional<VehicleCall> FlightPhase::call_while_landing(double age_s, double now_s) const {
  const bool is_overdue = now_s - called_s_ > parameters_.landing_s + kGraceS;
  if (landing_ == Landing::kCrazyswarms && is_overdue) return VehicleCall::kLand;
  if (descends() && must_be_down(age_s, now_s)) return VehicleCall::kEmergency;
  return std::nullopt;
}

/// By what it has come down since it was last seen.
bool FlightPhase::must_be_down(double age_s, double now_s) const {
  const double unseen_s = std::min(age_s, now_s - descends_since_s_);
  return age_s > kFreshS && unseen_s > height_m_ / kDescentPerS + kGraceS;
}

void FlightPhase::begin_landing() {
  if (mode_ == VehicleMode::kLanding) return;  // it is asked for again: nobody begins to stream to one that may be down
  flew_ = mode_ == VehicleMode::kFlying;
  landing_ = Landing::kAsked;
  mode_ = VehicleMode::kLanding;
}

void FlightPhase::answered(Answer answer, double now_s) {
  if (mode_ != VehicleMode::kLanding || landing_ == Landing::kCrazyswarms) return;
  if (answer == Answer::kYes) landing_ = Landing::kCrazyswarms;
  if (landing_ != Landing::kAsked) return;
  if (answer == Answer::kWaiting && now_s - called_s_ <= parameters_.unanswered_s) return;
  landing_ = Landing::kBySetpoints;
  descends_since_s_ = now_s;
}

void FlightPhase::called(VehicleCall call, double now_s) {
  is_stop_due_ = false;
  if (call == VehicleCall::kEmergency && mode_ == VehicleMode::kGrounded) return;
  called_s_ = now_s;
  down_since_s_ = -1.0;
  take_off_s_ = call == VehicleCall::kTakeOff ? now_s : -1e9;
  switch (call) {
    case VehicleCall::kTakeOff:
      mode_ = VehicleMode::kTakingOff;
      return;
    case VehicleCall::kLand:
      begin_landing();
      return;
    case VehicleCall::kEmergency:
      mode_ = VehicleMode::kFalling;
      return;
  }
}

}  // namespace vigil::ros_bridge
