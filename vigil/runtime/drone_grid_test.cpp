#include "vigil/runtime/drone_grid.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

std::string grid_mission(const std::string& grid, const std::string& field = "size_m: [6, 4]") {
  return "format: 1\nname: grid\nfield: {" + field + "}\ndrone_grid: {" + grid +
         "}\ncontrol: {speed_limit_m_s: 0.3}\nsafety: {separation_m: 0.2, wall_distance_m: 0.5}\n";
}

double least_distance(const std::vector<Vec2>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (points[i] - points[j]).norm());
  }
  return least;
}

double least_wall_distance(const Mission& mission, const std::vector<Vec2>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) least = std::min({least, p.minCoeff(), (mission.field.size_m - p).minCoeff()});
  return least;
}

TEST(DroneGrid, It_has_as_many_drones_as_asked_for_each_with_its_own_id) {
  const Mission mission = parse_mission(grid_mission("count: 7, prefix: cf"), "grid");
  std::set<std::string> ids;
  for (const DroneEntry& drone : mission.drones) ids.insert(drone.id);
  EXPECT_EQ(ids, (std::set<std::string>{"cf1", "cf2", "cf3", "cf4", "cf5", "cf6", "cf7"}));
}

TEST(DroneGrid, Without_a_spacing_it_keeps_clear_of_walls_and_spreads_over_the_field) {
  for (int count = 1; count <= 60; ++count) {
    const Mission mission = parse_mission(grid_mission("count: " + std::to_string(count)), "grid");
    const std::vector<Vec2> starts = starts_in_field(mission);
    EXPECT_GE(least_wall_distance(mission, starts), 0.5) << count;
    // Cells of equal area would have sides of sqrt(15/count); a grid of whole rows reaches more than half of that.
    EXPECT_GE(least_distance(starts), 0.5 * std::sqrt(15.0 / count)) << count;
  }
}

TEST(DroneGrid, With_a_spacing_neighbours_are_exactly_that_far_apart_around_the_middle) {
  const Mission mission = parse_mission(grid_mission("count: 12, spacing_m: 0.3"), "grid");
  const std::vector<Vec2> starts = starts_in_field(mission);
  EXPECT_NEAR(least_distance(starts), 0.3, 1e-12);
  Vec2 mean = Vec2::Zero();
  for (const Vec2& start : starts) mean += start / 12.0;
  EXPECT_NEAR(mean.x(), 3.0, 0.3);
  EXPECT_NEAR(mean.y(), 2.0, 0.3);
}

TEST(DroneGrid, It_fills_the_field_to_the_last_place_and_not_beyond) {
  // Between the walls there are 5 m x 3 m: 6 x 4 places at 1 m.
  EXPECT_EQ(parse_mission(grid_mission("count: 24, spacing_m: 1"), "grid").drones.size(), 24U);
  EXPECT_THROW(static_cast<void>(parse_mission(grid_mission("count: 25, spacing_m: 1"), "grid")), MissionError);
}

TEST(DroneGrid, It_lies_in_the_field_wherever_the_field_is_in_the_world) {
  const Mission mission =
      parse_mission(grid_mission("count: 20", "size_m: [6, 4], origin_m: [1000, -50], yaw_rad: 1"), "grid");
  EXPECT_GE(least_wall_distance(mission, starts_in_field(mission)), 0.5);
  const Vec2 first = mission.drones[0].start_m;
  EXPECT_GT((first - Vec2(1000, -50)).dot(Vec2(std::cos(1.0), std::sin(1.0))), 0.5);
}

TEST(DroneGrid, A_hundred_thousand_drones_are_placed_within_seconds) {
  const auto begin = std::chrono::steady_clock::now();
  const Mission mission = parse_mission(grid_mission("count: 100000", "size_m: [6000, 4000]"), "grid");
  EXPECT_EQ(mission.drones.size(), 100'000U);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace vigil::runtime
