#include "vigil/core/dynamics/failsafe.hpp"

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

using enum FailsafePhase;

/// The phase after a silence, passed in ticks of a hundredth of it.
FailsafeState silent_for(const Failsafe& failsafe, double silence_s, FailsafeState state = {}) {
  for (int i = 0; i < 100; ++i) state = advance(failsafe, state, silence_s / 100);
  return state;
}

TEST(Failsafe, A_crazyflie_holds_then_hovers_then_falls) {
  const Failsafe failsafe = failsafe_of(VehicleKind::kCrazyflie);
  EXPECT_EQ(silent_for(failsafe, 0.9 * 0.5).phase, kFollowing);
  EXPECT_EQ(silent_for(failsafe, 1.1 * 0.5).phase, kHovering);
  EXPECT_EQ(silent_for(failsafe, 0.9 * 2.0).phase, kHovering);
  EXPECT_EQ(silent_for(failsafe, 1.1 * 2.0).phase, kMotorsCut);
}

TEST(Failsafe, An_arducopter_brakes_and_stays) {
  const Failsafe failsafe = failsafe_of(VehicleKind::kArduCopter);
  EXPECT_EQ(silent_for(failsafe, 0.9 * 3.0).phase, kFollowing);
  EXPECT_EQ(silent_for(failsafe, 1.1 * 3.0).phase, kHovering);
  EXPECT_EQ(silent_for(failsafe, 3600.0).phase, kHovering);
  EXPECT_EQ(received(failsafe, silent_for(failsafe, 60.0)).phase, kFollowing);
}

TEST(Failsafe, A_px4_that_left_its_mode_ignores_setpoints) {
  const Failsafe failsafe = failsafe_of(VehicleKind::kPx4);
  EXPECT_EQ(silent_for(failsafe, 0.9 * 1.0).phase, kFollowing);
  const FailsafeState left = silent_for(failsafe, 1.1 * 1.0);
  EXPECT_EQ(left.phase, kHovering);
  EXPECT_EQ(received(failsafe, left).phase, kHovering);
}

TEST(Failsafe, A_setpoint_starts_the_silence_anew) {
  const Failsafe failsafe = failsafe_of(VehicleKind::kCrazyflie);
  const FailsafeState heard = received(failsafe, silent_for(failsafe, 0.9 * 2.0));
  EXPECT_EQ(heard.phase, kFollowing);
  EXPECT_EQ(silent_for(failsafe, 0.9 * 0.5, heard).phase, kFollowing);
  EXPECT_EQ(silent_for(failsafe, 1.1 * 0.5, heard).phase, kHovering);
}

TEST(Failsafe, What_has_ended_stays_ended) {
  const Failsafe landing{.hover_after_s = 1.0, .end_after_s = 4.0};
  for (const Failsafe& failsafe : {failsafe_of(VehicleKind::kCrazyflie), landing}) {
    const FailsafeState ended = silent_for(failsafe, 10.0);
    EXPECT_EQ(ended.phase, failsafe.end);
    EXPECT_EQ(received(failsafe, ended).phase, failsafe.end);
    EXPECT_EQ(silent_for(failsafe, 10.0, received(failsafe, ended)).phase, failsafe.end);
  }
}

TEST(Failsafe, One_long_gap_ends_where_many_short_ones_do) {
  const Failsafe failsafe = failsafe_of(VehicleKind::kCrazyflie);
  EXPECT_EQ(advance(failsafe, {}, 5.0).phase, kMotorsCut);
  EXPECT_EQ(advance(failsafe_of(VehicleKind::kIdeal), {}, 1e9).phase, kFollowing);
}

}  // namespace
}  // namespace vigil::dynamics
