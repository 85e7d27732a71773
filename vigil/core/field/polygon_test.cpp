#include "vigil/core/field/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::field {
namespace {

const Polygon kSquare{{{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}}};
// An L, clockwise: the square [0, 2]^2 without its upper right quarter.
const Polygon kClockwiseL{{{0.0, 0.0}, {0.0, 2.0}, {1.0, 2.0}, {1.0, 1.0}, {2.0, 1.0}, {2.0, 0.0}}};

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  return polygon;
}

// Star-shaped about (0, 0), so simple; counter-clockwise.
Polygon star(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.5, 1.5);
  Polygon polygon;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    polygon.vertices.emplace_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

double left_of(const Segment& s, const Vec2& p) {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  return along.x() * to_p.y() - along.y() * to_p.x();
}

TEST(NearestPointTest, It_is_the_foot_of_the_perpendicular_or_an_end) {
  const Segment s{{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_EQ(nearest_point(s, {0.5, 3.0}), Vec2(0.5, 0.0));
  EXPECT_EQ(nearest_point(s, {-1.0, 1.0}), Vec2(0.0, 0.0));
  EXPECT_EQ(nearest_point(s, {5.0, -1.0}), Vec2(2.0, 0.0));
}

TEST(NearestPointTest, A_segment_without_length_is_its_end) {
  EXPECT_EQ(nearest_point({{1.0, 2.0}, {1.0, 2.0}}, {7.0, 7.0}), Vec2(1.0, 2.0));
}

TEST(PolygonAreaTest, It_does_not_depend_on_the_orientation) {
  EXPECT_DOUBLE_EQ(area(kSquare), 1.0);
  EXPECT_DOUBLE_EQ(area(kClockwiseL), 3.0);
  EXPECT_DOUBLE_EQ(area(reversed(kClockwiseL)), 3.0);
  EXPECT_EQ(area(Polygon{{{0.0, 0.0}, {1.0, 1.0}}}), 0.0);
}

TEST(PolygonContainsTest, The_notch_of_an_L_is_outside) {
  for (const Polygon& polygon : {kClockwiseL, reversed(kClockwiseL)}) {
    EXPECT_TRUE(contains(polygon, {0.5, 1.5}));
    EXPECT_TRUE(contains(polygon, {1.5, 0.5}));
    EXPECT_FALSE(contains(polygon, {1.5, 1.5}));
    EXPECT_FALSE(contains(polygon, {-0.5, 1.0}));  // level with a vertex
    EXPECT_FALSE(contains(polygon, {2.5, 1.0}));
  }
}

RC_GTEST_PROP(PolygonContainsTest, A_star_contains_just_what_its_sectors_contain, ()) {
  const Polygon polygon = star(*rc::gen::inRange<std::size_t>(3, 40), *rc::gen::inRange(0U, 1000U));
  const Vec2 p(*rc::gen::inRange(-1499, 1500) * 1e-3 + 1e-5, *rc::gen::inRange(-1499, 1500) * 1e-3 + 2e-5);
  bool in_a_sector = false;
  for (const Segment& s : edges(polygon)) {
    in_a_sector |= left_of(s, p) > 0 && left_of({Vec2::Zero(), s.a}, p) > 0 && left_of({s.b, Vec2::Zero()}, p) > 0;
  }
  if (polygon.vertices.size() > 3) RC_ASSERT(contains(polygon, p) == in_a_sector);
}

TEST(SignedDistanceTest, It_is_negative_inside_and_positive_outside) {
  EXPECT_DOUBLE_EQ(signed_distance(kSquare, {1.5, 1.25}), -0.25);
  EXPECT_DOUBLE_EQ(signed_distance(kSquare, {1.5, 0.25}), 0.75);
  EXPECT_DOUBLE_EQ(signed_distance(kSquare, {2.3, 2.4}), 0.5);
}

RC_GTEST_PROP(SignedDistanceTest, It_changes_no_faster_than_one_walks, ()) {
  const Polygon polygon = star(17, *rc::gen::inRange(0U, 1000U));
  const auto coordinate = [] { return *rc::gen::inRange(-2000, 2000) * 1e-3; };
  const Vec2 p(coordinate(), coordinate());
  const Vec2 q(coordinate(), coordinate());
  RC_ASSERT(std::abs(signed_distance(polygon, p) - signed_distance(polygon, q)) <= (p - q).norm() + 1e-12);
}

TEST(IsSimpleTest, Ordinary_outlines_are_simple_in_either_orientation) {
  EXPECT_TRUE(is_simple(kSquare));
  EXPECT_TRUE(is_simple(kClockwiseL));
  EXPECT_TRUE(is_simple(reversed(kClockwiseL)));
  EXPECT_TRUE(is_simple(star(1000, 1)));
}

TEST(IsSimpleTest, A_vertex_on_a_straight_side_does_no_harm) {
  EXPECT_TRUE(is_simple({{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}}}));
}

TEST(IsSimpleTest, Too_few_vertices_or_no_area_is_refused) {
  EXPECT_FALSE(is_simple({}));
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, 0.0}}}));
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}}));
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}}}));
}

