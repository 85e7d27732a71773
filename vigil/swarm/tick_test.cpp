#include "vigil/swarm/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "vigil/core/field/density.hpp"
#include "vigil/swarm/ideal_world_for_tests.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::swarm {
namespace {

/// The laboratory under the paper's own barrier.
SwarmParameters parameters(std::size_t drones) {
  SwarmParameters parameters = laboratory(drones);
  parameters.barrier.kind = safety::BarrierKind::kPaper;
  parameters.barrier.pair_gain = 10.0;
  parameters.barrier.wall_gain = 10.0;
  return parameters;
}

std::shared_ptr<const CoverageTarget> target_around(const SwarmState& state, const Vec2& mean) {
  const std::array<field::Gaussian, 1> mixture{{{mean, 0.04 * Eigen::Matrix2d::Identity()}}};
  const std::array<double, 1> weight{1.0};
  const auto density = field::rasterise(state.parameters().field, mixture, weight, {128, 128});
  auto target = std::make_shared<CoverageTarget>();
  target->phi_k = ergodic::target_coefficients(state.basis(), *density);
  target->has_targets = true;
  return target;
}

Command set_target(std::shared_ptr<const CoverageTarget> target) {
  return {.kind = CommandKind::kSetTarget, .drone = {}, .target = std::move(target)};
}

TEST(Tick, Covering_drones_bring_the_metric_down) {
  IdealWorld world(parameters(3), {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}});
  world.step({set_target(target_around(world.state, {1.5, 2.0}))});
  EXPECT_DOUBLE_EQ(world.snapshot.metric_percent, 100.0);
  world.run(60.0);
  EXPECT_LT(world.snapshot.metric_percent, 20.0);
  EXPECT_EQ(world.snapshot.active, 3U);
}

TEST(Tick, The_gradient_controller_brings_the_metric_down_too) {
  SwarmParameters gradient = parameters(3);
  gradient.controller = ergodic::ControllerKind::kGradient;
  IdealWorld world(gradient, {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}});
  world.step({set_target(target_around(world.state, {1.5, 2.0}))});
  world.run(60.0);
  EXPECT_LT(world.snapshot.metric_percent, 20.0);
}

TEST(Tick, New_targets_make_every_drone_decide_at_once) {
  IdealWorld world(parameters(3), {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}});
  const auto wanted = [&](std::size_t drone) { return world.snapshot.drones[drone].u_nom; };
  world.step({set_target(target_around(world.state, {1.5, 2.0}))});
  const std::array<Vec2, 3> before{wanted(0), wanted(1), wanted(2)};
  world.step();
  for (std::size_t drone = 0; drone < 3; ++drone) EXPECT_EQ(wanted(drone), before[drone]);
  world.step({set_target(target_around(world.state, {0.5, 2.5}))});
  for (std::size_t drone = 0; drone < 3; ++drone) EXPECT_NE(wanted(drone), before[drone]);
}

TEST(Tick, Without_targets_the_drones_hover_and_the_reason_is_given) {
  IdealWorld world(parameters(2), {{0.5, 0.5}, {2.5, 2.5}});
  world.run(1.0);
  EXPECT_EQ(world.snapshot.idle, Idle::kNoTargets);
  EXPECT_FALSE(world.snapshot.has_metric);
  for (const DroneSnapshot& drone : world.snapshot.drones) EXPECT_EQ(drone.order.velocity, Vec2::Zero());
}

TEST(Tick, Hovering_without_targets_is_no_coverage) {
  IdealWorld world(parameters(1), {{0.5, 0.5}});
  world.run(5.0);
  EXPECT_FALSE(world.state.statistics().has_samples());
}

TEST(Tick, A_landed_drone_no_longer_repels_the_others) {
  IdealWorld world(parameters(2), {{1.5, 1.5}, {0.5, 1.5}});
  world.land(0);
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  EXPECT_LT(world.least_distance(0, 1, 30.0), 0.1);
}

TEST(Tick, A_drone_that_failed_in_the_air_keeps_repelling_the_others) {
  IdealWorld world(parameters(2), {{1.5, 1.5}, {0.5, 1.5}});
  world.observations[0].mode = VehicleMode::kFailed;
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  EXPECT_GE(world.least_distance(0, 1, 30.0), 0.2);
  EXPECT_EQ(world.snapshot.active, 1U);
  EXPECT_EQ(world.snapshot.drones[0].activity, Activity::kVehicleFailed);
}

