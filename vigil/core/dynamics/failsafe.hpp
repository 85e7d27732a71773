#pragma once

#include <limits>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {

/// What an autopilot does by itself when setpoints stay away.
enum class FailsafePhase {
  kFollowing,  ///< flies the last setpoint
  kHovering,   ///< brakes and stays: command 0
  kLanding,    ///< comes down by itself
  kMotorsCut,  ///< falls
};

/// state      | event                                     | next
/// -----------+-------------------------------------------+-------------------------------------
/// following  | silence reaches hover_after_s             | hovering
/// hovering   | silence reaches end_after_s               | `end`: landing or motors cut
/// hovering   | a setpoint, unless hovering latches       | following
/// any other  | a setpoint                                | the same: the operator must act first
///
/// Silence is the time since the last setpoint. Both bounds count from there; one that is infinite is never reached.
struct Failsafe {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double hover_after_s = kNever;                ///< > 0
  double end_after_s = kNever;                  ///< >= hover_after_s
  FailsafePhase end = FailsafePhase::kLanding;  ///< kLanding or kMotorsCut
  bool latches_hovering = false;
};

/// Recorded: Crazyflie levels after 0.5 s and cuts its motors after 2.0 s. ArduCopter brakes after 3 s and stays, ready
/// to go on (its defaults have no failsafe beyond). PX4 leaves OFFBOARD after 1 s and ignores setpoints until it is put
/// back; what it does then depends on its settings, and is taken to be hovering. The other kinds follow for ever.
[[nodiscard]] Failsafe failsafe_of(VehicleKind kind) noexcept;

/// With what velocity an autopilot that takes off, lands, or hovers by itself returns to where it came to rest, per
/// metre: the default of its position controller (PX4's MPC_XY_P 0.95, ArduCopter's PSC_POSXY_P 1). 0 for the others,
/// which only brake: a Crazyflie's failsafe levels it. 1/s.
[[nodiscard]] double position_hold_gain(VehicleKind kind) noexcept;

struct FailsafeState {
  FailsafePhase phase = FailsafePhase::kFollowing;
  double silence_s = 0.0;
};

/// dt_s >= 0 pass without a setpoint.
[[nodiscard]] FailsafeState advance(const Failsafe& failsafe, const FailsafeState& state, double dt_s) noexcept;

/// A setpoint arrives. The result's phase says whether it is flown.
[[nodiscard]] FailsafeState received(const Failsafe& failsafe, const FailsafeState& state) noexcept;

}  // namespace vigil::dynamics