TEST(IsSimpleTest, Crossing_edges_are_refused) {
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}));
}

TEST(IsSimpleTest, A_vertex_that_touches_another_edge_is_refused) {
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {1.0, 0.0}, {0.0, 2.0}}}));
}

TEST(IsSimpleTest, A_vertex_that_touches_another_vertex_is_refused) {
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}, {2.0, 2.0}, {1.0, 1.0}, {0.0, 2.0}}}));
}

TEST(IsSimpleTest, A_spike_and_a_repeated_vertex_are_refused) {
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {2.0, 1.0}, {0.0, 1.0}}}));
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}));
}

TEST(IsSimpleTest, A_vertex_that_is_not_a_number_is_refused) {
  EXPECT_FALSE(is_simple({{{0.0, 0.0}, {1.0, std::nan("")}, {0.0, 1.0}}}));
}

// The last vertex lies within a rounding error of the long side; which side of it decides whether the outline crosses
// itself.
TEST(IsSimpleTest, It_is_decided_exactly_within_a_rounding_error_of_touching) {
  const auto outline = [](double y) { return Polygon{{{0.1, 0.1}, {0.7, 0.7}, {0.7, 2.0}, {0.3, y}, {0.1, 2.0}}}; };
  EXPECT_FALSE(is_simple(outline(0.3)));
  EXPECT_TRUE(is_simple(outline(std::nextafter(0.3, 1.0))));
  EXPECT_FALSE(is_simple(outline(std::nextafter(0.3, 0.0))));
}

RC_GTEST_PROP(EdgesTest, The_inside_lies_on_the_left_whatever_the_orientation, ()) {
  const Polygon polygon = star(*rc::gen::inRange<std::size_t>(4, 40), *rc::gen::inRange(0U, 1000U));
  const bool turned = *rc::gen::arbitrary<bool>();
  for (const Segment& s : edges(turned ? reversed(polygon) : polygon)) {
    const Vec2 along = (s.b - s.a).normalized();
    const Vec2 just_left = 0.5 * (s.a + s.b) + 1e-6 * Vec2(-along.y(), along.x());
    RC_ASSERT(contains(polygon, just_left));
  }
}

RC_GTEST_PROP(EdgesTest, They_form_one_closed_walk, ()) {
  const Polygon polygon = star(*rc::gen::inRange<std::size_t>(3, 40), *rc::gen::inRange(0U, 1000U));
  const std::vector<Segment> outline = edges(*rc::gen::arbitrary<bool>() ? reversed(polygon) : polygon);
  RC_ASSERT(outline.size() == polygon.vertices.size());
  for (std::size_t i = 0; i < outline.size(); ++i) RC_ASSERT(outline[i].b == outline[(i + 1) % outline.size()].a);
}

TEST(EdgesTest, Two_points_have_no_outline) { EXPECT_TRUE(edges({{{0.0, 0.0}, {1.0, 0.0}}}).empty()); }

}  // namespace
}  // namespace vigil::field
