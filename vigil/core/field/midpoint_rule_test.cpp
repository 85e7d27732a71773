#include "vigil/core/field/midpoint_rule.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vigil::field {
namespace {

double relative_error_for_power(int degree, Eigen::Index n, double length, EndRule rule) {
  const Eigen::VectorXd weights = midpoint_weights(n, length, rule);
  double sum = 0.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    sum += weights[j] * std::pow((static_cast<double>(j) + 0.5) * length / static_cast<double>(n), degree);
  }
  const double exact = std::pow(length, degree + 1) / (degree + 1);
  return std::abs(sum - exact) / exact;
}

TEST(MidpointRuleTest, Polynomials_below_the_order_are_integrated_exactly) {
  for (const Eigen::Index n : {40, 41, 128, 250, 1024}) {
    for (int degree = 0; degree < 16; ++degree) {
      EXPECT_LT(relative_error_for_power(degree, n, 3.0, EndRule::kSmooth), 2e-14) << n << " " << degree;
    }
    for (int degree = 0; degree < 4; ++degree) {
      EXPECT_LT(relative_error_for_power(degree, n, 3.0, EndRule::kKinked), 2e-14) << n << " " << degree;
    }
  }
}

TEST(MidpointRuleTest, Few_points_still_integrate_what_they_can) {
  for (Eigen::Index n = 1; n <= 40; ++n) {
    for (int degree = 0; degree < std::max<Eigen::Index>(1, 4 * (n / 2) / 5) && degree < 16; ++degree) {
      EXPECT_LT(relative_error_for_power(degree, n, 2.0, EndRule::kSmooth), 1e-13) << n << " " << degree;
    }
  }
}

TEST(MidpointRuleTest, The_weights_sum_to_the_length) {
  for (const EndRule rule : {EndRule::kSmooth, EndRule::kKinked}) {
    for (Eigen::Index n = 1; n <= 300; ++n) {
      EXPECT_NEAR(midpoint_weights(n, 7.0, rule).sum(), 7.0, 1e-13) << n;
    }
  }
}

TEST(MidpointRuleTest, The_rule_reads_the_same_from_both_ends) {
  const Eigen::VectorXd weights = midpoint_weights(131, 2.0, EndRule::kSmooth);
  EXPECT_EQ(weights, Eigen::VectorXd(weights.reverse()));
}

TEST(MidpointRuleTest, The_interior_is_the_plain_midpoint_rule) {
  const Eigen::VectorXd weights = midpoint_weights(128, 2.0, EndRule::kSmooth);
  EXPECT_EQ(weights.segment(20, 88), Eigen::VectorXd(Eigen::VectorXd::Constant(88, 2.0 / 128.0)));
}

TEST(MidpointRuleTest, The_rule_for_kinked_integrands_has_tame_positive_weights) {
  for (Eigen::Index n = 1; n <= 300; ++n) {
    const Eigen::VectorXd weights = midpoint_weights(n, static_cast<double>(n), EndRule::kKinked);
    EXPECT_GT(weights.minCoeff(), 0.88) << n;
    EXPECT_LT(weights.maxCoeff(), 1.1) << n;
  }
}

TEST(MidpointRuleTest, The_rule_for_smooth_integrands_keeps_its_weights_within_bounds) {
  for (Eigen::Index n = 1; n <= 300; ++n) {
    const Eigen::VectorXd weights = midpoint_weights(n, static_cast<double>(n), EndRule::kSmooth);
    EXPECT_GT(weights.minCoeff(), -12.0) << n;
    EXPECT_LT(weights.maxCoeff(), 16.0) << n;
  }
}

TEST(MidpointRuleTest, An_exponential_that_does_not_vanish_at_the_ends_converges_at_high_order) {
  const auto error = [](Eigen::Index n) {
    const Eigen::VectorXd weights = midpoint_weights(n, 1.0, EndRule::kSmooth);
    const Eigen::ArrayXd x =
        (Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) + 0.5) / static_cast<double>(n);
    const double rate = 30.0;
    return std::abs(weights.dot((rate * (x - 1.0)).exp().matrix()) - (1.0 - std::exp(-rate)) / rate);
  };
  EXPECT_LT(error(256), 1e-13);
  EXPECT_GT(error(64), 1e3 * error(128));
}

}  // namespace
}  // namespace vigil::field
