#include "vigil/core/ergodic/basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vigil/testing/reference_mixture.hpp"

namespace vigil::ergodic {
namespace {

constexpr double kPi = std::numbers::pi;

double fraction() { return *rc::gen::inRange(0, 1001) * 1e-3; }

double largest(const Coefficients& difference) { return difference.cwiseAbs().maxCoeff(); }

// The oracle of the design: phi_k of a Gaussian all of whose mass lies inside F, in closed form.
double closed_form(const Basis& basis, const field::Gaussian& g, int k1, int k2) {
  const Vec2 a(k1 * kPi / basis.field().length_x, k2 * kPi / basis.field().length_y);
  const Vec2 mirrored(a.x(), -a.y());
  const auto term = [&g](const Vec2& v) { return std::cos(v.dot(g.mean)) * std::exp(-0.5 * v.dot(g.covariance * v)); };
  return 0.5 * (term(a) + term(mirrored)) / basis.norm()(k1, k2);
}

Coefficients coefficients_of(const Basis& basis, const ReferenceMixture& mixture, field::GridShape shape) {
  return target_coefficients(basis, field::rasterise(mixture.field, mixture.gaussians, mixture.weights, shape).value());
}

TEST(BasisTest, The_norms_and_weights_are_the_reference_s) {
  const auto reference = reference_file("phi_paper3x3.json");
  const Basis basis(reference_mixture(reference).field, 20, reference.at("s").get<double>());
  const Coefficients h_k = coefficients(reference.at("h_k"));
  const Coefficients lambda_k = coefficients(reference.at("lambda_k"));
  EXPECT_LT(largest((basis.norm() - h_k).cwiseQuotient(h_k)), 1e-14);
  EXPECT_LT(largest((basis.weight() - lambda_k).cwiseQuotient(lambda_k)), 1e-14);
}

TEST(BasisTest, The_functions_are_orthonormal_on_a_field_with_unequal_sides) {
  const Basis basis({3.0, 2.0}, 4, 1.5);
  constexpr int kCells = 16;  // the plain midpoint rule is exact for products of these cosines
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(25, 25);
  for (int i = 0; i < kCells * kCells; ++i) {
    const Vec2 q(3.0 / kCells * (i % kCells + 0.5), 2.0 / kCells * (i / kCells + 0.5));
    const Coefficients f_k = basis.evaluate(q);
    gram += f_k.reshaped() * f_k.reshaped().transpose() * (6.0 / (kCells * kCells));
  }
  EXPECT_LT(largest(gram - Eigen::MatrixXd::Identity(25, 25)), 1e-14);
}

TEST(TargetCoefficientsTest, They_are_the_reference_s_though_the_density_does_not_vanish_at_the_border) {
  const auto reference = reference_file("phi_paper3x3.json");
  const ReferenceMixture mixture = reference_mixture(reference);
  const Basis basis(mixture.field, 20, reference.at("s").get<double>());
  for (const Eigen::Index n : {248, 256, 320}) {
    EXPECT_LT(largest(coefficients_of(basis, mixture, {n, n}) - coefficients(reference.at("phi_k"))), 1e-12) << n;
  }
}

TEST(TargetCoefficientsTest, They_do_not_depend_on_the_grid) {
  ReferenceMixture mixture = reference_mixture(reference_file("phi_paper3x3.json"));
  mixture.gaussians[0].mean = {0.2, 0.1};  // much of it is cut off
  const Basis basis(mixture.field, 10, 1.5);
  const Coefficients fine = coefficients_of(basis, mixture, {1024, 1024});
  EXPECT_LT(largest(coefficients_of(basis, mixture, {240, 252}) - fine), 1e-10);
}

RC_GTEST_PROP(TargetCoefficientsTest, A_Gaussian_inside_the_field_has_the_coefficients_of_the_closed_form, ()) {
  const Basis basis({3.0, 2.0}, 12, 1.5);
  field::Gaussian g{.mean = {1.3 + 0.4 * fraction(), 0.9 + 0.2 * fraction()}, .covariance = Eigen::Matrix2d::Zero()};
  g.covariance << 0.008 + 0.002 * fraction(), 0.004 * fraction(), 0.0, 0.008 + 0.002 * fraction();
  g.covariance(1, 0) = g.covariance(0, 1);
  const std::vector<double> one{1.0};
  const auto density = field::rasterise(basis.field(), std::span(&g, 1), one, {256, 256});
  const Coefficients phi_k = target_coefficients(basis, density.value());
  for (int k1 = 0; k1 <= 12; ++k1) {
    for (int k2 = 0; k2 <= 12; ++k2) RC_ASSERT(std::abs(phi_k(k1, k2) - closed_form(basis, g, k1, k2)) < 1e-12);
  }
}

// The integral as basis.hpp has it: midpoint after midpoint, with the basis written down as the paper has it.
Coefficients literal_coefficients(const Basis& basis, const field::DensityGrid& density) {
  Coefficients sum = Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis());
  for (Eigen::Index iy = 0; iy < density.values.cols(); ++iy) {
    for (Eigen::Index ix = 0; ix < density.values.rows(); ++ix) {
      const double mass = density.values(ix, iy) * density.weights_x[ix] * density.weights_y[iy];
      sum += mass * basis.evaluate(density.midpoint(ix, iy));
    }
  }
  return sum;
}

RC_GTEST_PROP(TargetCoefficientsTest, They_are_the_literal_integral_s_and_the_same_with_every_instruction_set, ()) {
  const Basis basis({3.0, 2.0}, *rc::gen::element(1, 7, 20), 1.5);
  const field::GridShape shape{*rc::gen::inRange<Eigen::Index>(1, 50), *rc::gen::inRange<Eigen::Index>(1, 50)};
  field::Importance importance;
  importance.sigma_min_m = 0.3;
  importance.clusters = {{.name = "c", .targets = {{3.0 * fraction(), 2.0 * fraction()}}}};
  importance.uniform_floor = 0.1;
  const field::DensityGrid density = field::rasterise(basis.field(), importance, shape).value();
  const Coefficients phi_k = target_coefficients(basis, density);
  RC_ASSERT(largest(phi_k - literal_coefficients(basis, density)) < 1e-12);
  for (const InstructionSet set : instruction_sets()) RC_ASSERT(target_coefficients(basis, density, set) == phi_k);
}

TEST(TargetCoefficientsTest, Of_a_uniform_density_only_the_first_is_not_zero) {
  field::Importance importance;
  importance.uniform_floor = 1.0;
  const Basis basis({3.0, 2.0}, 64, 1.5);
  const auto shape = field::grid_shape(basis.field(), importance, basis.max_index());
  Coefficients phi_k = target_coefficients(basis, field::rasterise(basis.field(), importance, shape).value());
  EXPECT_NEAR(phi_k(0, 0), 1.0 / basis.norm()(0, 0), 1e-14);
  phi_k(0, 0) = 0.0;
  EXPECT_LT(largest(phi_k), 1e-10);
}

TEST(TargetCoefficientsTest, The_first_is_1_over_its_norm_whatever_the_map) {
  field::Importance importance;
  importance.sigma_min_m = 0.1;
  importance.clusters = {{.name = "c", .targets = {{0.1, 0.2}, {2.0, 1.0}}}};
  importance.areas = {{.name = "a", .outline = {{{1.0, 0.0}, {2.9, 0.4}, {1.3, 2.3}}}, .soft_edge_m = 0.2}};
  importance.no_fly = {{{{0.5, 0.5}, {2.0, 0.7}, {1.5, 1.1}}}};
  importance.uniform_floor = 0.1;
  const Basis basis({3.0, 2.0}, 10, 1.5);
  const Coefficients phi_k =
      target_coefficients(basis, field::rasterise(basis.field(), importance, {200, 150}).value());
  EXPECT_NEAR(phi_k(0, 0), 1.0 / basis.norm()(0, 0), 1e-14);
}

TEST(ErgodicMetricTest, It_is_the_weighted_sum_of_squares) {
  const Basis basis({3.0, 2.0}, 1, 1.5);
  Coefficients c_k = Coefficients::Zero(2, 2);
  Coefficients phi_k = Coefficients::Zero(2, 2);
  c_k << 1.0, 2.0, 3.0, 4.0;
  phi_k << 0.0, 4.0, 3.0, 1.0;
  const double expected = 1.0 + 4.0 / std::pow(2.0, 1.5) + 9.0 / std::pow(3.0, 1.5);
  EXPECT_NEAR(ergodic_metric(basis, c_k, phi_k), expected, 1e-14);
  EXPECT_EQ(ergodic_metric(basis, phi_k, phi_k), 0.0);
}

}  // namespace
}  // namespace vigil::ergodic
