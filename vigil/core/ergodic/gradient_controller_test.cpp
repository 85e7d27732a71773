#include "vigil/core/ergodic/gradient_controller.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vigil/core/ergodic/kernel.hpp"

namespace vigil::ergodic {
namespace {

double any_size() { return std::pow(10.0, *rc::gen::inRange(-320, 300)) * *rc::gen::inRange(-9, 10); }

TEST(FadedDirectionTest, Without_a_fade_it_is_full_speed_down_the_slope) {
  const Vec2 u = faded_direction({3e-5, -4e-5}, 0.3, 0.0);
  EXPECT_LT((u - Vec2(-0.18, 0.24)).norm(), 1e-16);
}

TEST(FadedDirectionTest, Where_the_slope_is_as_small_as_delta_the_speed_is_halved) {
  const Vec2 u = faded_direction({3.0, -4.0}, 0.3, 5.0);
  EXPECT_LT((u - Vec2(-0.09, 0.12)).norm(), 1e-16);
}

TEST(FadedDirectionTest, On_level_ground_it_is_zero) {
  EXPECT_EQ(faded_direction({0.0, 0.0}, 0.3, 0.0), Vec2(0.0, 0.0));
  const double smallest = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(faded_direction({smallest, smallest}, 0.3, 0.0), Vec2(0.0, 0.0));
}

RC_GTEST_PROP(FadedDirectionTest, It_is_never_faster_than_u_max_and_never_uphill, ()) {
  const Vec2 b(any_size(), any_size());
  const double delta = *rc::gen::element(0.0, 1e-3, 10.0);
  const Vec2 u = faded_direction(b, 0.3, delta);
  RC_ASSERT(u.allFinite());
  RC_ASSERT(std::hypot(u.x(), u.y()) <= 0.3 * (1.0 + 1e-15));
  RC_ASSERT(u.x() * b.x() <= 0.0 && u.y() * b.y() <= 0.0);
}

TEST(GradientScaleTest, It_is_the_root_mean_square_of_the_potential_s_slope) {
  const Basis basis({3.0, 2.0}, 5, 1.5);
  Coefficients phi_k(6, 6);
  for (int i = 0; i < 36; ++i) phi_k.reshaped()[i] = std::sin(1.0 + i);
  constexpr int kCells = 24;  // the plain midpoint rule is exact for products of these cosines and of these sines
  std::vector<Vec2> midpoints;
  for (int i = 0; i < kCells * kCells; ++i) {
    midpoints.emplace_back(3.0 / kCells * (i % kCells + 0.5), 2.0 / kCells * (i / kCells + 0.5));
  }
  std::vector<Vec2> slopes(midpoints.size());
  Kernel(basis).gradient(midpoints, basis.weight().cwiseProduct(phi_k), slopes);
  double sum = 0.0;
  for (const Vec2& slope : slopes) sum += slope.squaredNorm();
  EXPECT_NEAR(gradient_scale(basis, phi_k), std::sqrt(sum / (kCells * kCells)), 1e-13);
}

TEST(GradientScaleTest, A_field_twice_as_large_has_an_eighth_of_the_slope) {
  const Basis small({3.0, 2.0}, 5, 1.5);
  const Basis large({6.0, 4.0}, 5, 1.5);
  const Coefficients phi_k = Coefficients::Ones(6, 6);
  EXPECT_NEAR(gradient_scale(large, 0.5 * phi_k), gradient_scale(small, phi_k) / 8.0, 1e-15);
}

}  // namespace
}  // namespace vigil::ergodic
