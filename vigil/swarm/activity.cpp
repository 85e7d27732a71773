#include "vigil/swarm/activity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil::swarm {
namespace {

/// An older report of the battery says nothing new.
constexpr double kOldestReportS = 2.0;

bool usable(const DroneObservation& observed) {
  return observed.position.allFinite() && std::isfinite(observed.height_m) && std::isfinite(observed.age_s) &&
         observed.age_s >= 0.0;
}

/// A negative or undefined age says nothing about freshness: it counts as never heard.
double sane_age(double age_s) { return age_s >= 0.0 ? age_s : DroneObservation::kNever; }

bool is_seen(const DroneMemory& memory) { return memory.last_good.age_s != DroneObservation::kNever; }

bool on_ground(VehicleMode mode) { return mode == VehicleMode::kGrounded; }

/// Nobody knows where it is, or how it moves.
bool is_unbelievable(Fault fault) {
  return fault == Fault::kFrozen || fault == Fault::kJumped || fault == Fault::kSwapped || fault == Fault::kDisagreeing;
}

/// A share of full. Who is on its way to be charged may use half of the reserve for that: it was
/// sent in time to get there with all of it, by what was known then.
double least_battery(const DroneMemory& memory, const HealthParameters& health) {
  return memory.intent == Intent::kRecharge ? 0.5 * health.battery_reserve : health.battery_reserve;
}

/// Down to its reserve, or to what a landing needs where that is more. False where neither is known.
bool has_to_land(const DroneMemory& memory, const HealthParameters& health) {
  constexpr double kToBeSure = 1.5;  // of a report that is wrong by some percent, and a landing in wind
  const std::optional<TimeLeft> left = memory.energy.time_to(0.0);
  if (left && left->s < kToBeSure * health.landing_s) return true;
  return memory.last_good.battery < least_battery(memory, health);  // false for NaN: not reported
}

/// What is wrong with the drone itself, whatever the operator wishes; kActive where nothing is.
Activity fault_of(const DroneMemory& memory, const HealthParameters& health) {
  const DroneObservation& seen = memory.last_good;
  if (!is_seen(memory)) return Activity::kNeverSeen;
  if (seen.mode == VehicleMode::kFailed) return Activity::kVehicleFailed;
  if (seen.mode == VehicleMode::kFalling) return Activity::kEmergencyStop;
  // A silent link explains a lost position, too: vehicles may send where they are over it.
  if (seen.link_age_s > health.link_timeout_s) return Activity::kLinkLost;
  if (seen.age_s > health.tracking_timeout_s || is_unbelievable(memory.fault)) return Activity::kTrackingLost;
  if (memory.fault == Fault::kOutside) return Activity::kOutside;
  if (memory.fault == Fault::kNotFollowing) return Activity::kNotFollowing;
  if (has_to_land(memory, health)) return Activity::kBatteryLow;
  return Activity::kActive;
}

Activity phase_on_ground(const DroneMemory& memory) {
  if (wants_up(memory)) return Activity::kAboutToTakeOff;
  const bool charges = memory.intent == Intent::kRecharge && memory.errand != Errand::kWait;
  return charges ? Activity::kCharging : Activity::kGrounded;
}

/// What the operator's wish or the vehicle's own phase keeps it from; kActive where nothing does.
Activity phase_of(const DroneMemory& memory) {
  const VehicleMode mode = memory.last_good.mode;
  if (memory.intent == Intent::kEmergencyStop) return Activity::kEmergencyStop;
  if (memory.intent == Intent::kMarkedFailed) return Activity::kMarkedFailed;
  if (memory.intent == Intent::kOverride || mode == VehicleMode::kManual) return Activity::kOverridden;
  if (mode == VehicleMode::kGrounded) return phase_on_ground(memory);
  const bool lands_on_pad = memory.intent == Intent::kRecharge && memory.errand == Errand::kLand;
  if (memory.intent == Intent::kLand || lands_on_pad || mode == VehicleMode::kLanding) return Activity::kLanding;
  if (mode == VehicleMode::kTakingOff) return Activity::kTakingOff;
  if (memory.intent == Intent::kHold || memory.intent == Intent::kStayDown) return Activity::kHeld;
  if (memory.intent == Intent::kGoTo) return Activity::kTravelling;
  if (memory.intent == Intent::kRecharge) return Activity::kReturning;
  return Activity::kActive;
}

/// Nothing takes off by itself: a drone that came down, asked or unasked, waits there for an operator.
void settle_intent(DroneMemory& memory) {
  const bool wants_the_air =
      memory.intent == Intent::kCover || memory.intent == Intent::kHold || memory.intent == Intent::kGoTo;
  if (on_ground(memory.last_good.mode) && (wants_the_air || memory.intent == Intent::kLand))
    memory.intent = Intent::kStayDown;
  if (memory.last_good.mode == VehicleMode::kFlying && memory.intent == Intent::kTakeOff)
    memory.intent = Intent::kCover;
  if (memory.intent == Intent::kCalledBack && !on_ground(memory.last_good.mode))  // a pilot may take it up
    memory.intent = memory.last_good.mode == VehicleMode::kManual ? Intent::kStayDown : Intent::kLand;
}

/// By its own word; where it says nothing, whatever was seen is taken to fly.
bool in_the_air(const DroneMemory& memory) {
  return memory.last_good.mode == VehicleMode::kUnknown ? is_seen(memory) : !on_ground(memory.last_good.mode);
}

/// Whether it may move sideways although nobody here steers it.
bool may_wander(Activity activity) {
  return activity == Activity::kOverridden || activity == Activity::kMarkedFailed ||
         activity == Activity::kVehicleFailed || activity == Activity::kLinkLost || activity == Activity::kNotFollowing;
}

}  // namespace