TEST(Tick, One_that_flies_unseen_is_given_the_room_where_it_was_to_start) {
  for (const auto kind : {safety::BarrierKind::kPaper, safety::BarrierKind::kLagAware}) {
    SwarmParameters expecting = parameters(2);
    expecting.barrier.kind = kind;
    expecting.starts = {{1.5, 1.5}, {0.5, 1.5}};
    IdealWorld world(expecting, {{1.5, 1.5}, {0.5, 1.5}});
    DroneObservation unseen;
    unseen.mode = VehicleMode::kFlying;
    unseen.link_age_s = 0.0;
    world.observations[0] = unseen;
    world.step({set_target(target_around(world.state, {1.5, 1.5}))});
    double least = HUGE_VAL;
    for (double t = 0.0; t < 30.0; t += kDt) {
      world.step();
      EXPECT_EQ(world.snapshot.drones[0].order.velocity, Vec2(0.0, 0.0));
      least = std::min(least, (world.observations[1].position - Vec2(1.5, 1.5)).norm());
    }
    EXPECT_GE(least, 0.2);
    EXPECT_LT(least, 0.7);
  }
}

TEST(Tick, In_the_papers_reading_a_failed_drone_is_no_obstacle) {
  SwarmParameters reading = parameters(2);
  reading.only_active_are_obstacles = true;
  IdealWorld world(reading, {{1.5, 1.5}, {0.5, 1.5}});
  world.observations[0].mode = VehicleMode::kFailed;
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  EXPECT_LT(world.least_distance(0, 1, 30.0), 0.1);
}

TEST(Tick, A_held_drone_covers_nothing_but_still_gives_way) {
  IdealWorld world(parameters(2), {{1.5, 1.5}, {1.71, 1.5}});
  world.step({set_target(target_around(world.state, {1.0, 1.5})), wish(CommandKind::kHold, 0)});
  for (double t = 0.0; t < 20.0; t += kDt) {
    world.step();
    ASSERT_GE(world.distance(0, 1), 0.2);
  }
  EXPECT_EQ(world.snapshot.drones[0].u_nom, Vec2::Zero());
  EXPECT_EQ(world.snapshot.drones[0].activity, Activity::kHeld);
}

TEST(Tick, A_take_off_waits_until_the_air_above_is_clear_and_the_others_clear_it) {
  IdealWorld world(parameters(2), {{1.5, 1.5}, {1.55, 1.5}});
  world.land(0);
  world.step();
  world.step({wish(CommandKind::kTakeOff, 0)});
  EXPECT_EQ(world.snapshot.drones[0].order.action, Action::kNone);
  int waited = 0;
  while (world.snapshot.drones[0].order.action != Action::kTakeOff && waited < 1000) {
    world.step();
    ++waited;
  }
  EXPECT_LT(waited, 1000);
  EXPECT_GE(world.distance(0, 1), 0.2 - 1e-5);
}

TEST(Tick, Who_waits_for_clear_air_is_said_to_and_stays_down_when_all_are_to_land) {
  IdealWorld world(parameters(2), {{1.5, 1.5}, {1.55, 1.5}});
  world.land(0);
  world.step();
  world.step({wish(CommandKind::kHold, 1)});
  world.step({wish(CommandKind::kTakeOff, 0)});
  EXPECT_EQ(world.snapshot.drones[0].activity, Activity::kAboutToTakeOff);
  EXPECT_EQ(world.snapshot.drones[0].order.action, Action::kNone);
  world.step({wish(CommandKind::kLand, 0), wish(CommandKind::kLand, 1)});
  world.land(1);
  for (int tick = 0; tick < 500; ++tick) {
    world.step();
    ASSERT_EQ(world.snapshot.drones[0].activity, Activity::kGrounded);
    ASSERT_EQ(world.snapshot.drones[0].order.action, Action::kNone);
  }
}

TEST(Tick, A_command_takes_effect_in_the_tick_that_it_is_given_to) {
  IdealWorld world(parameters(2), {{0.5, 0.5}, {2.5, 2.5}});
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  world.step({wish(CommandKind::kLand, 1)});
  EXPECT_EQ(world.snapshot.active, 1U);
  EXPECT_EQ(world.snapshot.drones[1].order.action, Action::kLand);
}

TEST(Tick, Commands_that_cannot_be_carried_out_are_refused_with_an_event) {
  IdealWorld world(parameters(2), {{0.5, 0.5}, {2.5, 2.5}});
  auto misshapen = std::make_shared<CoverageTarget>();
  misshapen->has_targets = true;
  misshapen->phi_k = ergodic::Coefficients::Zero(2, 2);
  world.step(
      {wish(CommandKind::kLand, 7), set_target(misshapen), set_target(nullptr), wish(CommandKind::kGiveBack, 0)});
  std::size_t refused = 0;
  for (const Event& event : world.snapshot.events) refused += event.kind == EventKind::kWishRefused ? 1U : 0U;
  EXPECT_EQ(refused, 4U);
  EXPECT_FALSE(world.state.target().has_targets);
}

