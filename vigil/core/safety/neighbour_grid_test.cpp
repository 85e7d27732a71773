#include "vigil/core/safety/neighbour_grid.hpp"

#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace vigil::safety {
namespace {

std::vector<std::size_t> near(const NeighbourGrid& grid, const Vec2& centre, double radius) {
  std::vector<std::size_t> found;
  grid.visit_near(centre, radius, [&](std::size_t index) { found.push_back(index); });
  return found;
}

TEST(NeighbourGrid, Every_point_within_the_radius_is_visited_exactly_once) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-2.0, 6.0);  // many outside the field
  std::uniform_real_distribution<double> radius(0.0, 2.0);
  for (int round = 0; round < 200; ++round) {
    NeighbourGrid grid({4.0, 3.0}, 0.1 + radius(random), 60);
    std::vector<Vec2> points;
    for (int i = 0; i < round % 60; ++i) points.emplace_back(coordinate(random), coordinate(random));
    grid.sort(points);
    const Vec2 centre(coordinate(random), coordinate(random));
    const double r = radius(random);
    const std::vector<std::size_t> found = near(grid, centre, r);
    const std::set<std::size_t> once(found.begin(), found.end());
    ASSERT_EQ(found.size(), once.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - centre).norm() <= r) {
        ASSERT_TRUE(once.count(i) == 1) << "point " << i << " of round " << round;
      }
    }
  }
}

TEST(NeighbourGrid, Far_points_are_mostly_left_out) {
  NeighbourGrid grid({10.0, 10.0}, 0.5, 400);
  std::vector<Vec2> points;
  for (int i = 0; i < 400; ++i) points.emplace_back(0.25 + 0.5 * (i % 20), 0.25 + 0.5 * (i / 20));
  grid.sort(points);
  EXPECT_LE(near(grid, Vec2(5.0, 5.0), 0.5).size(), 16U);
}

TEST(NeighbourGrid, Points_that_are_not_finite_are_in_no_cell) {
  NeighbourGrid grid({1.0, 1.0}, 0.3, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::array points{Vec2(nan, 0.5), Vec2(0.5, 0.5), Vec2(0.5, -infinity)};
  grid.sort(points);
  EXPECT_EQ(near(grid, Vec2(0.5, 0.5), 1e9), std::vector<std::size_t>{1});
}

TEST(NeighbourGrid, Points_of_one_cell_come_in_the_order_of_their_indices) {
  NeighbourGrid grid({1.0, 1.0}, 1.0, 50);
  const std::vector<Vec2> points(50, Vec2(0.5, 0.5));
  grid.sort(points);
  const std::vector<std::size_t> found = near(grid, Vec2(0.5, 0.5), 0.1);
  ASSERT_EQ(found.size(), 50U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i);
}

TEST(NeighbourGrid, A_tiny_cell_on_a_large_field_takes_no_more_memory_than_the_points_need) {
  NeighbourGrid grid({1e6, 1e6}, 1e-3, 10);
  const std::array points{Vec2(1.0, 1.0), Vec2(1e6, 1e6)};
  grid.sort(points);
  EXPECT_EQ(near(grid, Vec2(1e6, 1e6), 1.0), std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace vigil::safety
