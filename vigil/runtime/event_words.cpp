#include "vigil/runtime/event_words.hpp"

#include <array>

#include <fmt/format.h>

#include "vigil/swarm/command.hpp"

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::CommandKind;
using swarm::VehicleMode;

constexpr std::array<std::string_view, 3> kSeverityWords{"info", "warning", "alarm"};

std::string who_covers(std::size_t active, std::size_t drones) {
  if (active == 0) return "no drone covers";
  return fmt::format("{} of {} drones cover", active, drones);
}

std::string who_takes_over(std::size_t active, std::size_t drones) {
  return who_covers(active, drones) + (active == 0 ? "" : "; they take over its share");
}

std::string battery_in_words(const swarm::DroneSnapshot& drone) {
  return fmt::format("{:.0f} %", 100.0 * drone.battery);
}

/// Whether what a monitor found is why a drone does what it does.
bool explains(swarm::Fault fault, Activity activity) {
  switch (activity) {
    case Activity::kTrackingLost:
      return fault == swarm::Fault::kFrozen || fault == swarm::Fault::kJumped || fault == swarm::Fault::kSwapped ||
             fault == swarm::Fault::kDisagreeing;
    case Activity::kNotFollowing:
      return fault == swarm::Fault::kNotFollowing;
    case Activity::kOutside:
      return fault == swarm::Fault::kOutside;
    case Activity::kGrounded:
    case Activity::kLanding:
    case Activity::kEmergencyStop:
    case Activity::kOverridden:
    case Activity::kVehicleFailed:
      return fault == swarm::Fault::kOwnMode;
    default:
      return false;
  }
}

/// The words for what a monitor found, with its evidence where there is any (a recording keeps none).
EventWords fault_words(std::string_view id, const swarm::FaultReport& fault, VehicleMode mode,
                       const std::string& lost) {
  const bool has_evidence = fault.threshold > 0.0;
  const auto beyond = [&](std::string_view what) {
    if (!has_evidence) return std::string();
    return fmt::format(": {:.2f} m {}, at most {:.2f} m can be", fault.measured, what, fault.threshold);
  };
  const std::string hovers = "it is told to hover where it is expected, the others keep farther away; " + lost;
  switch (fault.kind) {
    case swarm::Fault::kFrozen:
      return {Severity::kAlarm,
              fmt::format("{}: its tracker repeats one place{}", id,
                          has_evidence ? fmt::format(" for {:.2f} s", fault.measured) : ""),
              hovers, "restart its tracker; it covers again by itself once its places change"};
    case swarm::Fault::kJumped:
      return {Severity::kAlarm,
              fmt::format("{} is seen where it cannot be{}", id,
                          has_evidence ? fmt::format(": {:.2f} m from where it was", fault.measured) : ""),
              hovers, "look where it really is; it is believed again once it is seen there steadily"};
    case swarm::Fault::kSwapped:
      return {Severity::kAlarm, fmt::format("{} is seen in another drone's place", id), hovers,
              "check the tracker's names; it covers again by itself once they are right"};
    case swarm::Fault::kDisagreeing:
      return {Severity::kAlarm,
              fmt::format("{}: its velocity is not that of its places{}", id, beyond("apart within a second")), hovers,
              "land it and check its estimator"};
    case swarm::Fault::kNotFollowing:
      return {Severity::kAlarm,
              fmt::format("{} does not fly what it is told{}", id, beyond("from where its orders lead")),
              "it is told to hover, the others give way to it; " + lost,
              "land it or let a pilot take it; it covers again by itself once it follows"};
    case swarm::Fault::kOutside:
      return {Severity::kAlarm, fmt::format("{} has left the field{}", id, beyond("outside")),
              "it is told to come back; " + lost, "watch it; stop its motors if it is a danger"};
    case swarm::Fault::kOwnMode:
    case swarm::Fault::kNone:
      break;
  }
  const std::string next = "ask who has it; once it is on the ground, take off again";
  if (mode == VehicleMode::kManual)
    return {Severity::kAlarm, fmt::format("a pilot flies {} though nobody here said so", id),
            "the others give way to it; " + lost, next};
  if (mode == VehicleMode::kFailed)
    return {Severity::kAlarm, fmt::format("{} says that it failed", id), "it follows nobody; " + lost,
            "clear the ground below it; stop its motors if it is a danger"};
  if (mode == VehicleMode::kGrounded) return {Severity::kAlarm, fmt::format("{} came down by itself", id), lost, next};
  return {Severity::kAlarm, fmt::format("{} {} by itself", id, mode == VehicleMode::kFalling ? "falls" : "lands"),
          "the others keep away from it; " + lost, next};
}

}  // namespace

