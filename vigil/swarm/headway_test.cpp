#include "vigil/swarm/headway.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace vigil::swarm {
namespace {

const Vec2 kEast(5.0, 0.0);

void fly(Headway& headway, const Vec2& told, const Vec2& flown, double for_s) {
  for (double t = 0.0; t < for_s; t += 0.1) headway.note(told, flown, 0.1);
}

TEST(Headway, Against_the_wind_less_is_counted_on_than_with_it) {
  Headway headway;
  fly(headway, kEast, Vec2(2.5, 0.0), 600.0);
  fly(headway, -kEast, -kEast, 600.0);
  EXPECT_NEAR(headway.least(kEast), 0.4, 0.01);
  EXPECT_GT(headway.least(-kEast), 0.6);
}

TEST(Headway, It_is_never_more_than_what_was_told_nor_less_than_a_fifth) {
  Headway headway;
  fly(headway, kEast, 3.0 * kEast, 600.0);
  EXPECT_LE(headway.least(kEast), 1.0);
  fly(headway, kEast, -kEast, 600.0);
  EXPECT_EQ(headway.least(kEast), Headway::kLeast);
}

TEST(Headway, What_is_not_a_number_teaches_nothing) {
  Headway headway;
  const double before = headway.least(kEast);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  headway.note(kEast, Vec2(nan, 0.0), 0.1);
  headway.note(Vec2::Zero(), kEast, 0.1);
  headway.note(Vec2(nan, nan), kEast, 0.1);
  EXPECT_EQ(headway.least(kEast), before);
  EXPECT_EQ(headway.least(Vec2(nan, 1.0)), Headway::kLeast);
}

}  // namespace
}  // namespace vigil::swarm
