#include "vigil/swarm/activity.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace vigil::swarm {
namespace {

constexpr double kDt = 0.02;
const HealthParameters kHealth;

DroneObservation seen(VehicleMode mode = VehicleMode::kFlying) {
  DroneObservation observed;
  observed.position = Vec2(1.0, 2.0);
  observed.height_m = mode == VehicleMode::kGrounded ? 0.0 : 1.0;
  observed.age_s = 0.0;
  observed.link_age_s = 0.0;
  observed.mode = mode;
  return observed;
}

Activity judged(DroneMemory& memory, const DroneObservation& observed) {
  remember(memory, observed, kDt);
  judge(memory, kHealth, kDt);
  return memory.activity;
}

DroneMemory flying(Intent intent = Intent::kCover) {
  DroneMemory memory;
  memory.intent = intent;
  EXPECT_NE(judged(memory, seen()), Activity::kNeverSeen);
  return memory;
}

TEST(Activity, A_drone_that_was_never_seen_is_not_active_and_is_asked_nothing) {
  DroneMemory memory;
  memory.intent = Intent::kCover;
  EXPECT_EQ(judged(memory, DroneObservation{}), Activity::kNeverSeen);
  EXPECT_EQ(action_for(memory), Action::kNone);
}

TEST(Activity, A_drone_that_flies_normally_is_active_at_once) {
  DroneMemory memory;
  memory.intent = Intent::kCover;
  EXPECT_EQ(judged(memory, seen()), Activity::kActive);
  EXPECT_EQ(action_for(memory), Action::kVelocity);
}

TEST(Activity, Tracking_is_lost_just_beyond_its_timeout) {
  DroneMemory memory = flying();
  DroneObservation observed = seen();
  observed.age_s = 0.9 * kHealth.tracking_timeout_s;
  EXPECT_EQ(judged(memory, observed), Activity::kActive);
  observed.age_s = 1.1 * kHealth.tracking_timeout_s;
  EXPECT_EQ(judged(memory, observed), Activity::kTrackingLost);
}

TEST(Activity, A_silent_link_is_noticed_just_beyond_its_timeout) {
  DroneMemory memory = flying();
  DroneObservation observed = seen();
  observed.link_age_s = 1.1 * kHealth.link_timeout_s;
  EXPECT_EQ(judged(memory, observed), Activity::kLinkLost);
}

TEST(Activity, A_position_that_is_not_a_number_counts_as_not_arrived) {
  DroneMemory memory = flying();
  DroneObservation observed = seen();
  observed.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(memory, observed), Activity::kActive);  // one bad sample is only late
  EXPECT_EQ(memory.last_good.position, Vec2(1.0, 2.0));
  for (double t = 0.0; t < kHealth.tracking_timeout_s; t += kDt) (void)judged(memory, observed);
  EXPECT_EQ(memory.activity, Activity::kTrackingLost);
}

TEST(Activity, Ages_that_make_no_sense_count_as_never) {
  for (const double age : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    DroneMemory memory = flying();
    DroneObservation observed = seen();
    observed.link_age_s = age;
    EXPECT_EQ(judged(memory, observed), Activity::kLinkLost);
  }
}

TEST(Activity, A_drone_that_was_lost_is_active_again_only_after_the_recovery_time) {
  DroneMemory memory = flying();
  DroneObservation lost = seen();
  lost.age_s = 10.0;
  EXPECT_EQ(judged(memory, lost), Activity::kTrackingLost);
  double healthy_s = 0.0;
  while (judged(memory, seen()) == Activity::kRecovering) healthy_s += kDt;
  EXPECT_EQ(memory.activity, Activity::kActive);
  EXPECT_NEAR(healthy_s, kHealth.recovery_s, 2 * kDt);
}

TEST(Activity, A_low_battery_lands_the_drone_and_an_unreported_one_does_not) {
  DroneMemory memory = flying();
  DroneObservation observed = seen();
  EXPECT_EQ(judged(memory, observed), Activity::kActive);  // NaN
  observed.battery = 1.1 * kHealth.battery_reserve;
  EXPECT_EQ(judged(memory, observed), Activity::kActive);
  observed.battery = 0.9 * kHealth.battery_reserve;
  EXPECT_EQ(judged(memory, observed), Activity::kBatteryLow);
  EXPECT_EQ(action_for(memory), Action::kLand);
  observed.mode = VehicleMode::kLanding;
  (void)judged(memory, observed);
  EXPECT_EQ(action_for(memory), Action::kNone);
}

TEST(Activity, Who_has_no_more_time_left_than_a_landing_takes_lands_whatever_the_reserve_is) {
  HealthParameters health = kHealth;
  health.battery_reserve = 0.0;
  health.landing_s = 30.0;
  DroneMemory memory = flying();
  memory.energy = EnergyEstimate(120.0);
  DroneObservation observed = seen();
  double left_s = 120.0;
  for (; left_s > 0.0; left_s -= kDt) {
    observed.battery = left_s / 120.0;
    remember(memory, observed, kDt);
    judge(memory, health, kDt);
    if (memory.activity == Activity::kBatteryLow) break;
  }
  EXPECT_GT(left_s, 36.0);
  EXPECT_LT(left_s, 60.0);
}

