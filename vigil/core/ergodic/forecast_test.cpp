#include "vigil/core/ergodic/forecast.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::ergodic {
namespace {

constexpr int kPieces = 5;

Coefficients some_coefficients(const Basis& basis) {
  Coefficients phi_k(basis.indices_per_axis(), basis.indices_per_axis());
  for (Eigen::Index i = 0; i < phi_k.size(); ++i) phi_k.reshaped()[i] = 0.3 * std::sin(1.0 + static_cast<double>(i));
  phi_k(0, 0) = 1.0 / basis.norm()(0, 0);
  return phi_k;
}

/// Two drones that have been somewhere, and their next five pieces of 0.4 s.
class ForecastTest : public testing::TestWithParam<Accounting> {
 protected:
  ForecastTest()
      : statistics_(basis_, GetParam(), 7.0), phi_k_(some_coefficients(basis_)), forecast_(basis_, 2, kPieces) {
    for (int i = 0; i < 20; ++i)
      statistics_.add(kernel_, std::vector<Vec2>{{0.1 * i, 1.0}, {2.0, 0.3}, {0.4, 0.4}}, 3, 0.1);
    for (int i = 0; i < 20; ++i) statistics_.add(kernel_, std::vector<Vec2>{{0.1 * i, 1.0}, {2.0, 0.3}}, 2, 0.1);
    for (int j = 0; j < 2 * kPieces; ++j) velocities_.emplace_back(0.3 * std::cos(1.7 * j), 0.3 * std::sin(1.7 * j));
  }

  double cost() {
    forecast_.run(kernel_, statistics_, phi_k_, region_, {starts_, velocities_, 0.4});
    return forecast_.cost();
  }

  Basis basis_{{3.0, 2.0}, 6, 1.5};
  Kernel kernel_{basis_};
  CoverageStatistics statistics_;
  Coefficients phi_k_;
  Forecast forecast_;
  AllowedRegion region_{.field = {3.0, 2.0}, .wall_distance_m = 0.1, .no_fly_distance_m = 0.0, .no_fly = {}};
  std::vector<Vec2> starts_{{0.8, 0.9}, {2.1, 1.2}};
  std::vector<Vec2> velocities_;
};

TEST_P(ForecastTest, The_slopes_are_the_differences_of_the_cost) {
  cost();
  const std::vector<Vec2> slopes(forecast_.slopes().begin(), forecast_.slopes().end());
  constexpr double kStep = 1e-5;
  for (std::size_t j = 0; j < velocities_.size(); ++j) {
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const double before = velocities_[j][axis];
      velocities_[j][axis] = before + kStep;
      const double above = cost();
      velocities_[j][axis] = before - kStep;
      const double below = cost();
      velocities_[j][axis] = before;
      EXPECT_NEAR(slopes[j][axis], (above - below) / (2.0 * kStep), 1e-7) << "piece " << j << " axis " << axis;
    }
  }
}

// T of the sample that is foreseen is 1/h_0 over c_0 whatever the drones do: excess and metric tell the same story.
TEST_P(ForecastTest, The_cost_is_what_the_statistics_come_to_when_the_drones_fly_so) {
  const double foreseen = cost();
  double flown = 0.0;
  std::vector<Vec2> positions = starts_;
  Coefficients d_k = phi_k_;
  for (std::size_t j = 0; j < kPieces; ++j) {
    std::vector<Vec2> midpoints;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec2 move = 0.4 * velocities_[i * kPieces + j];
      midpoints.emplace_back(positions[i] + 0.5 * move);
      positions[i] += move;
    }
    statistics_.add(kernel_, midpoints, 2, 0.4);
    statistics_.excess(phi_k_, d_k);
    flown += ergodic_metric(basis_, d_k, Coefficients::Zero(7, 7));
  }
  EXPECT_NEAR(foreseen, flown, 1e-12 * flown);
}

TEST_P(ForecastTest, In_detail_it_is_the_forecast_of_a_less_smooth_metric) {
  const Basis rougher({3.0, 2.0}, 6, 0.85 * 1.5);
  Forecast expected(rougher, 2, kPieces);
  expected.run(kernel_, statistics_, phi_k_, region_, {starts_, velocities_, 0.4});
  const double by_metric = cost();
  forecast_.set_emphasis(Emphasis::kDetail);
  EXPECT_NEAR(cost(), expected.cost(), 1e-12 * expected.cost());
  EXPECT_NEAR(forecast_.curvature(), expected.curvature(), 1e-12 * expected.curvature());
  for (std::size_t j = 0; j < velocities_.size(); ++j)
    EXPECT_LT((forecast_.slopes()[j] - expected.slopes()[j]).norm(), 1e-12) << "piece " << j;
  forecast_.set_emphasis(Emphasis::kMetric);
  EXPECT_EQ(cost(), by_metric);
}

TEST_P(ForecastTest, A_path_against_a_wall_slides_along_it) {
  starts_ = {{0.1, 1.0}, {2.1, 1.2}};
  for (std::size_t j = 0; j < kPieces; ++j) velocities_[j] = {-0.3, 0.2};
  const double sliding = cost();
  for (std::size_t j = 0; j < kPieces; ++j) velocities_[j] = {0.0, 0.2};
  EXPECT_NEAR(sliding, cost(), 1e-12 * sliding);
}

INSTANTIATE_TEST_SUITE_P(Accountings, ForecastTest,
                         testing::Values(Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14));

TEST(ExcessTest, It_is_the_time_flown_times_what_the_average_misses) {
  const Basis basis({3.0, 2.0}, 6, 1.5);
  Kernel kernel(basis);
  CoverageStatistics statistics(basis, Accounting::kDroneTime, std::nullopt);
  for (int i = 0; i < 20; ++i) statistics.add(kernel, std::vector<Vec2>{{0.1 * i, 1.0}, {2.0, 0.3}}, 2, 0.1);
  const Coefficients phi_k = some_coefficients(basis);
  Coefficients c_k = phi_k;
  Coefficients d_k = phi_k;
  statistics.average(c_k);
  statistics.excess(phi_k, d_k);
  EXPECT_LT((d_k - 4.0 * (c_k - phi_k)).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace vigil::ergodic