void remember(DroneMemory& memory, const DroneObservation& observed, double dt_s) noexcept {
  DroneObservation& last = memory.last_good;
  if (usable(observed)) {
    last.position = observed.position;
    last.velocity = observed.velocity.allFinite() ? observed.velocity : Vec2::Zero();
    last.height_m = observed.height_m;
    last.age_s = observed.age_s;
  } else {
    last.age_s += dt_s;
  }
  last.link_age_s = sane_age(observed.link_age_s);
  if (observed.mode != VehicleMode::kUnknown) last.mode = observed.mode;
  last.battery = observed.battery;
  const bool is_heard = last.link_age_s <= kOldestReportS;
  const bool flies = last.mode != VehicleMode::kUnknown && !on_ground(last.mode);
  memory.energy.update(is_heard ? last.battery : std::numeric_limits<double>::quiet_NaN(), flies, dt_s);
}

bool apply_wish(DroneMemory& memory, CommandKind wish, const Vec2& place) noexcept {
  const bool airborne = in_the_air(memory);
  const bool grounded = on_ground(memory.last_good.mode);
  const Intent intent = memory.intent;
  const auto set_if = [&memory](bool allowed, Intent wanted) {
    if (allowed) memory.intent = wanted;
    return allowed;
  };
  // Motors that were stopped in the air stay stopped.
  if (intent == Intent::kEmergencyStop && airborne) return wish == CommandKind::kEmergencyStop;
  const bool is_about_to_rise = grounded && (intent == Intent::kTakeOff || intent == Intent::kRecharge);
  switch (wish) {
    case CommandKind::kEmergencyStop:
      return set_if(true, Intent::kEmergencyStop);
    case CommandKind::kMarkFailed:
      return set_if(true, Intent::kMarkedFailed);
    case CommandKind::kTakeOff:
      return set_if(grounded && intent != Intent::kOverride && intent != Intent::kMarkedFailed, Intent::kTakeOff);
    case CommandKind::kLand:
      return set_if(airborne || is_about_to_rise, is_about_to_rise ? Intent::kCalledBack : Intent::kLand);
    case CommandKind::kHold:
      if (is_about_to_rise) return set_if(true, Intent::kCalledBack);
      return set_if(airborne && intent != Intent::kOverride && intent != Intent::kMarkedFailed, Intent::kHold);
    case CommandKind::kGoTo:
      if (!airborne || intent == Intent::kOverride || intent == Intent::kMarkedFailed) return false;
      memory.place = place;
      return set_if(true, Intent::kGoTo);
    case CommandKind::kOverride:
      return set_if(airborne, Intent::kOverride);
    case CommandKind::kResume:
      return set_if(intent == Intent::kHold || intent == Intent::kGoTo || intent == Intent::kMarkedFailed,
                    Intent::kCover);
    case CommandKind::kGiveBack:
      return set_if(intent == Intent::kOverride, Intent::kCover);
    case CommandKind::kSetTarget:
    case CommandKind::kStartAfresh:
      break;
  }
  return false;
}

