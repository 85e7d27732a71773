#include "vigil/core/safety/passing_row.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vigil::safety {
namespace {

BarrierParameters parameters(double lag_s) {
  BarrierParameters result;
  result.kind = BarrierKind::kLagAware;
  result.separation_m = 0.3;
  result.contact_distance_m = 0.1;
  result.u_max_m_s = 0.5;
  result.dt_s = 0.02;
  result.lag_s = lag_s;
  return result;
}

Body stray(const Vec2& position, const Vec2& velocity) {
  Body body;
  body.position = position;
  body.velocity = velocity;
  body.is_controlled = false;
  body.uncooperative_speed_m_s = 0.5;
  return body;
}

/// How close a drone with v' = (u - v)/lag comes that flies `u` on, by small steps.
double least_distance(const Body& own, const Body& other, const Vec2& u, double lag_s) {
  constexpr double kStepS = 1e-3;
  Vec2 place = own.position;
  Vec2 velocity = own.velocity;
  double least = 1e9;
  for (double t = 0.0; t < 30.0; t += kStepS) {
    velocity = lag_s > 0.0 ? Vec2(u + std::exp(-kStepS / lag_s) * (velocity - u)) : u;
    place += kStepS * velocity;
    least = std::min(least, (place - (other.position + (t + kStepS) * other.velocity)).norm());
  }
  return least;
}

TEST(PassingRow, On_its_boundary_a_drone_without_lag_passes_at_just_the_radius) {
  Body own;
  own.position = Vec2(1.0, 0.2);
  const Body other = stray({3.0, 0.0}, {-0.6, 0.1});
  for (const double side : {1.0, -1.0}) {
    const auto row = passing_row(parameters(0.0), own, other, 0.3, Vec2(0.0, side), Priority::kMargin);
    ASSERT_TRUE(row);
    EXPECT_NEAR(row->normal.norm(), 1.0, 1e-12);
    const Vec2 along(-row->normal.y(), row->normal.x());
    // Any velocity of the boundary that lets them meet at all.
    const Vec2 u = row->offset * row->normal + other.velocity.dot(along) * along +
                   0.3 * (along.dot(other.position - own.position) > 0.0 ? along : Vec2(-along));
    EXPECT_NEAR(least_distance(own, other, u, 0.0), 0.3, 2e-3);
  }
}

TEST(PassingRow, With_a_lag_it_takes_in_what_the_drone_flies_on_meanwhile) {
  constexpr double kLagS = 0.3;
  Body own;
  own.position = Vec2(1.0, 0.0);
  own.velocity = Vec2(0.4, -0.1);
  const Body other = stray({3.0, 0.1}, {-0.7, 0.0});
  const auto row = passing_row(parameters(kLagS), own, other, 0.3, Vec2(0.0, -0.5), Priority::kMargin);
  ASSERT_TRUE(row);
  const Vec2 u = row->offset * row->normal;
  EXPECT_LE(u.norm(), 0.5);
  EXPECT_NEAR(least_distance(own, other, u, kLagS), 0.3, 5e-3);
}

TEST(PassingRow, The_wish_decides_on_which_side_to_pass) {
  Body own;
  const Body other = stray({2.0, 0.0}, {-0.6, 0.0});
  const auto above = passing_row(parameters(0.0), own, other, 0.3, Vec2(0.0, 0.5), Priority::kMargin);
  const auto below = passing_row(parameters(0.0), own, other, 0.3, Vec2(0.0, -0.5), Priority::kMargin);
  ASSERT_TRUE(above && below);
  EXPECT_GT(above->normal.y(), 0.9);
  EXPECT_LT(below->normal.y(), -0.9);
  EXPECT_GE(above->normal.dot(Vec2(0.0, 0.5)), above->offset);
}

TEST(PassingRow, None_of_what_flies_away_or_is_there_already) {
  Body own;
  EXPECT_FALSE(passing_row(parameters(0.0), own, stray({2.0, 0.0}, {0.6, 0.0}), 0.3, Vec2::Zero(), Priority::kMargin));
  EXPECT_FALSE(passing_row(parameters(0.0), own, stray({0.2, 0.0}, {-0.6, 0.0}), 0.3, Vec2::Zero(), Priority::kMargin));
}

}  // namespace
}  // namespace vigil::safety
