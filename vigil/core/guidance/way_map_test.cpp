#include "vigil/core/guidance/way_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <random>

#include <gtest/gtest.h>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::guidance {
namespace {

constexpr double kClearance = 0.5;
constexpr double kWall = 0.25;
constexpr WayParameters kParameters{
    .field = {20.0, 20.0}, .wall_distance_m = kWall, .clearance_m = kClearance, .most_edges = 64};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

 private:
  std::mt19937_64 engine_;
};

using Edges = std::vector<field::Segment>;

void add(Edges& edges, const std::vector<Vec2>& vertices) {
  std::ranges::copy(field::edges({vertices}), std::back_inserter(edges));
}

WayMap map_of(const Edges& edges) {
  WayMap map(kParameters);
  map.begin(edges);
  while (!map.is_ready()) map.work(100);
  return map;
}

const std::vector<Vec2> kSquare{{8.0, 8.0}, {12.0, 8.0}, {12.0, 12.0}, {8.0, 12.0}};
/// Open to the right.
const std::vector<Vec2> kTrap{{6.0, 5.0},  {14.0, 5.0},  {14.0, 6.0},  {7.0, 6.0},
                              {7.0, 14.0}, {14.0, 14.0}, {14.0, 15.0}, {6.0, 15.0}};

/// The places where a way bends, from its beginning to its end.
std::vector<Vec2> legs(WayMap& map, const Vec2& from, const Vec2& to) {
  std::vector<Vec2> places{from};
  while (places.back() != to && places.size() < 100) {
    const auto way = map.way(places.back(), to);
    if (!way) break;
    places.push_back(way->next);
  }
  return places;
}

double least_clearance(const Edges& edges, const std::vector<Vec2>& places) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < places.size(); ++i)
    for (int k = 0; k <= 1000; ++k) {
      const Vec2 p = places[i - 1] + 0.001 * k * (places[i] - places[i - 1]);
      for (const field::Segment& edge : edges) least = std::min(least, (field::nearest_point(edge, p) - p).norm());
    }
  return least;
}

double length_of(const std::vector<Vec2>& places) {
  double sum = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) sum += (places[i] - places[i - 1]).norm();
  return sum;
}

/// The shortest way on a fine grid whose places have eight neighbours: at most 1 / cos(pi / 8) times the true one.
class GridWays {
 public:
  GridWays(const Edges& edges, double clearance_m) : edges_(edges), clearance_m_(clearance_m) {}

  [[nodiscard]] double length(const Vec2& from, const Vec2& to) const {
    std::vector<double> lengths(kSide * kSide, HUGE_VAL);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    lengths[at(from)] = 0.0;
    open.emplace(0.0, at(from));
    while (!open.empty()) {
      const auto [length, index] = open.top();
      open.pop();
      if (length > lengths[index]) continue;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          const Vec2 p = place(index) + kStep * Vec2(dx, dy);
          if (!is_free(p)) continue;
          const double sum = length + kStep * std::hypot(dx, dy);
          if (sum >= lengths[at(p)] - 1e-12) continue;
          lengths[at(p)] = sum;
          open.emplace(sum, at(p));
        }
    }
    return lengths[at(to)];
  }

 private:
  static constexpr double kStep = 0.1;
  static constexpr std::size_t kSide = 201;

  [[nodiscard]] static std::size_t at(const Vec2& p) {
    return static_cast<std::size_t>(std::lround(p.x() / kStep)) * kSide +
           static_cast<std::size_t>(std::lround(p.y() / kStep));
  }
  [[nodiscard]] static Vec2 place(std::size_t index) {
    return kStep * Vec2(static_cast<double>(index / kSide), static_cast<double>(index % kSide));
  }
  [[nodiscard]] bool is_free(const Vec2& p) const {
    const double wall = std::min({p.x(), p.y(), 20.0 - p.x(), 20.0 - p.y()});
    if (wall < kWall || safety::is_enclosed(edges_, p)) return false;
    return std::ranges::all_of(
        edges_, [&](const field::Segment& edge) { return (field::nearest_point(edge, p) - p).norm() >= clearance_m_; });
  }

  const Edges& edges_;
  double clearance_m_;
};

TEST(WayMap, Where_nothing_is_in_the_way_it_is_straight) {
  WayMap map = map_of({});
  const auto way = map.way({1.0, 2.0}, {19.0, 3.0});
  ASSERT_TRUE(way);
  EXPECT_EQ(way->next, Vec2(19.0, 3.0));
  EXPECT_DOUBLE_EQ(way->length_m, std::hypot(18.0, 1.0));
}

