#include "vigil/adapters/report/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace vigil::report {
namespace {

TEST(Envelope, No_peak_is_lost_however_few_points_are_kept) {
  std::vector<double> times;
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i) {
    times.push_back(i);
    values.push_back(i == 5001 ? 7.0 : i == 123 ? -3.0 : std::sin(0.01 * i));
  }
  const Curve curve = envelope(times, values, 50);
  EXPECT_LE(curve.size(), 200U);
  EXPECT_NE(std::find(curve.begin(), curve.end(), Vec2(5001.0, 7.0)), curve.end());
  EXPECT_NE(std::find(curve.begin(), curve.end(), Vec2(123.0, -3.0)), curve.end());
  EXPECT_EQ(curve.front(), Vec2(0.0, 0.0));
  EXPECT_EQ(curve.back().x(), 9999.0);
  EXPECT_TRUE(std::is_sorted(curve.begin(), curve.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); }));
}

TEST(Envelope, Few_values_are_all_kept) {
  const std::vector<double> values{3.0, 1.0, 2.0};
  EXPECT_EQ(envelope(values, values, 500).size(), 3U);
  EXPECT_TRUE(envelope({}, {}, 5).empty());
}

TEST(Thinned, A_circle_keeps_its_shape_with_few_points) {
  Curve circle;
  for (int i = 0; i <= 6000; ++i) circle.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i));
  const Curve few = thinned(circle, 700);
  EXPECT_LE(few.size(), 700U);
  EXPECT_GE(few.size(), 300U);
  for (std::size_t i = 1; i < few.size(); ++i) EXPECT_LT((few[i] - few[i - 1]).norm(), 0.3);
  EXPECT_EQ(few.back(), circle.back());
}

TEST(Thinned, Unknown_places_break_the_line_once) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Curve curve = thinned({{nan, nan}, {0.0, 0.0}, {1.0, 0.0}, {nan, nan}, {nan, nan}, {2.0, 0.0}}, 100);
  ASSERT_EQ(curve.size(), 4U);
  EXPECT_TRUE(std::isnan(curve[2].x()));
}

TEST(Thinned, One_that_stands_still_ends_where_it_is) {
  EXPECT_LE(thinned(Curve(5000, Vec2(1.0, 2.0)), 100).size(), 5000U);
  EXPECT_EQ(thinned(Curve(5000, Vec2(1.0, 2.0)), 100).back(), Vec2(1.0, 2.0));
}

}  // namespace
}  // namespace vigil::report