TEST(Activity, Nothing_that_came_down_takes_off_again_by_itself) {
  for (const Intent intent : {Intent::kCover, Intent::kHold, Intent::kLand}) {
    DroneMemory memory = flying(intent);
    EXPECT_EQ(judged(memory, seen(VehicleMode::kGrounded)), Activity::kGrounded);
    EXPECT_EQ(action_for(memory), Action::kNone);
    EXPECT_EQ(memory.intent, Intent::kStayDown);
  }
}

TEST(Activity, A_take_off_brings_a_grounded_drone_into_coverage) {
  DroneMemory memory;
  (void)judged(memory, seen(VehicleMode::kGrounded));
  ASSERT_TRUE(apply_wish(memory, CommandKind::kTakeOff));
  EXPECT_EQ(judged(memory, seen(VehicleMode::kGrounded)), Activity::kAboutToTakeOff);
  EXPECT_EQ(action_for(memory), Action::kTakeOff);
  EXPECT_EQ(judged(memory, seen(VehicleMode::kTakingOff)), Activity::kTakingOff);
  EXPECT_EQ(judged(memory, seen()), Activity::kActive);
}

DroneMemory called_back(CommandKind wish) {
  DroneMemory memory;
  (void)judged(memory, seen(VehicleMode::kGrounded));
  EXPECT_TRUE(apply_wish(memory, CommandKind::kTakeOff));
  (void)judged(memory, seen(VehicleMode::kGrounded));
  EXPECT_TRUE(apply_wish(memory, wish));
  return memory;
}

TEST(Activity, To_land_or_hold_takes_a_take_off_back_that_has_not_happened_yet) {
  for (const CommandKind wish : {CommandKind::kLand, CommandKind::kHold}) {
    DroneMemory memory = called_back(wish);
    for (int tick = 0; tick < 100; ++tick) {
      EXPECT_EQ(judged(memory, seen(VehicleMode::kGrounded)), Activity::kGrounded);
      EXPECT_EQ(action_for(memory), Action::kNone);
    }
    EXPECT_FALSE(apply_wish(memory, wish));  // there is nothing more to take back
    ASSERT_TRUE(apply_wish(memory, CommandKind::kTakeOff));
    (void)judged(memory, seen(VehicleMode::kGrounded));
    EXPECT_EQ(action_for(memory), Action::kTakeOff);
  }
}

TEST(Activity, One_that_rises_although_its_take_off_was_taken_back_lands_again) {
  for (const VehicleMode mode : {VehicleMode::kTakingOff, VehicleMode::kFlying}) {
    DroneMemory memory = called_back(CommandKind::kLand);
    (void)judged(memory, seen(VehicleMode::kGrounded));
    EXPECT_EQ(judged(memory, seen(mode)), Activity::kLanding);
    EXPECT_EQ(action_for(memory), Action::kLand);
    EXPECT_EQ(judged(memory, seen(VehicleMode::kGrounded)), Activity::kGrounded);
    EXPECT_EQ(memory.intent, Intent::kStayDown);
  }
}

TEST(Activity, A_pilot_may_take_up_one_whose_take_off_was_taken_back) {
  DroneMemory memory = called_back(CommandKind::kLand);
  EXPECT_EQ(judged(memory, seen(VehicleMode::kManual)), Activity::kOverridden);
  EXPECT_EQ(judged(memory, seen()), Activity::kHeld);
}

TEST(Activity, A_faulty_drone_does_not_take_off) {
  DroneMemory memory;
  (void)judged(memory, seen(VehicleMode::kGrounded));
  ASSERT_TRUE(apply_wish(memory, CommandKind::kTakeOff));
  DroneObservation observed = seen(VehicleMode::kGrounded);
  observed.battery = 0.01;
  (void)judged(memory, observed);
  EXPECT_EQ(action_for(memory), Action::kNone);
}

TEST(Activity, An_emergency_stop_is_said_until_a_take_off_is_asked_for_on_the_ground) {
  DroneMemory memory = flying();
  ASSERT_TRUE(apply_wish(memory, CommandKind::kEmergencyStop));
  EXPECT_EQ(judged(memory, seen(VehicleMode::kFalling)), Activity::kEmergencyStop);
  EXPECT_EQ(action_for(memory), Action::kStopMotors);
  for (const CommandKind wish :
       {CommandKind::kTakeOff, CommandKind::kResume, CommandKind::kHold, CommandKind::kGiveBack})
    EXPECT_FALSE(apply_wish(memory, wish));
  (void)judged(memory, seen(VehicleMode::kGrounded));
  EXPECT_EQ(action_for(memory), Action::kStopMotors);  // the report may be wrong
  ASSERT_TRUE(apply_wish(memory, CommandKind::kTakeOff));
  (void)judged(memory, seen(VehicleMode::kGrounded));
  EXPECT_EQ(action_for(memory), Action::kTakeOff);
}

