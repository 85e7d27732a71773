#include "vigil/core/field/density.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace vigil::field {
namespace {

constexpr Field kField{.length_x = 3.0, .length_y = 2.0};
constexpr GridShape kShape{.nx = 240, .ny = 160};

Cluster cluster_at(const Vec2& q, double weight = 1.0) { return {.name = "c", .targets = {q}, .weight = weight}; }

Polygon rectangle(const Vec2& low, const Vec2& high) { return {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}; }

Importance importance_of(std::vector<Cluster> clusters) {
  Importance importance;
  importance.clusters = std::move(clusters);
  importance.sigma_min_m = 0.15;
  return importance;
}

// The mass that the grid puts into a rectangle whose sides lie on cell borders.
double mass_within(const DensityGrid& grid, const Vec2& low, const Vec2& high) {
  double mass = 0.0;
  for (Eigen::Index ix = 0; ix < grid.values.rows(); ++ix) {
    for (Eigen::Index iy = 0; iy < grid.values.cols(); ++iy) {
      const Vec2 q = grid.midpoint(ix, iy);
      const bool inside = (q.array() > low.array()).all() && (q.array() < high.array()).all();
      if (inside) mass += grid.values(ix, iy) * grid.weights_x[ix] * grid.weights_y[iy];
    }
  }
  return mass;
}

// (1), literally.
double gaussian_density(const Gaussian& g, const Vec2& q) {
  const double z = std::sqrt(std::pow(2.0 * std::numbers::pi, 2) * g.covariance.determinant());
  return std::exp(-0.5 * (q - g.mean).dot(g.covariance.inverse() * (q - g.mean))) / z;
}

// An independent rule: five-point Gauss-Legendre on 60 x 60 panels of the field.
double mass_by_gauss_legendre(const Gaussian& g) {
  constexpr std::array kNodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                0.2369268850561891};
  constexpr int kPanels = 60;
  const Vec2 half(kField.length_x / (2 * kPanels), kField.length_y / (2 * kPanels));
  double mass = 0.0;
  for (int i = 0; i < kPanels * 5; ++i) {
    for (int j = 0; j < kPanels * 5; ++j) {
      const auto a = static_cast<std::size_t>(i % 5);
      const auto b = static_cast<std::size_t>(j % 5);
      const Vec2 q = half.cwiseProduct(Vec2(2 * (i / 5) + 1 + kNodes[a], 2 * (j / 5) + 1 + kNodes[b]));
      mass += kWeights[a] * kWeights[b] * half.prod() * gaussian_density(g, q);
    }
  }
  return mass;
}

TEST(DensityTest, Without_targets_there_is_no_density) {
  EXPECT_FALSE(rasterise(kField, Importance{}, kShape).has_value());
  EXPECT_FALSE(rasterise(kField, importance_of({cluster_at({1.0, 1.0}, 0.0)}), kShape).has_value());
}

TEST(DensityTest, A_forbidden_field_has_no_density) {
  Importance importance = importance_of({cluster_at({1.0, 1.0})});
  importance.uniform_floor = 0.5;
  importance.no_fly = {rectangle({-1.0, -1.0}, {4.0, 4.0})};
  EXPECT_FALSE(rasterise(kField, importance, kShape).has_value());
}

TEST(DensityTest, A_tail_of_a_forbidden_target_is_no_map) {
  Importance importance = importance_of({cluster_at({1.5, 1.0})});
  importance.no_fly = {rectangle({0.1, 0.1}, {2.9, 1.9})};
  EXPECT_FALSE(rasterise(kField, importance, kShape).has_value());
  importance.uniform_floor = 0.1;
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->values(0, 0), 1.0 / (6.0 - 2.8 * 1.8), 1e-9);
}

TEST(DensityTest, The_integral_of_the_density_is_1) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    Importance importance = importance_of({cluster_at({3.0 * unit(random), 2.0 * unit(random)}, 3.0)});
    if (i % 2 == 0) importance.areas = {{"a", rectangle({0.31, 0.42}, {1.3, 1.2}), 5.0, 0.1 * unit(random)}};
    if (i % 3 == 0) importance.no_fly = {rectangle({1.03, 0.52}, {1.9, 1.73})};
    if (i % 5 == 0) importance.uniform_floor = unit(random);
    const auto grid = rasterise(kField, importance, kShape);
    ASSERT_TRUE(grid.has_value());
    EXPECT_NEAR(grid->integral(), 1.0, 1e-14);
    EXPECT_GE(grid->values.minCoeff(), 0.0);
  }
}

TEST(DensityTest, A_truncated_Gaussian_is_divided_by_its_mass_inside_the_field) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 10; ++i) {
    Gaussian g{.mean = {3.0 * unit(random), 2.0 * unit(random)}, .covariance = Eigen::Matrix2d::Zero()};
    g.covariance << 0.06 + 0.05 * unit(random), 0.03 * (unit(random) - 0.5), 0.0, 0.06 + 0.05 * unit(random);
    g.covariance(1, 0) = g.covariance(0, 1);
    const auto grid = rasterise(kField, std::array{g}, std::array{2.0}, kShape);
    ASSERT_TRUE(grid.has_value());
    const double mass = gaussian_density(g, grid->midpoint(100, 70)) / grid->values(100, 70);
    EXPECT_NEAR(mass, mass_by_gauss_legendre(g), 1e-10);
  }
}

