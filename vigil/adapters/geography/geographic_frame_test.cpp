#include "vigil/adapters/geography/geographic_frame.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vigil::geography {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// WGS 84.
constexpr double kEquatorM = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);

/// Radius of curvature along the meridian, M = a (1 - e^2) / (1 - e^2 sin^2 phi)^(3/2).
double meridian_radius_m(double latitude_deg) {
  const double s = std::sin(latitude_deg * kDegree);
  return kEquatorM * (1.0 - kEccentricitySquared) / std::pow(1.0 - kEccentricitySquared * s * s, 1.5);
}

/// Radius of curvature across it, N = a / sqrt(1 - e^2 sin^2 phi).
double normal_radius_m(double latitude_deg) {
  const double s = std::sin(latitude_deg * kDegree);
  return kEquatorM / std::sqrt(1.0 - kEccentricitySquared * s * s);
}

TEST(GeographicFrame, The_datum_is_the_origin_of_the_world_frame) {
  const GeographicPoint point = GeographicFrame({-33.9, 151.2}).at({0.0, 0.0});
  EXPECT_NEAR(point.latitude_deg, -33.9, 1e-12);
  EXPECT_NEAR(point.longitude_deg, 151.2, 1e-12);
}

TEST(GeographicFrame, X_points_to_the_east_by_the_radius_across_the_meridian) {
  for (const double latitude : {-60.0, 0.0, 47.0}) {
    const GeographicPoint point = GeographicFrame({latitude, 8.0}).at({100.0, 0.0});
    const double expected = 100.0 / (normal_radius_m(latitude) * std::cos(latitude * kDegree)) / kDegree;
    EXPECT_NEAR(point.longitude_deg - 8.0, expected, 1e-8 * expected);
    EXPECT_NEAR(point.latitude_deg, latitude, 2e-8);
  }
}

TEST(GeographicFrame, Y_points_to_the_north_by_the_radius_along_the_meridian) {
  for (const double latitude : {-60.0, 0.0, 47.0}) {
    const GeographicPoint point = GeographicFrame({latitude, 8.0}).at({0.0, 100.0});
    const double expected = 100.0 / meridian_radius_m(latitude) / kDegree;
    EXPECT_NEAR(point.latitude_deg - latitude, expected, 1e-6 * expected);
    EXPECT_NEAR(point.longitude_deg, 8.0, 1e-12);
  }
}

TEST(GeographicFrame, A_field_across_the_meridian_of_180_degrees_does_not_jump_round_the_earth) {
  const GeographicFrame fiji({-16.8, 179.999});
  EXPECT_GT(fiji.at({500.0, 0.0}).longitude_deg, 180.0);
  EXPECT_LT(GeographicFrame({-16.8, -179.999}).at({-500.0, 0.0}).longitude_deg, -180.0);
}

}  // namespace
}  // namespace vigil::geography
