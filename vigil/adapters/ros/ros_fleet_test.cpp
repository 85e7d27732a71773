#include "vigil/adapters/ros/ros_fleet.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/adapters/ros/wire_for_tests.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::ros_bridge {
namespace {

using swarm::Action;
using swarm::VehicleMode;

/// The paper's three drones, of which the first is looked at.
class RosFleetTest : public ::testing::Test {
 protected:
  static constexpr double kTick = 0.02;

  RosFleetTest() {
    auto port = std::make_unique<Wire>(mission_.drones.size());
    wire_ = port.get();
    fleet_ = std::make_unique<RosFleet>(mission_, std::move(port));
  }

  /// A tick; the drone is seen where it is, or not at all.
  void tick(Action action, const Vec2& velocity = Vec2::Zero(), bool is_seen = true) {
    wire_->time_s += kTick;
    if (is_seen)
      for (std::size_t i = 0; i < seen_.size(); ++i) wire_->see(i, place_);
    fleet_->observe(runtime::MissionTime(0), seen_);
    const std::vector<swarm::DroneOrder> orders(seen_.size(), {action, velocity});
    fleet_->order(runtime::MissionTime(0), orders);
  }
  void ticks(double for_s, Action action, const Vec2& velocity = Vec2::Zero(), bool is_seen = true) {
    for (double t = 0.0; t < for_s; t += kTick) tick(action, velocity, is_seen);
  }
  void fly() {
    place_.z = 0.0;
    ticks(0.5, Action::kTakeOff);
    climb_to(0.5);
    ticks(0.2, Action::kVelocity);
    wire_->calls.clear();
    ASSERT_EQ(seen_[0].mode, VehicleMode::kFlying);
  }
  /// At a quarter of a metre per second.
  void climb_to(double height_m) {
    for (; place_.z < height_m; place_.z += 0.005) tick(Action::kVelocity);
    place_.z = height_m;
  }
  [[nodiscard]] int count(VehicleCall call) const {
    int found = 0;
    for (const auto& [drone, what] : wire_->calls) found += drone == 0 && what == call ? 1 : 0;
    return found;
  }
  [[nodiscard]] const Setpoint& setpoint() const { return wire_->setpoints[0]; }

  runtime::Mission mission_ = runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml");
  Point place_{-1.0, -1.0, 0.0};
  std::vector<swarm::DroneObservation> seen_{mission_.drones.size()};
  Wire* wire_ = nullptr;
  std::unique_ptr<RosFleet> fleet_;
};

TEST_F(RosFleetTest, Places_are_told_in_the_field_frame) {
  tick(Action::kNone);
  EXPECT_NEAR((seen_[0].position - Vec2(0.5, 0.5)).norm(), 0.0, 1e-9);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
}

TEST_F(RosFleetTest, Nothing_is_known_before_anything_came) {
  tick(Action::kNone, Vec2::Zero(), false);
  EXPECT_EQ(seen_[0].age_s, swarm::DroneObservation::kNever);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kUnknown);
}

TEST_F(RosFleetTest, A_take_off_is_asked_for_once_and_over_at_nine_tenths_of_the_altitude) {
  ticks(0.5, Action::kTakeOff);
  EXPECT_EQ(count(VehicleCall::kTakeOff), 1);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kTakingOff);
  EXPECT_FALSE(setpoint().is_streamed);
  for (place_.z = 0.0; place_.z < 0.45; place_.z += 0.01) tick(Action::kVelocity);
  tick(Action::kVelocity);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kFlying);
  EXPECT_TRUE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, Who_does_not_come_up_is_on_the_ground_again_and_may_be_asked_again) {
  ticks(10.0, Action::kTakeOff);
  EXPECT_GE(count(VehicleCall::kTakeOff), 2);
  EXPECT_LE(count(VehicleCall::kTakeOff), 3);
}

