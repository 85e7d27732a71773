#include "vigil/core/guidance/way_finder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "vigil/testing/allocation_guard.hpp"

namespace vigil::guidance {
namespace {

constexpr WayParameters kParameters{
    .field = {20.0, 20.0}, .wall_distance_m = 0.5, .clearance_m = 1.0, .most_edges = 400};
const Vec2 kWest(3.0, 9.5);
const Vec2 kEast(17.0, 9.5);

std::vector<field::Segment> square() { return field::edges({{{8.0, 8.0}, {12.0, 8.0}, {12.0, 12.0}, {8.0, 12.0}}}); }

/// Flies straight to where it is led, until it is at the goal; how far that was.
double flown(WayFinder& ways, Vec2 position, const Vec2& goal, double step_m) {
  double sum = 0.0;
  for (int k = 0; k < 10'000 && (goal - position).norm() > step_m; ++k) {
    ways.begin_tick(1);
    const Vec2 way = ways.next(0, position, goal) - position;
    position += way * std::min(1.0, step_m / way.norm());
    sum += step_m;
  }
  return sum;
}

TEST(WayFinder, A_drone_is_led_along_the_shortest_way) {
  WayFinder ways(kParameters, 1);
  ways.ground_changed(square());
  ways.begin_tick(1);
  WayMap map = ways.map();
  EXPECT_NEAR(flown(ways, kWest, kEast, 0.05), map.way(kWest, kEast)->length_m, 0.2);
}

TEST(WayFinder, Who_is_carried_past_a_corner_does_not_turn_back) {
  WayFinder ways(kParameters, 1);
  ways.ground_changed(square());
  ways.begin_tick(1);
  const Vec2 corner = ways.next(0, kWest, kEast);
  ASSERT_NE(corner, kEast);
  ways.begin_tick(1);
  const Vec2 carried = corner + 0.3 * (corner - kWest).normalized();
  EXPECT_GT(ways.next(0, carried, kEast).x(), carried.x());
}

TEST(WayFinder, Without_a_way_it_is_led_straight_there) {
  WayFinder ways(kParameters, 1);
  ways.ground_changed(square());
  ways.begin_tick(1);
  const Vec2 inside(10.0, 10.0);
  EXPECT_EQ(ways.next(0, kWest, inside), inside);
}

TEST(WayFinder, Another_ground_has_other_ways) {
  WayFinder ways(kParameters, 1);
  ways.ground_changed(square());
  ways.begin_tick(1);
  EXPECT_NE(ways.next(0, kWest, kEast), kEast);
  ways.ground_changed({});
  ways.begin_tick(1);
  EXPECT_EQ(ways.next(0, kWest, kEast), kEast);
}

TEST(WayFinder, When_many_ask_at_once_they_do_it_in_turns_and_all_are_led_in_the_end) {
  std::vector<field::Segment> edges;
  for (int i = 0; i < 50; ++i) {
    const Vec2 at(1.5 + 0.35 * i, i % 2 == 0 ? 3.0 : 16.5);
    std::ranges::copy(field::edges({{at, at + Vec2(0.1, 0.0), at + Vec2(0.1, 0.1), at + Vec2(0.0, 0.1)}}),
                      std::back_inserter(edges));
  }
  std::ranges::copy(square(), std::back_inserter(edges));
  constexpr std::size_t kDrones = 20;
  WayFinder ways(kParameters, kDrones);
  ways.ground_changed(edges);
  while (!ways.map().is_ready()) ways.begin_tick(1);
  const auto led = [&] {
    std::size_t count = 0;
    ways.begin_tick(kDrones);
    for (std::size_t drone = 0; drone < kDrones; ++drone)
      if (ways.next(drone, kWest, kEast) != kEast) ++count;
    return count;
  };
  EXPECT_LT(led(), kDrones);
  for (std::size_t k = 0; k < 100; ++k) static_cast<void>(led());
  EXPECT_EQ(led(), kDrones);
}

TEST(WayFinder, Leading_allocates_nothing) {
  WayFinder ways(kParameters, 1);
  const std::vector<field::Segment> edges = square();
  const testing::AllocationGuard guard;
  ways.ground_changed(edges);
  ways.begin_tick(1);
  static_cast<void>(ways.next(0, kWest, kEast));
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::guidance