TEST(Activity, One_that_says_that_it_flies_before_it_is_seen_is_kept_in_its_place_and_can_be_landed) {
  DroneMemory memory;
  memory.intent = Intent::kCover;
  DroneObservation unseen;
  EXPECT_EQ(judged(memory, unseen), Activity::kNeverSeen);
  EXPECT_EQ(action_for(memory), Action::kNone);
  unseen.mode = VehicleMode::kFlying;
  unseen.link_age_s = 0.0;
  EXPECT_EQ(judged(memory, unseen), Activity::kNeverSeen);
  EXPECT_EQ(action_for(memory), Action::kVelocity);
  EXPECT_FALSE(is_airborne(memory, kHealth));  // nobody knows where
  memory.is_expected = true;
  EXPECT_TRUE(is_airborne(memory, kHealth));
  ASSERT_TRUE(apply_wish(memory, CommandKind::kLand));
  (void)judged(memory, unseen);
  EXPECT_EQ(action_for(memory), Action::kLand);
}

TEST(Activity, Wishes_that_make_no_sense_are_refused) {
  DroneMemory grounded;
  (void)judged(grounded, seen(VehicleMode::kGrounded));
  for (const CommandKind wish :
       {CommandKind::kLand, CommandKind::kHold, CommandKind::kOverride, CommandKind::kGiveBack, CommandKind::kResume})
    EXPECT_FALSE(apply_wish(grounded, wish)) << static_cast<int>(wish);
  DroneMemory memory = flying();
  EXPECT_FALSE(apply_wish(memory, CommandKind::kTakeOff));
  EXPECT_FALSE(apply_wish(memory, CommandKind::kResume));
  EXPECT_FALSE(apply_wish(memory, CommandKind::kGiveBack));
  EXPECT_FALSE(apply_wish(memory, CommandKind::kSetTarget));
}

TEST(Activity, Held_overridden_and_marked_failed_drones_come_back_when_told) {
  DroneMemory memory = flying();
  ASSERT_TRUE(apply_wish(memory, CommandKind::kHold));
  EXPECT_EQ(judged(memory, seen()), Activity::kHeld);
  EXPECT_EQ(action_for(memory), Action::kVelocity);  // it hovers, and still avoids others
  ASSERT_TRUE(apply_wish(memory, CommandKind::kResume));
  EXPECT_EQ(judged(memory, seen()), Activity::kActive);

  ASSERT_TRUE(apply_wish(memory, CommandKind::kOverride));
  EXPECT_EQ(judged(memory, seen(VehicleMode::kManual)), Activity::kOverridden);
  EXPECT_EQ(action_for(memory), Action::kNone);
  ASSERT_TRUE(apply_wish(memory, CommandKind::kGiveBack));
  EXPECT_EQ(judged(memory, seen()), Activity::kActive);

  ASSERT_TRUE(apply_wish(memory, CommandKind::kMarkFailed));
  EXPECT_EQ(judged(memory, seen()), Activity::kMarkedFailed);
  EXPECT_EQ(action_for(memory), Action::kNone);
  EXPECT_FALSE(apply_wish(memory, CommandKind::kHold));
  EXPECT_FALSE(apply_wish(memory, CommandKind::kGoTo));
  ASSERT_TRUE(apply_wish(memory, CommandKind::kResume));
  EXPECT_EQ(judged(memory, seen()), Activity::kActive);
}

TEST(Activity, A_drone_that_flies_unasked_is_held) {
  DroneMemory memory;
  EXPECT_EQ(judged(memory, seen()), Activity::kHeld);
  EXPECT_EQ(action_for(memory), Action::kVelocity);
}

TEST(Activity, A_landing_goes_on_when_the_tracker_loses_the_drone) {
  DroneMemory memory = flying();
  ASSERT_TRUE(apply_wish(memory, CommandKind::kLand));
  DroneObservation observed = seen();
  observed.age_s = 10.0;
  (void)judged(memory, observed);
  EXPECT_EQ(action_for(memory), Action::kLand);
}

TEST(Activity, Below_the_landed_height_a_drone_is_down) {
  DroneMemory memory = flying();
  EXPECT_TRUE(is_airborne(memory, kHealth));
  DroneObservation observed = seen(VehicleMode::kLanding);
  observed.height_m = 1.1 * kHealth.landed_height_m;
  (void)judged(memory, observed);
  EXPECT_TRUE(is_airborne(memory, kHealth));
  observed.height_m = 0.9 * kHealth.landed_height_m;
  (void)judged(memory, observed);
  EXPECT_FALSE(is_airborne(memory, kHealth));
}

}  // namespace
}  // namespace vigil::swarm
