#include <algorithm>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"

namespace vigil::swarm {
namespace {

/// Three drones of the laboratory, side by side.
struct World : IdealWorld {
  World() : IdealWorld(laboratory(3), {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}}) {}
  /// Whether the drone's wish of the last tick was accepted.
  [[nodiscard]] bool accepted(std::size_t drone) const {
    return std::ranges::any_of(snapshot.events, [&](const Event& event) {
      return event.kind == EventKind::kWishAccepted && event.drone == DroneId(drone);
    });
  }
};

Command go_to(std::size_t drone, const Vec2& place) {
  return {.kind = CommandKind::kGoTo, .drone = DroneId(drone), .place = place, .target = {}};
}

TEST(GoTo, A_drone_that_is_sent_to_a_place_flies_there_and_waits) {
  World world;
  world.step({go_to(0, {2.0, 2.5})});
  EXPECT_TRUE(world.accepted(0));
  EXPECT_EQ(world.activity(0), Activity::kTravelling);
  world.run(20.0);
  EXPECT_LT((world.observations[0].position - Vec2(2.0, 2.5)).norm(), 1e-3);
  EXPECT_EQ(world.activity(0), Activity::kTravelling);
}

TEST(GoTo, It_takes_no_part_in_coverage_until_it_is_resumed) {
  World world;
  world.step({go_to(0, {2.0, 2.5})});
  EXPECT_EQ(world.snapshot.active, 2U);
  world.step({wish(CommandKind::kResume, 0)});
  EXPECT_EQ(world.snapshot.active, 3U);
  EXPECT_EQ(world.activity(0), Activity::kActive);
}

TEST(GoTo, A_place_that_is_not_inside_the_field_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2& place : {Vec2(-0.1, 1.0), Vec2(1.0, 3.1), Vec2(nan, 1.0), Vec2(1.0, HUGE_VAL)}) {
    World world;
    world.step({go_to(0, place)});
    EXPECT_FALSE(world.accepted(0));
    EXPECT_EQ(world.activity(0), Activity::kActive);
  }
}

TEST(GoTo, A_place_beyond_the_wall_s_distance_is_approached_as_far_as_the_wall_allows) {
  World world;
  world.step({go_to(0, {0.5, 0.01})});
  world.run(20.0);
  EXPECT_NEAR(world.observations[0].position.y(), 0.17, 1e-3);
}

TEST(GoTo, Who_is_on_the_ground_overridden_or_marked_failed_is_not_sent_anywhere) {
  World world;
  world.step({wish(CommandKind::kMarkFailed, 1), wish(CommandKind::kOverride, 2)});
  world.observations[0].mode = VehicleMode::kGrounded;
  world.step();
  world.step({go_to(0, {1.0, 1.0}), go_to(1, {1.0, 1.0}), go_to(2, {1.0, 1.0})});
  for (std::size_t drone = 0; drone < 3; ++drone) EXPECT_FALSE(world.accepted(drone));
}

TEST(GoTo, Landing_on_the_way_ends_the_journey_for_good) {
  World world;
  world.step({go_to(0, {2.0, 2.5})});
  world.run(2.0);
  world.step({wish(CommandKind::kLand, 0)});
  EXPECT_EQ(world.activity(0), Activity::kLanding);
  world.observations[0].mode = VehicleMode::kGrounded;
  world.step();
  EXPECT_EQ(world.activity(0), Activity::kGrounded);
  world.observations[0].mode = VehicleMode::kFlying;  // it went up by itself
  world.step();
  EXPECT_EQ(world.activity(0), Activity::kHeld);
}

TEST(GoTo, A_drone_that_was_lost_on_its_way_goes_on_once_it_has_recovered) {
  World world;
  world.step({go_to(0, {2.0, 2.5})});
  world.observations[0].age_s = 10.0;
  world.step();
  EXPECT_EQ(world.activity(0), Activity::kTrackingLost);
  world.observations[0].age_s = 0.0;
  world.step();
  EXPECT_EQ(world.activity(0), Activity::kRecovering);
  world.run(20.0);
  EXPECT_LT((world.observations[0].position - Vec2(2.0, 2.5)).norm(), 1e-3);
}

TEST(GoTo, Travellers_keep_their_distance_from_those_that_cover) {
  World world;
  world.step({go_to(0, world.observations[2].position), go_to(2, world.observations[0].position)});
  double least = HUGE_VAL;
  for (int k = 0; k < 2000; ++k) {
    world.step();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, world.distance(i, j));
  }
  EXPECT_GE(least, 0.2 - 1e-9);
}

std::shared_ptr<const CoverageTarget> no_fly(const std::vector<Vec2>& outline) {
  auto target = std::make_shared<CoverageTarget>();
  target->no_fly = field::edges({outline});
  return target;
}

Command ground(const std::vector<Vec2>& outline) {
  return {.kind = CommandKind::kSetTarget, .drone = {}, .target = no_fly(outline)};
}

/// Open to the left, where the drones are.
const std::vector<Vec2> kTrap{{1.0, 1.0}, {2.2, 1.0}, {2.2, 2.2}, {1.0, 2.2},
                              {1.0, 2.1}, {2.1, 2.1}, {2.1, 1.1}, {1.0, 1.1}};

TEST(GoTo, A_drone_finds_its_way_round_a_no_fly_polygon_that_is_a_trap) {
  for (const double lag_s : {0.0, 0.3}) {
    SwarmParameters parameters = laboratory(1);
    parameters.barrier.no_fly_buffer_m = 0.1;
    parameters.barrier.lag_s = lag_s;
    IdealWorld world(parameters, {{1.6, 1.6}});
    world.step({ground(kTrap), go_to(0, {2.7, 1.6})});
    double nearest = HUGE_VAL;
    for (int k = 0; k < 1500; ++k) {
      world.step();
      for (const field::Segment& edge : field::edges({kTrap})) {
        const Vec2& p = world.observations[0].position;
        nearest = std::min(nearest, (field::nearest_point(edge, p) - p).norm());
      }
    }
    EXPECT_LT((world.observations[0].position - Vec2(2.7, 1.6)).norm(), 0.02) << lag_s;
    EXPECT_GE(nearest, 0.1 - 1e-6) << lag_s;
  }
}

TEST(GoTo, Round_corners_a_drone_does_not_slow_down) {
  SwarmParameters parameters = laboratory(1);
  parameters.barrier.no_fly_buffer_m = 0.1;
  IdealWorld world(parameters, {{0.3, 1.2}});
  world.step({ground({{1.2, 0.5}, {1.8, 0.5}, {1.8, 2.0}, {1.2, 2.0}}), go_to(0, {2.7, 1.2})});
  int steps = 0;
  while ((world.observations[0].position - Vec2(2.7, 1.2)).norm() > 0.3 && ++steps < 3000) world.step();
  // Up to the lower edge's height and back, and 0.3 m less at the end: 3.02 m at 0.3 m/s by hand.
  EXPECT_LT(steps * kDt, 1.15 * 3.02 / 0.3);
}

TEST(GoTo, A_place_inside_of_a_no_fly_polygon_is_refused) {
  World world;
  world.step({ground({{1.2, 1.2}, {1.8, 1.2}, {1.8, 1.8}, {1.2, 1.8}})});
  world.step({go_to(0, {1.5, 1.5})});
  EXPECT_FALSE(world.accepted(0));
  EXPECT_EQ(world.activity(0), Activity::kActive);
}

}  // namespace
}  // namespace vigil::swarm