TEST(Tick, Whatever_is_observed_every_order_is_finite_and_within_the_speed_limit) {
  std::mt19937_64 random(7);
  IdealWorld world(parameters(5), {{0.5, 0.5}, {1.0, 0.5}, {1.5, 0.5}, {2.0, 0.5}, {2.5, 0.5}});
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  const std::array<double, 8> odd{std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  1e300,
                                  -1e300,
                                  0.0,
                                  -5.0,
                                  1e-310};
  const auto any_odd = [&] { return odd[random() % odd.size()]; };
  for (int i = 0; i < 5000; ++i) {
    DroneObservation& observed = world.observations[random() % 5];
    switch (random() % 6) {
      case 0:
        observed.position = Vec2(any_odd(), any_odd());
        break;
      case 1:
        observed.velocity = Vec2(any_odd(), any_odd());
        break;
      case 2:
        observed.age_s = any_odd();
        break;
      case 3:
        observed.height_m = any_odd();
        break;
      case 4:
        observed.mode = static_cast<VehicleMode>(random() % 8);
        break;
      default:
        observed = world.observations[0];
        observed.position = Vec2(1.0, 1.0);
        observed.age_s = 0.0;
        break;
    }
    tick(world.state, world.observations, {}, world.snapshot);
    for (const DroneSnapshot& drone : world.snapshot.drones) {
      ASSERT_TRUE(drone.order.velocity.allFinite());
      ASSERT_LE(drone.order.velocity.norm(), 0.3 * (1.0 + 1e-12));
    }
    ASSERT_TRUE(std::isfinite(world.snapshot.metric));
  }
}

TEST(Tick, A_copy_of_the_state_continues_with_the_same_bits) {
  IdealWorld world(parameters(3), {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}});
  world.step({set_target(target_around(world.state, {1.5, 2.0}))});
  world.run(5.0);
  IdealWorld copy = world;
  for (int i = 0; i < 500; ++i) {
    world.step();
    copy.step();
    for (std::size_t drone = 0; drone < 3; ++drone)
      ASSERT_EQ(world.snapshot.drones[drone].order.velocity, copy.snapshot.drones[drone].order.velocity);
    ASSERT_EQ(world.snapshot.metric, copy.snapshot.metric);
  }
}

TEST(Tick, A_protected_part_of_another_shape_or_that_is_no_number_is_refused) {
  IdealWorld world(parameters(1), {{0.5, 0.5}});
  for (const ergodic::Coefficients& wrong :
       {ergodic::Coefficients(ergodic::Coefficients::Zero(2, 3)),
        ergodic::Coefficients(ergodic::Coefficients::Constant(world.state.basis().indices_per_axis(),
                                                              world.state.basis().indices_per_axis(), NAN))}) {
    auto target = std::make_shared<CoverageTarget>(*target_around(world.state, {1.5, 1.5}));
    target->protected_k = wrong;
    world.step({set_target(target)});
    const auto& events = world.snapshot.events;
    EXPECT_EQ(std::ranges::count(events, EventKind::kWishRefused, &Event::kind), 1);
    EXPECT_FALSE(world.snapshot.has_metric);
  }
}

TEST(Tick, Start_afresh_forgets_where_the_swarm_has_been) {
  IdealWorld world(parameters(1), {{0.5, 0.5}});
  world.step({set_target(target_around(world.state, {1.5, 1.5}))});
  world.run(20.0);
  EXPECT_LT(world.snapshot.metric_percent, 90.0);
  world.step({{.kind = CommandKind::kStartAfresh, .drone = {}, .target = {}}});
  EXPECT_DOUBLE_EQ(world.snapshot.metric_percent, 100.0);
}

TEST(Tick, It_allocates_nothing_whatever_happens) {
  IdealWorld world(parameters(4), {{0.5, 0.5}, {1.0, 0.5}, {1.5, 0.5}, {2.0, 0.5}});
  const std::vector<Command> first{set_target(target_around(world.state, {1.5, 2.0}))};
  auto protecting = std::make_shared<CoverageTarget>(*target_around(world.state, {0.5, 2.0}));
  protecting->protected_k = 0.25 * protecting->phi_k;
  const std::vector<Command> second{
      set_target(protecting), wish(CommandKind::kLand, 1), {.kind = CommandKind::kHold, .drone = {}, .target = {}}};
  testing::AllocationGuard guard;
  tick(world.state, world.observations, first, world.snapshot);
  for (int i = 0; i < 200; ++i) tick(world.state, world.observations, {}, world.snapshot);
  tick(world.state, world.observations, second, world.snapshot);
  world.observations[0].age_s = 100.0;
  for (int i = 0; i < 200; ++i) tick(world.state, world.observations, {}, world.snapshot);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::swarm
