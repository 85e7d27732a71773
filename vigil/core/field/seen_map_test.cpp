#include "vigil/core/field/seen_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vigil::field {
namespace {

Vec2 middle_of(const SeenMap& map, std::size_t index) {
  const auto nx = static_cast<std::size_t>(map.shape().nx);
  return {(static_cast<double>(index % nx) + 0.5) * map.field().length_x / static_cast<double>(map.shape().nx),
          (static_cast<double>(index / nx) + 0.5) * map.field().length_y / static_cast<double>(map.shape().ny)};
}

TEST(SeenMapTest, A_cell_is_seen_exactly_where_its_middle_lies_within_the_radius) {
  const std::vector<Vec2> places{{1.03, 0.71}, {0.0, 0.0}, {2.9, 1.95}, {-0.2, 1.0}, {5.0, 5.0}};
  for (const Vec2& place : places) {
    SeenMap map({3.0, 2.0}, {30, 20});
    map.see(place, 0.31, 7.0);
    for (std::size_t i = 0; i < map.seen_s().size(); ++i) {
      const bool is_near = (middle_of(map, i) - place).norm() <= 0.31;
      EXPECT_EQ(map.seen_s()[i], is_near ? 7.0 : SeenMap::kNever) << i;
    }
  }
}

TEST(SeenMapTest, On_its_way_a_drone_sees_the_strip_that_it_flies_over) {
  SeenMap map({3.0, 2.0}, {60, 40});
  const Vec2 a(0.4, 0.5);
  const Vec2 b(2.6, 1.4);
  map.see(a, 0.3, 3.0);
  map.see_along(a, b, 0.3, 3.0);
  for (std::size_t i = 0; i < map.seen_s().size(); ++i) {
    const Vec2 p = middle_of(map, i);
    const double along = (p - a).dot((b - a).normalized());
    const double off = (p - a - along * (b - a).normalized()).norm();
    const bool is_beside = along > 0.0 && along < (b - a).norm();
    if (!is_beside || (off > 0.96 * 0.3 && off < 0.3)) continue;
    EXPECT_EQ(map.seen_s()[i], off < 0.3 ? 3.0 : SeenMap::kNever) << p.transpose();
  }
}

TEST(SeenMapTest, A_map_takes_up_what_another_of_its_shape_knew_and_nothing_else) {
  SeenMap map({3.0, 2.0}, {6, 4});
  map.see({1.0, 1.0}, 0.5, 2.0);
  SeenMap other({3.0, 2.0}, {6, 4});
  EXPECT_TRUE(other.restore(map.seen_s()));
  EXPECT_TRUE(std::equal(map.seen_s().begin(), map.seen_s().end(), other.seen_s().begin()));
  SeenMap smaller({3.0, 2.0}, {5, 4});
  EXPECT_FALSE(smaller.restore(map.seen_s()));
  EXPECT_FALSE(other.restore(std::vector<double>(24, std::nan(""))));
}

}  // namespace
}  // namespace vigil::field