TEST(DensityTest, A_cluster_weighs_as_many_as_its_targets_times_its_multiplier) {
  Importance importance =
      importance_of({{.name = "two", .targets = {{0.7, 1.0}, {0.7, 1.0}}}, cluster_at({2.3, 1.0}, 6.0)});
  importance.sigma_min_m = 0.1;
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(mass_within(*grid, {0.0, 0.0}, {1.5, 2.0}), 2.0 / 8.0, 1e-12);
}

TEST(DensityTest, An_area_weighs_as_much_as_that_many_targets_and_is_even) {
  Importance importance = importance_of({cluster_at({0.5, 1.0}, 3.0)});
  importance.sigma_min_m = 0.05;
  importance.areas = {{.name = "a", .outline = rectangle({2.0, 0.5}, {2.5, 1.5}), .weight = 5.0}};
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(mass_within(*grid, {2.0, 0.5}, {2.5, 1.5}), 5.0 / 8.0, 1e-12);
  EXPECT_NEAR(grid->values(180, 80), 5.0 / 8.0 / 0.5, 1e-12);
}

TEST(DensityTest, A_soft_edge_falls_off_as_half_a_Gaussian) {
  Importance importance;
  importance.areas = {{.name = "a", .outline = rectangle({0.0, 0.0}, {1.5, 2.0}), .weight = 1.0, .soft_edge_m = 0.2}};
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  const double inside = grid->values(20, 80);
  EXPECT_DOUBLE_EQ(grid->values(119, 80), inside);
  const double distance = grid->midpoint(140, 80).x() - 1.5;
  EXPECT_NEAR(grid->values(140, 80) / inside, std::exp(-0.5 * std::pow(distance / 0.2, 2)), 1e-12);
  EXPECT_NEAR(1.0 / inside, 2.0 * (1.5 + 0.2 * std::sqrt(std::numbers::pi / 2.0)), 1e-5);
}

TEST(DensityTest, Nothing_is_looked_at_in_a_no_fly_area) {
  Importance importance = importance_of({cluster_at({1.5, 1.0})});
  importance.uniform_floor = 0.3;
  importance.no_fly = {rectangle({1.2, 0.6}, {1.8, 1.4})};
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_EQ(mass_within(*grid, {1.2, 0.6}, {1.8, 1.4}), 0.0);
}

TEST(DensityTest, A_cell_on_a_no_fly_outline_keeps_the_allowed_share) {
  Importance importance;
  importance.uniform_floor = 1.0;
  const double cell = 3.0 / 240.0;
  importance.no_fly = {rectangle({1.0 + 0.25 * cell, -1.0}, {4.0, 4.0})};
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->values(80, 50) / grid->values(79, 50), 0.25, 1e-12);
}

TEST(DensityTest, Two_no_fly_areas_side_by_side_leave_no_seam) {
  Importance importance;
  importance.uniform_floor = 1.0;
  importance.no_fly = {rectangle({0.5, 0.5}, {1.006, 1.5}), rectangle({1.006, 0.5}, {1.5, 1.5})};
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_EQ(mass_within(*grid, {0.5, 0.5}, {1.5, 1.5}), 0.0);
}

TEST(DensityTest, The_floor_gets_its_share_of_all_attention_evenly) {
  Importance importance = importance_of({cluster_at({0.5, 0.5})});
  importance.sigma_min_m = 0.05;
  importance.uniform_floor = 0.3;
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->values(200, 140), 0.3 / 6.0, 1e-12);
  EXPECT_NEAR(mass_within(*grid, {1.5, 0.0}, {3.0, 2.0}), 0.15, 1e-12);
}

TEST(DensityTest, A_mixture_of_no_weight_has_no_density) {
  EXPECT_FALSE(rasterise(kField, std::array{Gaussian{}}, std::array{0.0}, kShape).has_value());
  EXPECT_FALSE(rasterise(kField, std::span<const Gaussian>(), std::span<const double>(), kShape).has_value());
}

TEST(DensityTest, A_peak_narrower_than_a_cell_is_still_a_density) {
  Importance importance = importance_of({cluster_at({0.028, 0.03})});
  importance.sigma_min_m = 0.004;
  const auto grid = rasterise(kField, importance, kShape);
  ASSERT_TRUE(grid.has_value());
  EXPECT_GE(grid->values.minCoeff(), 0.0);
  EXPECT_NEAR(grid->integral(), 1.0, 1e-14);
}

TEST(GridShapeTest, The_grid_follows_the_smallest_sigma) {
  Importance importance = importance_of({cluster_at({1.0, 1.0})});
  importance.sigma_min_m = 0.1;
  const GridShape shape = grid_shape(kField, importance, 10);
  EXPECT_GE(0.1 / (3.0 / static_cast<double>(shape.nx)), 16.0);
  EXPECT_GE(0.1 / (2.0 / static_cast<double>(shape.ny)), 16.0);
  importance.areas = {{.name = "a", .outline = rectangle({0.0, 0.0}, {1.0, 1.0}), .weight = 1.0, .soft_edge_m = 0.05}};
  EXPECT_GE(grid_shape(kField, importance, 10).nx, 2 * shape.nx - 4);
}

TEST(GridShapeTest, The_grid_follows_the_basis) { EXPECT_GE(grid_shape(kField, Importance{}, 64).nx, 640); }

TEST(GridShapeTest, The_grid_stays_within_its_bounds) {
  EXPECT_EQ(grid_shape(kField, Importance{}, 1).nx, 128);
  Importance importance = importance_of({cluster_at({1.0, 1.0})});
  importance.sigma_min_m = 1e-4;
  EXPECT_EQ(grid_shape(kField, importance, 10).ny, 1024);
}

}  // namespace
}  // namespace vigil::field