TEST(WayMap, Round_a_square_it_is_two_tangents_and_what_lies_between_them) {
  Edges edges;
  add(edges, kSquare);
  WayMap map = map_of(edges);
  const std::vector<Vec2> places = legs(map, {6.0, 9.0}, {14.0, 9.0});
  EXPECT_GE(least_clearance(edges, places), kClearance);
  // Two tangents of a circle round a corner, and two arcs; polygons round circles are longer, corners are farther out.
  const double tangent = std::sqrt(5.0 - kClearance * kClearance);
  const double arc = kClearance * (std::atan2(1.0, 2.0) + std::asin(kClearance / std::sqrt(5.0)));
  const double least = 2.0 * tangent + 2.0 * arc + 4.0;
  EXPECT_GE(length_of(places), least);
  EXPECT_LE(length_of(places), least + 0.2 * kClearance);
}

TEST(WayMap, It_leads_out_of_a_trap_and_into_it) {
  Edges edges;
  add(edges, kTrap);
  WayMap map = map_of(edges);
  for (const auto& [from, to] :
       {std::pair{Vec2(9.0, 10.0), Vec2(3.0, 10.0)}, std::pair{Vec2(3.0, 10.0), Vec2(9.0, 10.0)}}) {
    const std::vector<Vec2> places = legs(map, from, to);
    ASSERT_EQ(places.back(), to);
    EXPECT_GE(places.size(), 4U);
    EXPECT_GE(least_clearance(edges, places), kClearance);
  }
}

TEST(WayMap, Polygons_whose_gap_is_too_narrow_are_gone_round_together) {
  Edges edges;
  add(edges, {{9.0, 4.0}, {11.0, 4.0}, {11.0, 9.6}, {9.0, 9.6}});
  add(edges, {{9.0, 10.4}, {11.0, 10.4}, {11.0, 16.0}, {9.0, 16.0}});
  WayMap map = map_of(edges);
  const auto way = map.way({7.0, 10.0}, {13.0, 10.0});
  ASSERT_TRUE(way);
  EXPECT_GT(way->length_m, 12.0);
}

TEST(WayMap, Between_a_polygon_and_a_wall_that_leave_no_room_there_is_no_way) {
  Edges edges;
  add(edges, {{9.0, 0.5}, {11.0, 0.5}, {11.0, 19.5}, {9.0, 19.5}});
  WayMap map = map_of(edges);
  EXPECT_FALSE(map.way({5.0, 10.0}, {15.0, 10.0}));
}

TEST(WayMap, To_a_place_inside_of_a_polygon_there_is_no_way) {
  Edges edges;
  add(edges, kSquare);
  WayMap map = map_of(edges);
  EXPECT_FALSE(map.way({5.0, 10.0}, {10.0, 10.0}));
  EXPECT_FALSE(map.way({10.0, 10.0}, {5.0, 10.0}));
}

TEST(WayMap, Who_is_closer_to_a_polygon_than_allowed_finds_its_way_from_there) {
  Edges edges;
  add(edges, kSquare);
  WayMap map = map_of(edges);
  const std::vector<Vec2> places = legs(map, {7.8, 10.0}, {14.0, 10.0});
  ASSERT_EQ(places.back(), Vec2(14.0, 10.0));
  EXPECT_GE(least_clearance(edges, places), 0.2 - 1e-9);
}

TEST(WayMap, What_is_not_a_number_has_no_way) {
  WayMap map = map_of({});
  EXPECT_FALSE(map.way({std::nan(""), 1.0}, {2.0, 2.0}));
  EXPECT_FALSE(map.way({1.0, 1.0}, {HUGE_VAL, 2.0}));
}