TEST_F(RosFleetTest, Nobody_takes_off_whose_tracker_is_silent) {
  tick(Action::kNone);
  ticks(2.0, Action::kTakeOff, Vec2::Zero(), false);
  wire_->calls.clear();
  ticks(8.0, Action::kTakeOff, Vec2::Zero(), false);
  EXPECT_EQ(count(VehicleCall::kTakeOff), 0);
}

TEST_F(RosFleetTest, What_is_first_seen_above_the_ground_gets_no_setpoint_and_is_not_flown) {
  for (const double height_m : {0.1, 0.5}) {
    place_.z = height_m;
    ticks(3.0, Action::kVelocity, {0.2, 0.0});
    EXPECT_EQ(seen_[0].mode, VehicleMode::kManual);
    EXPECT_FALSE(setpoint().is_streamed);
    ticks(6.0, Action::kTakeOff, Vec2::Zero(), false);
    EXPECT_TRUE(wire_->calls.empty());
  }
}

TEST_F(RosFleetTest, A_drone_that_is_lifted_by_hand_gets_no_setpoint_until_it_was_put_down_and_took_off) {
  tick(Action::kNone);
  climb_to(0.6);
  ticks(2.0, Action::kTakeOff);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kManual);
  EXPECT_FALSE(setpoint().is_streamed);
  EXPECT_TRUE(wire_->calls.empty());
  for (; place_.z > 0.0; place_.z -= 0.005) tick(Action::kNone);
  place_.z = 0.0;
  ticks(0.5, Action::kNone);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
  fly();
  EXPECT_TRUE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, A_drone_that_is_lifted_after_its_landing_gets_no_setpoint) {
  fly();
  ticks(0.1, Action::kLand);
  for (; place_.z > 0.0; place_.z -= 0.005) tick(Action::kLand);
  place_.z = 0.0;
  ticks(0.5, Action::kNone);
  climb_to(0.6);
  ticks(1.0, Action::kVelocity, {0.2, 0.0});
  EXPECT_EQ(seen_[0].mode, VehicleMode::kManual);
  EXPECT_FALSE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, A_take_off_that_Crazyswarm_was_slow_to_begin_is_flown) {
  ticks(0.5, Action::kTakeOff);
  ticks(5.0, Action::kVelocity);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
  climb_to(0.5);
  ticks(0.2, Action::kVelocity);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kFlying);
  EXPECT_TRUE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, Velocities_pass_and_height_is_kept) {
  fly();
  place_.z = 0.4;
  tick(Action::kVelocity, {0.1, -0.2});
  EXPECT_DOUBLE_EQ(setpoint().velocity_m_s.x, 0.1);
  EXPECT_DOUBLE_EQ(setpoint().velocity_m_s.y, -0.2);
  EXPECT_NEAR(setpoint().velocity_m_s.z, 0.1, 1e-4);
}

TEST_F(RosFleetTest, In_flight_every_tick_streams_whatever_is_ordered) {
  fly();
  for (const Action action : {Action::kNone, Action::kTakeOff, Action::kVelocity}) {
    const int before = wire_->flushes;
    tick(action, {0.1, 0.0});
    EXPECT_EQ(wire_->flushes, before + 1);
    EXPECT_TRUE(setpoint().is_streamed);
    EXPECT_EQ(setpoint().velocity_m_s.x, action == Action::kVelocity ? 0.1 : 0.0);
  }
}

TEST_F(RosFleetTest, A_drone_that_is_seen_farther_outside_the_field_than_the_walls_distance_is_landed) {
  fly();
  wire_->answers = Answer::kWaiting;
  const double edge_m = -1.5 - mission_.safety.wall_distance_m;
  while (place_.x > edge_m + 0.01) {
    tick(Action::kVelocity, {-0.2, 0.0});
    place_.x -= 0.2 * kTick;
  }
  EXPECT_EQ(count(VehicleCall::kLand), 0);
  EXPECT_EQ(setpoint().velocity_m_s.x, -0.2);
  place_.x = edge_m - 0.01;
  tick(Action::kVelocity, {-0.2, 0.0});
  EXPECT_EQ(count(VehicleCall::kLand), 1);
  EXPECT_TRUE(setpoint().is_streamed);
  EXPECT_EQ(setpoint().velocity_m_s.x, 0.0);
}

