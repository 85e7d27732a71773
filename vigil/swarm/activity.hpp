#pragma once

#include <cstdint>
#include <optional>

#include "vigil/swarm/command.hpp"
#include "vigil/swarm/energy.hpp"
#include "vigil/swarm/fault.hpp"
#include "vigil/swarm/observation.hpp"

namespace vigil::swarm {

/// When a drone counts as flying normally: the paper's fault-free, (12).
struct HealthParameters {
  double tracking_timeout_s = 0.5;
  double link_timeout_s = 1.0;
  double battery_reserve = 0.2;   ///< share of full
  double recovery_s = 0.5;        ///< healthy for so long before it is active again
  double landed_height_m = 0.05;  ///< below this it is down
  double landing_s = 0.0;         ///< a landing takes so long: who has little more left lands where it is
};

/// What the operator last wanted of a drone.
enum class Intent : std::uint8_t {
  kStayDown,  ///< nothing: on the ground it stays there, in the air it hovers
  kTakeOff,   ///< until it flies, then kCover
  kCover,     ///< until it is on the ground, for whatever reason, then kStayDown: nothing takes off by itself
  kLand,
  kHold,
  kGoTo,  ///< to DroneMemory::place, and wait there
  kMarkedFailed,
  kEmergencyStop,  ///< until a take-off is asked for on the ground
  kOverride,
  kCalledBack,  ///< a take-off was taken back on the ground: whatever leaves the ground after that lands
  kRecharge     ///< the swarm's own wish: at a pad, until it is charged; then kTakeOff. See Errand
};

/// How far kRecharge has come.
enum class Errand : std::uint8_t {
  kFly,     ///< to DroneMemory::place, the pad
  kLand,    ///< onto it
  kCharge,  ///< there
  kWait,    ///< there, but it charges nobody
  kRise     ///< off the ground, to fly to another pad
};

/// Active, or why not: the paper's chi_i (12) with its reason.
enum class Activity : std::uint8_t {
  kActive,
  kNeverSeen,  ///< no position yet
  kGrounded,   ///< on the ground
  kTakingOff,
  kLanding,
  kEmergencyStop,   ///< its motors were stopped
  kOverridden,      ///< a pilot has it
  kMarkedFailed,    ///< an operator declared it failed
  kVehicleFailed,   ///< it says itself that it failed
  kTrackingLost,    ///< its position is too old or not a number, or cannot be believed
  kLinkLost,        ///< it has not been heard for too long
  kBatteryLow,      ///< below the reserve: it lands
  kHeld,            ///< an operator holds it, or it flies although nobody asked it to
  kRecovering,      ///< healthy again, for less than recovery_s
  kTravelling,      ///< on its way to a place, or waiting there
  kAboutToTakeOff,  ///< on the ground, and told to rise: as soon as it can, and the air above it is clear
  kNotFollowing,    ///< it does not fly what it is told
  kOutside,         ///< it left the field, and is told to come back
  kReturning,       ///< on its way to a pad, to be charged
  kCharging         ///< on a pad; it rises by itself when it is charged
};

/// What the vehicle is asked to do, every tick anew (so a lost message costs one tick).
enum class Action : std::uint8_t { kNone, kTakeOff, kLand, kVelocity, kStopMotors };

/// What the swarm remembers of one drone between ticks.
struct DroneMemory {
  Intent intent = Intent::kStayDown;
  Errand errand = Errand::kFly;
  float wants_up_s = 0.0F;     ///< for so long it has wanted to leave the ground
  Vec2 place = Vec2::Zero();   ///< kGoTo, kRecharge: where to, field frame
  DroneObservation last_good;  ///< the newest observation whose numbers were usable; its ages count on
  bool is_expected = false;    ///< before it is seen: last_good.position is where the mission says that it starts
  double healthy_s = 0.0;      ///< how long nothing has been wrong with it
  Fault fault = Fault::kNone;  ///< what a monitor found
  bool has_new_fault = false;  ///< in this tick
  bool is_recovering = false;  ///< something was wrong with it: recovery_s applies
  Activity activity = Activity::kNeverSeen;
  EnergyEstimate energy;
};

/// Takes this tick's observation into `memory`: keeps the last usable one, with ages that count on.
void remember(DroneMemory& memory, const DroneObservation& observed, double dt_s) noexcept;

/// Changes `memory.intent` as the operator wishes; `place` is where kGoTo leads, checked by the caller. False where the
/// wish makes no sense now and is refused: take-off of one that is not on the ground, that a pilot has or that is
/// marked failed; resuming one that is neither held nor on its way to a place, nor marked failed; giving back one that
/// nobody took over; landing, holding, sending or taking over one that is not in the air; holding or sending one that
/// is marked failed; anything but another emergency stop for one whose motors were stopped in the air. Landing or
/// holding one that is about to take off takes that back: it stays down, and lands should it rise all the same.
[[nodiscard]] bool apply_wish(DroneMemory& memory, CommandKind wish, const Vec2& place = Vec2::Zero()) noexcept;

/// Decides memory.activity (12) for this tick, and moves the intent on where the vehicle has fulfilled it.
void judge(DroneMemory& memory, const HealthParameters& health, double dt_s) noexcept;

/// What to ask of the vehicle, given its activity and mode.
[[nodiscard]] Action action_for(const DroneMemory& memory) noexcept;

/// In the air as far as is known, and somewhere that is known: neither on the ground nor below the landed height. One
/// that says that it flies but was not seen yet is in the air where it is expected.
[[nodiscard]] bool is_airborne(const DroneMemory& memory, const HealthParameters& health) noexcept;

/// Whether the safety filter computes the drone's velocity: it flies by our commands, and where it is, is known.
[[nodiscard]] bool is_steered(Activity activity) noexcept;

/// Whether it goes up or down by itself over one place, or hovers because it is not tracked: commanded to stand still,
/// which is what a drone that gives way to nobody may do, since u = 0 satisfies every barrier that is not broken yet.
[[nodiscard]] bool stands_still(Activity activity) noexcept;

/// How fast it may come closer by itself, in m/s; 0 for who flies by our commands. A pilot may do anything; what has
/// failed or is not heard drifts, and is seen to: it is given a little more than it has. To assume the most of it would
/// make everybody flee from a drone that hovers, into a wall if need be. Precondition: u_max_m_s >= 0.
[[nodiscard]] double wandering_speed(const DroneMemory& memory, double u_max_m_s) noexcept;

/// Whether it is about to leave the ground.
[[nodiscard]] bool wants_up(const DroneMemory& memory) noexcept;

}  // namespace vigil::swarm
