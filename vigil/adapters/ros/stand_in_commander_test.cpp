#include "vigil/adapters/ros/stand_in_commander.hpp"

#include <gtest/gtest.h>

namespace vigil::ros_bridge {
namespace {

using swarm::Action;
using swarm::VehicleMode;
using Told = StandInCrazyswarm::Told;

constexpr double kStep = 0.01;

Told setpoint(const Point& velocity, double silence_s = 0.0) {
  Told told;
  told.follows_setpoints = true;
  told.velocity_m_s = velocity;
  told.silence_s = silence_s;
  told.setpoints = 1;
  return told;
}

/// Up at half a metre.
StandInCommander flying() {
  StandInCommander commander(0.5);
  (void)commander.step({}, VehicleMode::kTakingOff, 0.5, kStep);
  return commander;
}

TEST(StandInCommander, Velocities_are_followed_up_and_down_as_well) {
  StandInCommander commander = flying();
  const swarm::DroneOrder order = commander.step(setpoint({0.1, -0.2, 0.3}), VehicleMode::kFlying, 0.5, kStep);
  EXPECT_EQ(order.action, Action::kVelocity);
  EXPECT_EQ(order.velocity, Vec2(0.1, -0.2));
  EXPECT_DOUBLE_EQ(commander.height_m(), 0.5 + 0.3 * kStep);
  for (int i = 0; i < 1000; ++i) (void)commander.step(setpoint({0.0, 0.0, -0.25}), VehicleMode::kFlying, 0.5, kStep);
  EXPECT_EQ(commander.height_m(), 0.0);
}

TEST(StandInCommander, A_drone_without_setpoints_levels_after_half_a_second_and_falls_after_two) {
  StandInCommander commander = flying();
  EXPECT_EQ(commander.step(setpoint({0.1, 0.0, 0.2}, 0.49), VehicleMode::kFlying, 0.5, kStep).velocity.x(), 0.1);
  const double height_m = commander.height_m();
  const swarm::DroneOrder level = commander.step(setpoint({0.1, 0.0, 0.2}, 0.51), VehicleMode::kFlying, 0.5, kStep);
  EXPECT_EQ(level.action, Action::kVelocity);
  EXPECT_EQ(level.velocity, Vec2(0.0, 0.0));
  EXPECT_EQ(commander.height_m(), height_m);
  EXPECT_EQ(commander.step(setpoint({}, 1.99), VehicleMode::kFlying, 0.5, kStep).action, Action::kVelocity);
  EXPECT_EQ(commander.step(setpoint({}, 2.01), VehicleMode::kFlying, 0.5, kStep).action, Action::kStopMotors);
  EXPECT_EQ(commander.falls(), 1);
}

TEST(StandInCommander, Who_has_let_go_of_setpoints_hovers_without_them) {
  StandInCommander commander = flying();
  Told told = setpoint({0.1, 0.0, 0.2}, 60.0);
  told.follows_setpoints = false;
  const swarm::DroneOrder order = commander.step(told, VehicleMode::kFlying, 0.5, kStep);
  EXPECT_EQ(order.action, Action::kVelocity);
  EXPECT_EQ(order.velocity, Vec2(0.0, 0.0));
  EXPECT_EQ(commander.height_m(), 0.5);
  EXPECT_EQ(commander.falls(), 0);
}

TEST(StandInCommander, A_landing_goes_on_from_where_the_body_is_until_it_is_on_the_ground) {
  StandInCommander commander = flying();
  for (int i = 0; i < 100; ++i) (void)commander.step(setpoint({0.0, 0.0, -0.25}), VehicleMode::kFlying, 0.5, kStep);
  Told land;
  land.land = true;
  EXPECT_EQ(commander.step(land, VehicleMode::kFlying, 0.5, kStep).action, Action::kLand);
  EXPECT_EQ(commander.step({}, VehicleMode::kLanding, 0.25, kStep).action, Action::kLand);
  EXPECT_NEAR(commander.height_m(), 0.125, 1e-9);
  EXPECT_EQ(commander.step({}, VehicleMode::kGrounded, 0.0, kStep).action, Action::kNone);
  EXPECT_EQ(commander.height_m(), 0.0);
}

TEST(StandInCommander, Setpoints_for_a_drone_on_the_ground_are_counted) {
  StandInCommander commander(0.5);
  (void)commander.step({}, VehicleMode::kGrounded, 0.0, kStep);
  EXPECT_EQ(commander.starts_by_setpoints(), 0);
  (void)commander.step(setpoint({}), VehicleMode::kGrounded, 0.0, kStep);
  EXPECT_EQ(commander.starts_by_setpoints(), 1);
}

}  // namespace
}  // namespace vigil::ros_bridge
