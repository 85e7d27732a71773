#include "vigil/core/field/revisit.hpp"

#include <gtest/gtest.h>

namespace vigil::field {
namespace {

const Field kField{10.0, 10.0};
constexpr double kRadius = 0.5;

TEST(Places, Those_of_a_cluster_lie_in_its_ellipse_inside_the_field_and_outside_no_fly_polygons) {
  const Gaussian gaussian{Vec2(1.0, 5.0), Eigen::Vector2d(1.0, 0.25).asDiagonal()};
  const std::vector<Polygon> no_fly{{{{1.0, 4.0}, {9.0, 4.0}, {9.0, 6.0}, {1.0, 6.0}}}};
  const std::vector<Vec2> places = places_of(kField, gaussian, no_fly);
  ASSERT_GT(places.size(), 4U);
  EXPECT_LE(places.size(), 64U);
  for (const Vec2& p : places) {
    EXPECT_TRUE(kField.contains(p));
    EXPECT_FALSE(contains(no_fly[0], p));
    EXPECT_LE((p - gaussian.mean).cwiseQuotient(Vec2(1.0, 0.5)).norm(), 2.0 + 1e-12);
  }
}

TEST(Places, An_area_too_thin_for_the_raster_still_has_one) {
  const Polygon sliver{{{1.0, 1.0}, {9.0, 1.0}, {9.0, 1.001}}};
  EXPECT_GE(places_of(kField, sliver, {}).size(), 1U);
}

TEST(RevisitLog, The_worst_gap_is_that_of_the_place_that_waited_longest) {
  RevisitLog log("two", {Vec2(1.0, 1.0), Vec2(9.0, 9.0)}, 0.0);
  const std::vector<Vec2> at_first{Vec2(1.2, 1.0)};
  const std::vector<Vec2> at_second{Vec2(9.0, 8.6)};
  log.see(at_first, kRadius, 1.0);
  log.see(at_second, kRadius, 4.0);
  log.see(at_first, kRadius, 6.0);
  EXPECT_DOUBLE_EQ(log.worst_s(6.0), 5.0);   // the first place, from 1 s to 6 s
  EXPECT_DOUBLE_EQ(log.worst_s(10.0), 6.0);  // the second one, from 4 s on
  EXPECT_DOUBLE_EQ(log.age_s(10.0), 6.0);
}

TEST(RevisitLog, A_drone_just_out_of_reach_sees_nothing) {
  RevisitLog log("one", {Vec2(1.0, 1.0)}, 0.0);
  log.see(std::vector<Vec2>{Vec2(1.0 + 1.1 * kRadius, 1.0)}, kRadius, 3.0);
  EXPECT_DOUBLE_EQ(log.age_s(3.0), 3.0);
  log.see(std::vector<Vec2>{Vec2(1.0 + 0.9 * kRadius, 1.0)}, kRadius, 3.0);
  EXPECT_DOUBLE_EQ(log.age_s(3.0), 0.0);
}

TEST(RevisitLog, Other_places_begin_anew_and_the_worst_until_then_stays) {
  RevisitLog log("moving", {Vec2(1.0, 1.0)}, 0.0);
  log.watch({Vec2(5.0, 5.0)}, 7.0);
  EXPECT_DOUBLE_EQ(log.age_s(8.0), 1.0);
  EXPECT_DOUBLE_EQ(log.worst_s(8.0), 7.0);
  log.watch({Vec2(5.0, 5.0)}, 9.0);  // the same ones: nothing changes
  EXPECT_DOUBLE_EQ(log.age_s(10.0), 3.0);
}

TEST(RevisitLog, An_area_that_is_no_longer_watched_ages_no_more) {
  RevisitLog log("gone", {Vec2(1.0, 1.0)}, 0.0);
  log.watch({}, 2.0);
  EXPECT_DOUBLE_EQ(log.worst_s(100.0), 2.0);
}

}  // namespace
}  // namespace vigil::field
