#include "vigil/core/field/gaussian_on_grid.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vigil::field {
namespace {

DensityGrid empty_grid(const Field& field, Eigen::Index nx, Eigen::Index ny) {
  return {field, Eigen::ArrayXXd::Zero(nx, ny), {}, {}};
}

/// (1), cell by cell with the C library.
double density(const Gaussian& gaussian, const Vec2& place) {
  const Vec2 d = place - gaussian.mean;
  const Eigen::Matrix2d& c = gaussian.covariance;
  const double determinant = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1);
  const double squared =
      (c(1, 1) * d.x() * d.x() - 2.0 * c(0, 1) * d.x() * d.y() + c(0, 0) * d.y() * d.y()) / determinant;
  return std::exp(-0.5 * squared) / (2.0 * std::numbers::pi * std::sqrt(determinant));
}

void expect_drawn(const Gaussian& gaussian, const Field& field, Eigen::Index nx, Eigen::Index ny) {
  DensityGrid grid = empty_grid(field, nx, ny);
  add_gaussian(gaussian, 3.0, grid);
  const double peak = 3.0 * density(gaussian, gaussian.mean);
  for (Eigen::Index iy = 0; iy < ny; ++iy)
    for (Eigen::Index ix = 0; ix < nx; ++ix) {
      const double wanted = 3.0 * density(gaussian, grid.midpoint(ix, iy));
      // The reference's own exponent is rounded, the more the larger it is.
      EXPECT_NEAR(grid.values(ix, iy), wanted, 1e-12 * wanted + 3e-18 * peak) << ix << ' ' << iy;
    }
}

Gaussian gaussian(const Vec2& mean, double xx, double xy, double yy) {
  Gaussian result;
  result.mean = mean;
  result.covariance << xx, xy, xy, yy;
  return result;
}

constexpr Field kField{4.0, 3.0};

TEST(GaussianOnGrid, It_is_the_density_in_every_cell) {
  expect_drawn(gaussian({1.3, 1.1}, 0.09, 0.0, 0.04), kField, 128, 96);
  expect_drawn(gaussian({2.7, 0.4}, 0.3, -0.21, 0.2), kField, 130, 101);
  expect_drawn(gaussian({0.0, 3.0}, 0.02, 0.013, 0.01), kField, 64, 52);
}

TEST(GaussianOnGrid, Also_of_one_that_is_wider_than_the_field_or_long_and_thin) {
  expect_drawn(gaussian({1.0, 1.0}, 25.0, 3.0, 16.0), kField, 64, 48);
  expect_drawn(gaussian({1.0, 1.0}, 4e4, 0.0, 4e4), kField, 64, 48);
  expect_drawn(gaussian({2.0, 1.5}, 1.0, 0.99, 1.0), kField, 128, 96);
}

TEST(GaussianOnGrid, One_whose_mean_is_outside_leaves_its_tail) {
  expect_drawn(gaussian({-0.5, 1.0}, 0.09, 0.01, 0.09), kField, 64, 48);
  expect_drawn(gaussian({-50.0, 1.0}, 0.09, 0.0, 0.09), kField, 64, 48);
}

TEST(GaussianOnGrid, Of_one_narrower_than_a_cell_something_is_left_wherever_it_is) {
  DensityGrid grid = empty_grid(kField, 16, 12);
  add_gaussian(gaussian({1.0, 1.0}, 1e-10, 0.0, 1e-10), 1.0, grid);
  EXPECT_GT(grid.values.sum(), 0.0);
  EXPECT_TRUE(grid.values.allFinite());
}

}  // namespace
}  // namespace vigil::field