TEST(WayMap, More_corners_than_it_keeps_leave_ways_clear) {
  Edges edges;
  std::vector<Vec2> circle;
  for (int i = 0; i < 500; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 500.0;
    circle.emplace_back(10.0 + 5.0 * std::cos(angle), 10.0 + 5.0 * std::sin(angle));
  }
  add(edges, circle);
  WayParameters parameters = kParameters;
  parameters.most_edges = 500;
  WayMap map(parameters);
  map.begin(edges);
  while (!map.is_ready()) map.work(100'000);
  EXPECT_EQ(map.corners().size(), WayMap::kMostCorners);
  const std::vector<Vec2> places = legs(map, {2.0, 10.0}, {18.0, 10.0});
  EXPECT_EQ(places.back(), Vec2(18.0, 10.0));
  EXPECT_GE(least_clearance(edges, places), kClearance);
}

/// Two or three rectangles, turned, anywhere.
Edges random_ground(Random& random) {
  Edges edges;
  for (int k = 0; k < 3; ++k) {
    const Vec2 centre(random.uniform(3.0, 17.0), random.uniform(3.0, 17.0));
    const double angle = random.uniform(0.0, std::numbers::pi);
    const Vec2 along = random.uniform(0.5, 4.0) * Vec2(std::cos(angle), std::sin(angle));
    const Vec2 across = random.uniform(0.2, 1.5) * Vec2(-std::sin(angle), std::cos(angle));
    add(edges, {centre - along - across, centre + along - across, centre + along + across, centre - along + across});
  }
  return edges;
}

TEST(WayMap, No_way_on_a_fine_grid_is_shorter_and_none_much_longer) {
  Random random(7);
  int compared = 0;
  for (int ground = 0; ground < 20; ++ground) {
    const Edges edges = random_ground(random);
    WayMap map = map_of(edges);
    const GridWays wide(edges, 1.25 * kClearance);  // where corners' rounding and the grid's own have room
    for (int k = 0; k < 3; ++k) {
      const Vec2 from(0.1 * std::round(random.uniform(5.0, 195.0)), 0.1 * std::round(random.uniform(5.0, 195.0)));
      const Vec2 to(0.1 * std::round(random.uniform(5.0, 195.0)), 0.1 * std::round(random.uniform(5.0, 195.0)));
      const double grid = wide.length(from, to);
      if (grid == HUGE_VAL) continue;
      const auto way = map.way(from, to);
      ASSERT_TRUE(way) << "ground " << ground << ", way " << k;
      EXPECT_LE(way->length_m, grid + 1e-9) << "ground " << ground << ", way " << k;
      EXPECT_GE(way->length_m, grid * std::cos(std::numbers::pi / 8.0) - 4.0 * kClearance);
      ++compared;
    }
  }
  EXPECT_GE(compared, 30);
}

TEST(WayMap, A_way_is_as_long_as_its_legs_there_as_back_and_clear_of_everything) {
  Random random(8);
  int bent = 0;
  for (int ground = 0; ground < 50; ++ground) {
    const Edges edges = random_ground(random);
    WayMap map = map_of(edges);
    const Vec2 from(random.uniform(0.5, 19.5), random.uniform(0.5, 19.5));
    const Vec2 to(random.uniform(0.5, 19.5), random.uniform(0.5, 19.5));
    const auto way = map.way(from, to);
    if (!way) continue;
    const auto back = map.way(to, from);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->length_m, way->length_m, 1e-9);
    const std::vector<Vec2> places = legs(map, from, to);
    EXPECT_NEAR(length_of(places), way->length_m, 1e-9);
    const double ends = std::min(least_clearance(edges, {from, from}), least_clearance(edges, {to, to}));
    EXPECT_GE(least_clearance(edges, places), std::min(kClearance, ends) - 1e-6);
    if (places.size() > 2) ++bent;
  }
  EXPECT_GE(bent, 5);
}

TEST(WayMap, Made_in_small_pieces_it_is_the_same_map) {
  Edges edges;
  add(edges, kSquare);
  add(edges, {{2.0, 2.0}, {4.0, 2.0}, {3.0, 5.0}});
  WayMap slow(kParameters);
  slow.begin(edges);
  int steps = 0;
  for (; !slow.is_ready(); ++steps) slow.work(1);
  EXPECT_GT(steps, 20);
  WayMap quick = map_of(edges);
  EXPECT_EQ(slow.way({1.0, 1.0}, {14.0, 10.0})->length_m, quick.way({1.0, 1.0}, {14.0, 10.0})->length_m);
}

TEST(WayMap, A_copy_goes_on_like_its_original_on_another_ground_too) {
  Edges edges;
  add(edges, kSquare);
  const WayMap original(kParameters);
  WayMap copy = original;
  copy.begin(edges);
  while (!copy.is_ready()) copy.work(1000);
  EXPECT_EQ(copy.corners().size(), map_of(edges).corners().size());
  EXPECT_EQ(copy.way({6.0, 10.0}, {14.0, 10.0})->length_m, map_of(edges).way({6.0, 10.0}, {14.0, 10.0})->length_m);
}

TEST(WayMap, Once_made_it_allocates_nothing) {
  Edges edges;
  add(edges, kSquare);
  WayMap map(kParameters);
  const testing::AllocationGuard guard;
  map.begin(edges);
  while (!map.is_ready()) map.work(1000);
  EXPECT_TRUE(map.way({6.0, 10.0}, {14.0, 10.0}));
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::guidance