std::string_view name_of(Severity severity) { return kSeverityWords.at(static_cast<std::size_t>(severity)); }

EventWords words_for(std::string_view id, Activity after, const swarm::DroneSnapshot& drone, std::size_t active,
                     std::size_t drones) {
  const std::string lost = who_takes_over(active, drones);
  if (explains(drone.fault.kind, after)) return fault_words(id, drone.fault, drone.mode, lost);
  switch (after) {
    case Activity::kActive:
      return {Severity::kInfo, fmt::format("{} covers", id), who_covers(active, drones), ""};
    case Activity::kNeverSeen:
      return {Severity::kWarning, fmt::format("{} has not been seen yet", id),
              "it is not steered; while it says that it flies, the others keep clear of where it was to start",
              "check its tracker and its link"};
    case Activity::kGrounded:
      return {Severity::kInfo, fmt::format("{} is on the ground", id), who_covers(active, drones),
              "take off when it is to fly"};
    case Activity::kAboutToTakeOff:
      return {Severity::kWarning, fmt::format("{} is about to take off", id),
              "it rises by itself once it is well and the air above it is clear", "land or hold takes that back"};
    case Activity::kTakingOff:
      return {Severity::kInfo, fmt::format("{} takes off", id), "the others keep away from above it", ""};
    case Activity::kLanding:
      return {Severity::kWarning, fmt::format("{} lands", id), lost, "take off again when it is ready"};
    case Activity::kEmergencyStop:
      return {Severity::kAlarm, fmt::format("{}: motors stopped", id), "it comes down where it is; " + lost,
              "secure the place; a take-off on the ground ends the stop"};
    case Activity::kOverridden:
      return {Severity::kWarning, fmt::format("a pilot flies {}", id), "the others give way to it; " + lost,
              "give it back when the pilot is done"};
    case Activity::kMarkedFailed:
      return {Severity::kAlarm, fmt::format("{} is marked as failed", id), "it is not steered any more; " + lost,
              "resume takes it back"};
    case Activity::kVehicleFailed:
      return {Severity::kAlarm, fmt::format("{} says that it failed", id), "it follows nobody; " + lost,
              "clear the ground below it; stop its motors if it is a danger"};
    case Activity::kTrackingLost:
      return {Severity::kAlarm, fmt::format("{} is not seen by its tracker", id),
              "it is told to hover, the others keep farther away; " + lost,
              "look for it; it covers again by itself once it is seen"};
    case Activity::kLinkLost:
      return {Severity::kAlarm, fmt::format("{} is not heard", id),
              "it does what its own failsafe does, the others keep away; " + lost,
              "check its radio; it covers again by itself once it is heard"};
    case Activity::kBatteryLow:
      return {Severity::kWarning, fmt::format("{}: battery at {}", id, battery_in_words(drone)),
              "it lands where it is; " + lost, "change its battery, then take off"};
    case Activity::kHeld:
      return {Severity::kInfo, fmt::format("{} holds", id), lost, "resume sends it back to coverage"};
    case Activity::kTravelling:
      return {Severity::kInfo, fmt::format("{} flies to a place", id), "it waits there; " + lost,
              "resume sends it back to coverage"};
    case Activity::kReturning:
      return {Severity::kInfo,
              fmt::format("{} flies to a pad to be charged, battery at {}", id, battery_in_words(drone)), lost, ""};
    case Activity::kCharging:
      return {Severity::kInfo, fmt::format("{} is being charged, battery at {}", id, battery_in_words(drone)), lost,
              "it rises by itself when it is charged; land or hold takes that back"};
    case Activity::kNotFollowing:
      return fault_words(id, {.kind = swarm::Fault::kNotFollowing}, drone.mode, lost);
    case Activity::kOutside:
      return fault_words(id, {.kind = swarm::Fault::kOutside}, drone.mode, lost);
    case Activity::kRecovering:
      break;
  }
  return {Severity::kInfo, fmt::format("{} is healthy again", id), "it covers in a moment", ""};
}

