#pragma once

#include <optional>

#include "vigil/adapters/ros/crazyswarm_port.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/observation.hpp"

namespace vigil::ros_bridge {

struct PhaseParameters {
  double altitude_m = 0.5;
  double take_off_s = 2.0;
  double landing_s = 2.0;
  double landed_height_m = 0.05;
  double land_unseen_s = 5.0;  ///< in the air without a position for so long: it is landed
  double unanswered_s = 1.0;   ///< a landing that nobody answers for so long goes on by setpoints
};

/// What a Crazyflie is doing, which Crazyswarm does not say: told from its height and from what was asked of it. Only
/// one that was asked to take off flies, until a landing was asked for, by an order or because nobody sees it any more;
/// then it lands, whatever is ordered, until it is seen on the ground. One that is above the ground for any other
/// reason (on a box, lifted by hand, started by somebody else) is somebody else's, until it is seen on the ground. One
/// thread.
///
///     (first sight) -> kGrounded | kManual          by height
///     kGrounded  -> kTakingOff                      an order to take off, passed on
///     kTakingOff -> kFlying | kGrounded             at nine tenths of the altitude | not up in time
///     kGrounded  -> kFlying                         at nine tenths of the altitude, not long after that order
///     kGrounded  -> kManual                         seen above the ground for 0.3 s otherwise
///     kManual    -> kGrounded                       seen on the ground for 0.3 s
///     kFlying    -> kLanding                        an order to land, or unseen for land_unseen_s
///     kFlying    -> kGrounded                       seen on the ground for 0.3 s
///     kLanding   -> kGrounded                       seen on the ground for 0.3 s
///     any in air -> kFalling -> kGrounded           an order to stop the motors
///
/// A drone that lands follows its setpoints until Crazyswarm has said that it lands it. Where that is refused, or
/// nobody answers for unanswered_s, setpoints bring it down, and its motors are stopped once it is seen on the ground,
/// or where it is not seen once it must be there.
class FlightPhase {
 public:
  explicit FlightPhase(const PhaseParameters& parameters) : parameters_(parameters) {}

  [[nodiscard]] swarm::VehicleMode mode() const { return mode_; }
  [[nodiscard]] bool is_airborne() const;
  /// Follows setpoints, or climbs to where it will.
  [[nodiscard]] bool flies() const;
  /// Setpoints are what keeps it in the air, or brings it down.
  [[nodiscard]] bool is_streamed() const;
  /// Is to come down by setpoints, by kDescentPerS.
  [[nodiscard]] bool descends() const;

  static constexpr double kDescentPerS = 0.25;  ///< metres

  /// Takes in where the drone is: `height_m` is that of its last believed position, age_s how old that is.
  void watch(double height_m, double age_s, double now_s);

  /// What has to be asked of the vehicle now for `action`; nothing where it has been asked for lately.
  [[nodiscard]] std::optional<VehicleCall> call_for(swarm::Action action, double age_s, double now_s) const;
  /// The call was passed on.
  void called(VehicleCall call, double now_s);
  /// What has become of the last call, as often as it is looked at.
  void answered(Answer answer, double now_s);

 private:
  /// Who brings a drone down.
  enum class Landing : std::uint8_t { kAsked, kCrazyswarms, kBySetpoints };

  void watch_height(double height_m, double now_s);
  void watch_above_ground(double height_m, double now_s);
  [[nodiscard]] bool may_come_up(double now_s) const;
  void begin_landing();
  [[nodiscard]] std::optional<VehicleCall> call_while_landing(double age_s, double now_s) const;
  [[nodiscard]] bool must_be_down(double age_s, double now_s) const;

  PhaseParameters parameters_;
  swarm::VehicleMode mode_ = swarm::VehicleMode::kUnknown;
  double called_s_ = -1e9;    ///< when the last call was passed on
  double take_off_s_ = -1e9;  ///< when a take-off was passed on that no landing has followed
  double down_since_s_ = -1.0;
  double up_since_s_ = -1.0;
  double height_m_ = 0.0;              ///< last seen
  Landing landing_ = Landing::kAsked;  ///< of one that lands
  bool flew_ = false;                  ///< when its landing was asked for, it followed setpoints
  double descends_since_s_ = 0.0;      ///< of one that is brought down by setpoints
  bool is_stop_due_ = false;           ///< setpoints brought it to the ground: its motors turn
};

}  // namespace vigil::ros_bridge
