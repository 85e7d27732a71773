#include "vigil/core/dynamics/failsafe.hpp"

namespace vigil::dynamics {

Failsafe failsafe_of(VehicleKind kind) noexcept {
  switch (kind) {
    case VehicleKind::kCrazyflie:
      return {.hover_after_s = 0.5, .end_after_s = 2.0, .end = FailsafePhase::kMotorsCut};
    case VehicleKind::kArduCopter:
      return {.hover_after_s = 3.0};
    case VehicleKind::kPx4:
      return {.hover_after_s = 1.0, .latches_hovering = true};
    case VehicleKind::kIdeal:
    case VehicleKind::kFirstOrderLag:
      break;
  }
  return {};
}

double position_hold_gain(VehicleKind kind) noexcept {
  switch (kind) {
    case VehicleKind::kPx4:
      return 0.95;
    case VehicleKind::kArduCopter:
      return 1.0;
    default:
      return 0.0;
  }
}

FailsafeState advance(const Failsafe& failsafe, const FailsafeState& state, double dt_s) noexcept {
  FailsafeState after{state.phase, state.silence_s + dt_s};
  if (after.phase == FailsafePhase::kFollowing && after.silence_s >= failsafe.hover_after_s)
    after.phase = FailsafePhase::kHovering;
  if (after.phase == FailsafePhase::kHovering && after.silence_s >= failsafe.end_after_s) after.phase = failsafe.end;
  return after;
}

FailsafeState received(const Failsafe& failsafe, const FailsafeState& state) noexcept {
  const bool resumes = state.phase == FailsafePhase::kHovering && !failsafe.latches_hovering;
  return {resumes ? FailsafePhase::kFollowing : state.phase, 0.0};
}

}  // namespace vigil::dynamics
