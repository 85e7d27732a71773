#include "vigil/core/dynamics/gauss_markov.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

class Normals {
 public:
  double operator()() { return normal_(random_); }
  Vec3 vector() {
    const double x = (*this)();
    const double y = (*this)();
    return {x, y, (*this)()};
  }

 private:
  std::mt19937_64 random_{20'240'612};
  std::normal_distribution<double> normal_;
};

TEST(GaussMarkov, Has_its_standard_deviation_and_its_correlation_time_whatever_the_step) {
  const GaussMarkov process{1.5, 2.0};
  for (const double dt : {0.05, 0.5}) {
    Normals normals;
    const int lag = static_cast<int>(std::lround(2.0 / dt));
    std::vector<double> x{process.sigma * normals()};
    for (int i = 0; i < 400'000; ++i) x.push_back(advance(process, x.back(), normals(), dt));
    double variance = 0.0;
    double covariance = 0.0;
    const std::size_t n = x.size() - static_cast<std::size_t>(lag);
    for (std::size_t i = 0; i < n; ++i) {
      variance += x[i] * x[i] / static_cast<double>(n);
      covariance += x[i] * x[i + static_cast<std::size_t>(lag)] / static_cast<double>(n);
    }
    EXPECT_NEAR(std::sqrt(variance), 1.5, 0.03) << dt;
    EXPECT_NEAR(covariance / variance, std::exp(-1.0), 0.03) << dt;
  }
}

TEST(GaussMarkov, No_time_changes_nothing_and_endless_time_forgets_everything) {
  const GaussMarkov process{2.0, 3.0};
  EXPECT_EQ(advance(process, 1.3, 0.7, 0.0), 1.3);
  EXPECT_EQ(advance(process, 1.3, 0.7, std::numeric_limits<double>::infinity()), 1.4);
}

TEST(SatelliteNavigation, Wanders_slowly_about_the_truth) {
  const SatelliteNavigation navigation = plain_satellite_navigation();
  Normals normals;
  Vec3 bias = advance(navigation, Vec3::Zero(), normals.vector(), std::numeric_limits<double>::infinity());
  Vec3 squares = Vec3::Zero();
  double step_squares = 0.0;
  constexpr int kSteps = 400'000;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 next = advance(navigation, bias, normals.vector(), 1.0);
    step_squares += (next.x() - bias.x()) * (next.x() - bias.x()) / kSteps;
    bias = next;
    squares += bias.cwiseAbs2() / kSteps;
  }
  EXPECT_NEAR(std::sqrt(squares.x()), 2.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares.z()), 4.0, 0.2);
  EXPECT_NEAR(std::sqrt(step_squares), 2.0 * std::sqrt(2.0 * (1.0 - std::exp(-1.0 / 60.0))), 0.01);
}

TEST(SatelliteNavigation, Measures_the_truth_the_bias_and_the_noise) {
  const SatelliteNavigation navigation{.noise_sigma = 0.5};
  const Vec3 seen = measured(navigation, Vec3(1, 2, 3), Vec3(0.1, 0.2, 0.3), Vec3(2, -2, 0));
  EXPECT_LT((seen - Vec3(2.1, 1.2, 3.3)).norm(), 1e-12);
}

}  // namespace
}  // namespace vigil::dynamics