TEST_F(RosFleetTest, A_drone_that_is_not_seen_hovers_and_then_lands) {
  fly();
  ticks(1.0, Action::kVelocity, {0.2, 0.0}, false);
  EXPECT_TRUE(setpoint().is_streamed);
  EXPECT_EQ(setpoint().velocity_m_s.x, 0.0);
  EXPECT_EQ(setpoint().velocity_m_s.z, 0.0);
  EXPECT_EQ(count(VehicleCall::kLand), 0);
  ticks(4.5, Action::kVelocity, {0.2, 0.0}, false);
  EXPECT_EQ(count(VehicleCall::kLand), 1);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kLanding);
  EXPECT_FALSE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, A_drone_that_is_seen_again_in_time_flies_on) {
  fly();
  ticks(3.0, Action::kVelocity, {0.2, 0.0}, false);
  tick(Action::kVelocity, {0.2, 0.0});
  EXPECT_EQ(setpoint().velocity_m_s.x, 0.2);
  EXPECT_EQ(count(VehicleCall::kLand), 0);
}

TEST_F(RosFleetTest, Operators_are_told_why_positions_are_not_used_and_once_they_are_again) {
  fly();
  EXPECT_TRUE(wire_->refused.empty());
  place_.x += 2.0;
  ticks(0.4, Action::kVelocity);
  EXPECT_TRUE(wire_->refused.empty());
  ticks(2.0, Action::kVelocity);
  ASSERT_EQ(wire_->refused.size(), seen_.size());
  EXPECT_EQ(wire_->refused[0].first, 0U);
  EXPECT_NE(wire_->refused[0].second.find("farther away"), std::string::npos);
  place_.x -= 2.0;
  ticks(0.2, Action::kVelocity);
  ASSERT_EQ(wire_->refused.size(), 2 * seen_.size());
  EXPECT_EQ(wire_->refused.back().second, "");
}

TEST_F(RosFleetTest, Nothing_is_told_of_a_tracker_that_is_silent) {
  fly();
  ticks(3.0, Action::kVelocity, Vec2::Zero(), false);
  EXPECT_TRUE(wire_->refused.empty());
}

TEST_F(RosFleetTest, Two_drones_that_swap_their_names_are_not_steered_by_them) {
  fly();
  place_.x += 2.0;
  ticks(2.0, Action::kVelocity, {0.2, 0.0});
  EXPECT_EQ(setpoint().velocity_m_s.x, 0.0);
  EXPECT_GT(seen_[0].age_s, 1.9);
  EXPECT_NEAR((seen_[0].position - Vec2(0.5, 0.5)).norm(), 0.0, 1e-6);
  place_.x -= 2.0;
  tick(Action::kVelocity, {0.2, 0.0});
  EXPECT_EQ(setpoint().velocity_m_s.x, 0.2);
}

TEST_F(RosFleetTest, A_landing_is_asked_for_until_the_drone_is_on_the_ground) {
  fly();
  ticks(9.0, Action::kLand);
  EXPECT_GE(count(VehicleCall::kLand), 2);
  place_.z = 0.01;
  ticks(1.5, Action::kNone);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
}

