#include "vigil/adapters/geography/outlines.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace vigil::geography {
namespace {

TEST(Outlines, A_ring_ends_where_it_begins_whichever_way_it_came) {
  const std::vector<Vec2> clockwise{{0.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}};
  const std::vector<Vec2> ring = closed_ring(clockwise);
  EXPECT_EQ(ring, (std::vector<Vec2>{{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}));
  EXPECT_EQ(closed_ring(std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}).size(), 4U);
}

TEST(Outlines, The_field_is_turned_and_moved_into_the_world) {
  runtime::Mission mission;
  mission.field = {.size_m = {2.0, 1.0}, .origin_m = {10.0, 20.0}, .yaw_rad = std::numbers::pi / 2.0, .datum = {}};
  const std::vector<Vec2> corners = field_outline(mission);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_NEAR((corners[1] - Vec2(10.0, 22.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((corners[3] - Vec2(9.0, 20.0)).norm(), 0.0, 1e-12);
}

TEST(Outlines, Times_of_day_are_in_utc_with_milliseconds) {
  EXPECT_EQ(time_of_day(0, 0.0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(time_of_day(951'782'400'000'000'000, 86'399.9994), "2000-02-29T23:59:59.999Z");
}

}  // namespace
}  // namespace vigil::geography