void judge(DroneMemory& memory, const HealthParameters& health, double dt_s) noexcept {
  settle_intent(memory);
  const Activity fault = fault_of(memory, health);
  const Activity phase = phase_of(memory);
  if (fault == Activity::kActive) {
    memory.healthy_s += dt_s;
    if (memory.healthy_s >= health.recovery_s) memory.is_recovering = false;
    const bool would_fly =
        phase == Activity::kActive || phase == Activity::kTravelling || phase == Activity::kReturning;
    memory.activity = would_fly && memory.is_recovering ? Activity::kRecovering : phase;
    return;
  }
  memory.healthy_s = 0.0;
  memory.is_recovering = fault != Activity::kNeverSeen;  // the first sight of a drone is no recovery
  // What the operator did to a drone, or its being down, says more than what is wrong with it then.
  const bool phase_explains = phase == Activity::kGrounded || phase == Activity::kCharging ||
                              phase == Activity::kAboutToTakeOff || phase == Activity::kEmergencyStop ||
                              phase == Activity::kMarkedFailed || phase == Activity::kOverridden;
  memory.activity = phase_explains && fault != Activity::kNeverSeen ? phase : fault;
}

Action action_for(const DroneMemory& memory) noexcept {
  // Said for as long as it is wished, whatever the vehicle reports: the message or the report may have been lost.
  if (memory.intent == Intent::kEmergencyStop) return Action::kStopMotors;
  const bool lands_already = memory.last_good.mode == VehicleMode::kLanding;
  switch (memory.activity) {
    case Activity::kAboutToTakeOff:
      return memory.healthy_s > 0.0 ? Action::kTakeOff : Action::kNone;
    case Activity::kLanding:
    case Activity::kBatteryLow:
      return lands_already ? Action::kNone : Action::kLand;
    case Activity::kActive:
    case Activity::kHeld:
    case Activity::kRecovering:
    case Activity::kTravelling:
    case Activity::kReturning:
    case Activity::kTrackingLost:
    case Activity::kLinkLost:
    case Activity::kNotFollowing:
    case Activity::kOutside:
      return memory.intent == Intent::kLand ? Action::kLand : Action::kVelocity;
    case Activity::kNeverSeen:  // who says that it flies is kept in its place, and can be brought down
      if (!in_the_air(memory)) return Action::kNone;
      return memory.intent == Intent::kLand && !lands_already ? Action::kLand : Action::kVelocity;
    default:
      return Action::kNone;
  }
}

bool is_airborne(const DroneMemory& memory, const HealthParameters& health) noexcept {
  if (!is_seen(memory)) return memory.is_expected && in_the_air(memory);
  return in_the_air(memory) && memory.last_good.height_m > health.landed_height_m;
}

bool is_steered(Activity activity) noexcept {
  return activity == Activity::kActive || activity == Activity::kTravelling || activity == Activity::kHeld ||
         activity == Activity::kRecovering || activity == Activity::kOutside || activity == Activity::kReturning;
}

bool stands_still(Activity activity) noexcept {
  return activity == Activity::kTakingOff || activity == Activity::kLanding || activity == Activity::kBatteryLow ||
         activity == Activity::kTrackingLost;
}

double wandering_speed(const DroneMemory& memory, double u_max_m_s) noexcept {
  constexpr double kChange = 0.1;  // of u_max
  if (!may_wander(memory.activity)) return 0.0;
  if (memory.activity == Activity::kOverridden) return u_max_m_s;
  return std::min(u_max_m_s, memory.last_good.velocity.norm() + kChange * u_max_m_s);
}

bool wants_up(const DroneMemory& memory) noexcept {
  return memory.intent == Intent::kTakeOff || (memory.intent == Intent::kRecharge && memory.errand == Errand::kRise);
}

}  // namespace vigil::swarm