TEST_F(RosFleetTest, Setpoints_go_on_until_Crazyswarm_has_answered_to_a_landing) {
  fly();
  wire_->answers = Answer::kWaiting;
  ticks(0.9, Action::kLand);
  EXPECT_EQ(count(VehicleCall::kLand), 1);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kLanding);
  EXPECT_TRUE(setpoint().is_streamed);
  EXPECT_GE(setpoint().velocity_m_s.z, -1e-3);
  wire_->answers = Answer::kYes;
  ticks(0.1, Action::kLand);
  EXPECT_FALSE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, A_landing_that_nobody_answers_goes_on_by_setpoints_and_the_motors_are_stopped_on_the_ground) {
  for (const Answer answer : {Answer::kWaiting, Answer::kNo}) {
    fly();
    wire_->answers = answer;
    ticks(1.2, Action::kLand);
    for (; place_.z > 0.0; place_.z -= 0.25 * kTick) {
      tick(Action::kLand);
      ASSERT_TRUE(setpoint().is_streamed);
      EXPECT_EQ(setpoint().velocity_m_s.z, -0.25);
      EXPECT_EQ(setpoint().velocity_m_s.x, 0.0);
      EXPECT_EQ(count(VehicleCall::kEmergency), 0);
    }
    place_.z = 0.0;
    ticks(0.5, Action::kLand);
    EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
    EXPECT_FALSE(setpoint().is_streamed);
    EXPECT_EQ(count(VehicleCall::kEmergency), 1);
    wire_->answers = Answer::kYes;
    ticks(5.0, Action::kNone);
    EXPECT_EQ(count(VehicleCall::kEmergency), 1);
  }
}

TEST_F(RosFleetTest, Motors_of_a_drone_that_nobody_sees_are_stopped_once_setpoints_must_have_brought_it_down) {
  fly();
  wire_->answers = Answer::kNo;
  ticks(5.5, Action::kVelocity, {0.2, 0.0}, false);
  EXPECT_EQ(setpoint().velocity_m_s.z, -0.25);
  ticks(0.5 / 0.25, Action::kVelocity, {0.2, 0.0}, false);
  EXPECT_TRUE(setpoint().is_streamed);
  EXPECT_EQ(count(VehicleCall::kEmergency), 0);
  ticks(2.5, Action::kVelocity, {0.2, 0.0}, false);
  EXPECT_EQ(count(VehicleCall::kEmergency), 1);
  EXPECT_FALSE(setpoint().is_streamed);
}

TEST_F(RosFleetTest, A_drone_that_Crazyswarm_lands_gets_no_setpoint_however_often_it_is_asked_for_again) {
  fly();
  ticks(1.0, Action::kLand);
  wire_->answers = Answer::kNo;
  for (double t = 0.0; t < 10.0; t += kTick) {
    tick(Action::kLand, Vec2::Zero(), false);
    ASSERT_FALSE(setpoint().is_streamed);
  }
  EXPECT_GE(count(VehicleCall::kLand), 2);
}

TEST_F(RosFleetTest, Motors_are_told_to_stop_until_the_drone_is_down) {
  fly();
  ticks(1.2, Action::kStopMotors);
  EXPECT_GE(count(VehicleCall::kEmergency), 2);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kFalling);
  EXPECT_FALSE(setpoint().is_streamed);
  place_.z = 0.0;
  ticks(1.5, Action::kStopMotors);
  EXPECT_EQ(seen_[0].mode, VehicleMode::kGrounded);
}

TEST_F(RosFleetTest, Without_Crazyswarm_the_link_grows_old) {
  fly();
  EXPECT_EQ(seen_[0].link_age_s, 0.0);
  wire_->connected = false;
  ticks(1.0, Action::kVelocity);
  EXPECT_NEAR(seen_[0].link_age_s, 1.0, 0.05);
}

TEST_F(RosFleetTest, A_jump_never_becomes_a_sudden_command) {
  fly();
  for (const double jump_m : {0.5, 1.0, 3.0}) {
    const Point before = place_;
    place_.x += jump_m;
    tick(Action::kVelocity, {0.1, 0.0});
    const Setpoint& now = setpoint();
    EXPECT_LE(std::hypot(now.velocity_m_s.x, now.velocity_m_s.y), 0.3);
    EXPECT_LE(std::abs(now.velocity_m_s.z), 0.3);
    EXPECT_LT(seen_[0].velocity.norm(), 0.5);
    place_ = before;
    tick(Action::kVelocity, {0.1, 0.0});
  }
}

}  // namespace
}  // namespace vigil::ros_bridge
