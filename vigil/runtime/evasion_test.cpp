#include "vigil/runtime/evasion.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

constexpr double kDt = 0.02;
constexpr Keep kKeep{.field = {10.0, 10.0}, .wall_distance_m = 0.5, .distance_m = 1.0};

/// Somebody that flies straight on for five seconds.
std::vector<Vec2> flight(Vec2 from, const Vec2& velocity) {
  std::vector<Vec2> places;
  for (double time_s = 0.0; time_s < 5.0; time_s += kDt) places.push_back(from + time_s * velocity);
  return places;
}

Evader at(const Vec2& place, double speed_m_s) { return {.position = place, .speed_m_s = speed_m_s}; }

TEST(Evasion, Whoever_is_not_in_the_way_may_stay) {
  EXPECT_TRUE(could_evade(at({5.0, 8.0}, 0.0), flight({1.0, 5.0}, {2.0, 0.0}), kDt, kKeep));
}

TEST(Evasion, A_step_aside_is_enough_where_there_is_time_for_it) {
  const std::vector<Vec2> comes = flight({1.0, 5.0}, {1.5, 0.0});
  EXPECT_TRUE(could_evade(at({5.0, 5.0}, 1.0), comes, kDt, kKeep));
  EXPECT_FALSE(could_evade(at({5.0, 5.0}, 0.2), comes, kDt, kKeep));
  EXPECT_FALSE(could_evade(at({2.1, 5.0}, 1.0), comes, kDt, kKeep));
}

TEST(Evasion, What_orders_and_vehicle_take_counts) {
  const std::vector<Vec2> comes = flight({3.5, 5.0}, {1.5, 0.0});
  Evader evader = at({5.0, 5.0}, 1.3);
  EXPECT_TRUE(could_evade(evader, comes, kDt, kKeep));
  evader.delay_s = 0.5;
  EXPECT_FALSE(could_evade(evader, comes, kDt, kKeep));
  evader.delay_s = 0.0;
  evader.lag_s = 1.0;
  EXPECT_FALSE(could_evade(evader, comes, kDt, kKeep));
}

TEST(Evasion, Nobody_flies_through_a_wall) {
  const std::vector<Vec2> comes = flight({5.0, 5.0}, {1.5, 0.0});
  EXPECT_FALSE(could_evade(at({9.5, 5.0}, 0.3), comes, kDt, kKeep));
  EXPECT_TRUE(could_evade(at({9.5, 5.0}, 1.0), comes, kDt, kKeep)) << "but along it";
}

TEST(Evasion, Who_is_too_close_already_cannot_be_evaded) {
  EXPECT_FALSE(could_evade(at({1.5, 5.0}, 10.0), flight({1.0, 5.0}, {1.0, 0.0}), kDt, kKeep));
}

}  // namespace
}  // namespace vigil::runtime