EventWords words_for_fault(std::string_view id, const swarm::DroneSnapshot& drone, std::size_t active,
                           std::size_t drones) {
  return fault_words(id, drone.fault, drone.mode, who_covers(active, drones));
}

EventWords words_for_station(std::string_view name, bool works) {
  if (works) return {Severity::kInfo, fmt::format("station {} charges again", name), "drones are sent there again", ""};
  return {Severity::kAlarm, fmt::format("station {} does not charge who stands there", name),
          "nobody is sent there; who stands there flies to another station if it can",
          "check the station's power; who stays on its pads covers again once it is charged"};
}

std::string_view after_restart(bool has_real_drones) {
  if (has_real_drones)
    return "drones in the air count as overridden and are not steered until they were seen on the ground; an emergency "
           "stop reaches them; nothing takes off by itself";
  return "drones in the air hold until somebody resumes them; who was landing lands, who was marked failed, overridden "
         "or had its motors stopped stays so; nothing takes off by itself; the clock runs at 1x, whether it was paused "
         "or faster before";
}

std::string refusal_words(std::string_view id, CommandKind wish, const swarm::DroneSnapshot& drone) {
  const bool is_down = drone.mode == VehicleMode::kGrounded;
  if (drone.mode == VehicleMode::kUnknown) return fmt::format("{} was never heard of", id);
  if (drone.activity == Activity::kEmergencyStop && !is_down)
    return fmt::format("{}: its motors were stopped in the air", id);
  switch (wish) {
    case CommandKind::kTakeOff:
      if (!is_down) return fmt::format("{} is in the air; only a drone on the ground takes off", id);
      if (drone.activity == Activity::kMarkedFailed)
        return fmt::format("{} is marked as failed; resume it before it takes off", id);
      return fmt::format("a pilot has {}; it must be given back first", id);
    case CommandKind::kLand:
      return fmt::format("{} is on the ground already", id);
    case CommandKind::kHold:
      if (is_down) return fmt::format("{} is on the ground; only a drone in the air holds", id);
      if (drone.activity == Activity::kMarkedFailed)
        return fmt::format("{} is marked as failed; resume it before it holds", id);
      return fmt::format("a pilot has {}; it must be given back first", id);
    case CommandKind::kGoTo:
      if (is_down) return fmt::format("{} is on the ground; only a drone in the air flies to a place", id);
      if (drone.activity == Activity::kMarkedFailed)
        return fmt::format("{} is marked as failed; resume it before it flies to a place", id);
      if (drone.activity == Activity::kOverridden)
        return fmt::format("a pilot has {}; it must be given back first", id);
      return fmt::format(
          "{} may not fly to that place; choose one inside the field, outside every no-fly polygon and "
          "not walled in by them",
          id);
    case CommandKind::kResume:
      return fmt::format("{} is neither held, nor at a place, nor marked as failed", id);
    case CommandKind::kGiveBack:
      return fmt::format("nobody took {} over", id);
    default:
      break;
  }
  return fmt::format("{} cannot do that now", id);
}

}  // namespace vigil::runtime
