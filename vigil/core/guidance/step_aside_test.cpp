#include "vigil/core/guidance/step_aside.hpp"

#include <gtest/gtest.h>

namespace vigil::guidance {
namespace {

AsideParameters parameters() {
  return {.field = {.length_x = 10.0, .length_y = 6.0},
          .wall_distance_m = 0.5,
          .room_m = 1.0,
          .u_max_m_s = 0.5,
          .answer_s = 0.2};
}

/// Comes from the left along the field's middle.
Stray stray() { return {{2.0, 3.0}, {0.75, 0.0}}; }

TEST(StepAside, Who_stands_in_the_way_leaves_it_sideways_to_the_nearer_side) {
  const auto above = step_aside(parameters(), stray(), {4.0, 3.1});
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->x(), 0.0, 1e-12);
  EXPECT_NEAR(above->y(), 0.5, 1e-12);
  const auto below = step_aside(parameters(), stray(), {4.0, 2.9});
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->y(), -0.5, 1e-12);
}

TEST(StepAside, Who_stands_beside_it_or_behind_or_far_ahead_is_not_concerned) {
  EXPECT_FALSE(step_aside(parameters(), stray(), {4.0, 4.01}));
  EXPECT_FALSE(step_aside(parameters(), stray(), {0.9, 3.0}));
  EXPECT_FALSE(step_aside(parameters(), stray(), {9.5, 3.0}));
}

TEST(StepAside, It_begins_early_enough_to_be_out_of_the_way_in_time) {
  const AsideParameters ours = parameters();
  Stray fast = stray();
  fast.velocity.x() = 2.0 * ours.u_max_m_s;
  Vec2 place(9.0, 3.0);
  Vec2 velocity = Vec2::Zero();
  constexpr double kDtS = 0.02;
  double least_m = 10.0;
  for (int tick = 0; tick < 500; ++tick) {
    const Vec2 wish = step_aside(ours, fast, place).value_or(Vec2::Zero());
    velocity += (kDtS / ours.answer_s) * (wish - velocity);
    place += kDtS * velocity;
    fast.position += kDtS * fast.velocity;
    least_m = std::min(least_m, (place - fast.position).norm());
  }
  EXPECT_GE(least_m, ours.room_m);
}

TEST(StepAside, Where_a_wall_leaves_no_room_it_crosses_to_the_other_side) {
  Stray along = stray();
  along.position.y() = 1.2;
  const auto wish = step_aside(parameters(), along, {4.0, 1.1});
  ASSERT_TRUE(wish);
  EXPECT_GT(wish->y(), 0.0);
}

TEST(StepAside, In_a_corner_it_takes_the_side_that_has_more_room) {
  // Slantwise to the right wall, just below the corner: there is less room below.
  const auto wish = step_aside(parameters(), {{8.6, 4.3}, {0.3, 0.3}}, {9.3, 4.95});
  ASSERT_TRUE(wish);
  EXPECT_LT(wish->x(), 0.0);
  EXPECT_GT(wish->y(), 0.0);
  const auto other = step_aside(parameters(), {{8.3, 4.6}, {0.3, 0.3}}, {9.0, 5.35});  // to the upper wall
  ASSERT_TRUE(other);
  EXPECT_GT(other->x(), 0.0);
  EXPECT_LT(other->y(), 0.0);
}

TEST(StepAside, What_is_slow_or_hovers_is_left_to_the_filter) {
  Stray slow = stray();
  slow.velocity.x() = 0.09;
  EXPECT_FALSE(step_aside(parameters(), slow, {2.5, 3.0}));
  slow.velocity.setZero();
  EXPECT_FALSE(step_aside(parameters(), slow, slow.position));
}

}  // namespace
}  // namespace vigil::guidance
