#include "vigil/core/ergodic/look_ahead.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/ergodic/gradient_controller.hpp"
#include "vigil/testing/reference_mixture.hpp"

namespace vigil::ergodic {
namespace {

constexpr double kDt = 0.02;
constexpr double kSpeed = 0.3;

/// The paper's field with its reference map, and drones that do as they are told.
class LookAheadTest : public testing::Test {
 protected:
  LookAheadTest()
      : mixture_(reference_mixture(reference_file("phi_paper3x3.json"))),
        basis_(mixture_.field, 10, 1.5),
        kernel_(basis_),
        statistics_(basis_, Accounting::kDroneTime, std::nullopt),
        phi_k_(target_coefficients(
            basis_, field::rasterise(mixture_.field, mixture_.gaussians, mixture_.weights, {256, 256}).value())),
        region_{.field = mixture_.field, .wall_distance_m = 0.17, .no_fly_distance_m = 0.0, .no_fly = {}},
        departures_{{0, {0.4, 0.4}}, {1, {2.6, 0.5}}, {2, {1.5, 2.7}}},
        u_(3, Vec2::Zero()) {}

  LookAhead controller() const { return {basis_, {.u_max_m_s = kSpeed, .dt_s = kDt}, 3}; }

  void decide(LookAhead& look_ahead) {
    u_.resize(departures_.size());
    std::vector<Vec2> positions;
    for (const Departure& departure : departures_) positions.push_back(departure.position);
    statistics_.add(kernel_, positions, positions.size(), kDt);
    look_ahead.steer(kernel_, statistics_, phi_k_, region_, departures_, u_);
  }
  void step(LookAhead& look_ahead) {
    decide(look_ahead);
    for (std::size_t i = 0; i < u_.size(); ++i) departures_[i].position += kDt * u_[i];
  }
  double metric() const {
    Coefficients c_k = phi_k_;
    statistics_.average(c_k);
    return ergodic_metric(basis_, c_k, phi_k_);
  }

  ReferenceMixture mixture_;
  Basis basis_;
  Kernel kernel_;
  CoverageStatistics statistics_;
  Coefficients phi_k_;
  AllowedRegion region_;
  std::vector<Departure> departures_;
  std::vector<Vec2> u_;
};

TEST_F(LookAheadTest, After_two_minutes_the_metric_is_a_fifth_of_what_the_gradient_leaves) {
  const std::vector<Departure> starts = departures_;
  LookAhead look_ahead = controller();
  for (int i = 0; i < 6000; ++i) step(look_ahead);
  const double ahead = metric();

  statistics_.reset();
  std::vector<Vec2> positions;
  for (const Departure& start : starts) positions.push_back(start.position);
  std::vector<Vec2> b(positions.size());
  Coefficients c_k = phi_k_;
  const double delta = 0.1 * gradient_scale(basis_, phi_k_);
  for (int i = 0; i < 6000; ++i) {
    statistics_.add(kernel_, positions, 3, kDt);
    statistics_.average(c_k);
    kernel_.gradient(positions, basis_.weight().cwiseProduct(c_k - phi_k_), b);
    for (std::size_t k = 0; k < b.size(); ++k) positions[k] += kDt * faded_direction(b[k], kSpeed, delta);
  }
  EXPECT_LT(5.0 * ahead, metric());
  RecordProperty("ratio", std::to_string(metric() / ahead));
}

TEST_F(LookAheadTest, It_is_never_faster_than_u_max_and_stays_within_the_walls) {
  LookAhead look_ahead = controller();
  for (int i = 0; i < 3000; ++i) {
    step(look_ahead);
    for (std::size_t k = 0; k < u_.size(); ++k) {
      ASSERT_LE(u_[k].norm(), kSpeed * (1.0 + 1e-12));
      // The first piece may point past the wall until the next decision.
      ASSERT_GE((departures_[k].position.array() - 0.17).minCoeff(), -kSpeed * 0.1);
    }
  }
}

TEST_F(LookAheadTest, A_copy_goes_on_like_its_original) {
  LookAhead look_ahead = controller();
  for (int i = 0; i < 203; ++i) step(look_ahead);
  LookAhead copy = look_ahead;
  const CoverageStatistics before = statistics_;
  const std::vector<Departure> there = departures_;
  for (int i = 0; i < 100; ++i) step(look_ahead);
  const std::vector<Departure> flown = departures_;
  statistics_ = before;
  departures_ = there;
  for (int i = 0; i < 100; ++i) step(copy);
  for (std::size_t k = 0; k < flown.size(); ++k) EXPECT_EQ(departures_[k].position, flown[k].position);
}

TEST_F(LookAheadTest, Between_decisions_velocities_are_held) {
  LookAhead look_ahead = controller();
  int decisions = 0;
  std::vector<Vec2> before = u_;
  for (int i = 0; i < 500; ++i) {
    step(look_ahead);
    if (u_ != before) ++decisions;
    before = u_;
  }
  EXPECT_NEAR(decisions, 100, 2);  // every 0.1 s of 10 s
}

TEST_F(LookAheadTest, Told_so_it_decides_at_once) {
  LookAhead look_ahead = controller();
  step(look_ahead);
  const std::vector<Vec2> before = u_;
  step(look_ahead);
  EXPECT_EQ(u_, before);
  look_ahead.decide_at_once();
  step(look_ahead);
  EXPECT_NE(u_, before);
}

TEST_F(LookAheadTest, New_targets_in_flight_are_planned_for_in_detail_for_a_while) {
  LookAhead look_ahead(basis_, {.u_max_m_s = kSpeed, .dt_s = kDt, .catch_up = 0.1}, 3);  // 0.1 x 3 m / u_max = 1 s
  const auto next = [this](LookAhead copy) {
    const CoverageStatistics before = statistics_;
    decide(copy);
    statistics_ = before;
    return u_;
  };
  const auto plans_in_detail = [&] {
    LookAhead at_once = look_ahead;
    at_once.decide_at_once();
    LookAhead told = look_ahead;
    told.targets_changed();
    return next(at_once) == next(told);
  };
  for (int i = 0; i < 100; ++i) step(look_ahead);
  EXPECT_FALSE(plans_in_detail());
  look_ahead.targets_changed();
  for (int i = 0; i < 49; ++i) step(look_ahead);
  EXPECT_TRUE(plans_in_detail());
  step(look_ahead);
  step(look_ahead);
  EXPECT_FALSE(plans_in_detail());
}

TEST_F(LookAheadTest, The_first_targets_have_nothing_to_be_made_up_for) {
  LookAhead told = controller();
  told.targets_changed();
  LookAhead untold = controller();
  const CoverageStatistics before = statistics_;
  decide(told);
  const std::vector<Vec2> u = u_;
  statistics_ = before;
  decide(untold);
  EXPECT_EQ(u, u_);
}

TEST_F(LookAheadTest, When_a_drone_drops_out_or_returns_all_decide_at_once) {
  LookAhead look_ahead = controller();
  step(look_ahead);
  const std::vector<Vec2> all = u_;
  const Departure second = departures_[1];
  departures_.erase(departures_.begin() + 1);
  step(look_ahead);
  ASSERT_EQ(u_.size(), 2U);
  EXPECT_NE(u_[0], all[0]);
  EXPECT_NE(u_[1], all[2]);
  const std::vector<Vec2> without = u_;
  departures_.insert(departures_.begin() + 1, second);
  step(look_ahead);
  EXPECT_NE(u_[0], without[0]);
}

TEST_F(LookAheadTest, Fewer_drones_look_farther_ahead) {
  const LookAhead look_ahead = controller();
  EXPECT_DOUBLE_EQ(look_ahead.horizon_s(1), 0.6 * 3.0 / kSpeed);
  EXPECT_DOUBLE_EQ(look_ahead.horizon_s(4), 0.5 * look_ahead.horizon_s(1));
  const LookAhead given(basis_, {.u_max_m_s = kSpeed, .dt_s = kDt, .horizon_s = 2.5}, 3);
  EXPECT_EQ(given.horizon_s(1), 2.5);
}

TEST_F(LookAheadTest, Paths_begin_where_a_lagging_drone_will_have_coasted_to) {
  LookAhead lagging(basis_, {.u_max_m_s = kSpeed, .lag_s = 0.5, .dt_s = kDt}, 3);
  LookAhead prompt = controller();
  departures_[0].velocity = {0.2, 0.1};
  const CoverageStatistics before = statistics_;
  decide(lagging);
  const Vec2 u = u_[0];
  // The same sample, and then a prompt drone that already is where the lagging one coasts to.
  statistics_ = before;
  std::vector<Vec2> positions;
  for (const Departure& departure : departures_) positions.push_back(departure.position);
  statistics_.add(kernel_, positions, 3, kDt);
  departures_[0].position += 0.5 * departures_[0].velocity;
  prompt.steer(kernel_, statistics_, phi_k_, region_, departures_, u_);
  EXPECT_EQ(u, u_[0]);
}

// The map is symmetric about the drone, and so is all that it has seen: (9) has no direction there.
TEST_F(LookAheadTest, A_drone_on_a_symmetric_map_does_not_stay_in_its_middle) {
  phi_k_.setZero();
  phi_k_(0, 0) = 1.0 / basis_.norm()(0, 0);
  LookAhead look_ahead = controller();
  departures_ = {{0, {1.5, 1.5}}};
  for (int i = 0; i < 500; ++i) step(look_ahead);
  EXPECT_GT((departures_[0].position - Vec2(1.5, 1.5)).norm(), 0.5);
}

TEST_F(LookAheadTest, A_path_towards_a_no_fly_polygon_slides_along_it_and_past_its_end) {
  const field::Polygon wall{{{1.4, 0.0}, {1.6, 0.0}, {1.6, 1.7}, {1.4, 1.7}}};
  const std::vector<field::Segment> edges = field::edges(wall);
  region_.no_fly = edges;
  region_.no_fly_distance_m = 0.1;
  const std::vector<field::Gaussian> goal{{{2.3, 2.2}, 0.02 * Eigen::Matrix2d::Identity()}};
  phi_k_ =
      target_coefficients(basis_, field::rasterise(mixture_.field, goal, std::vector<double>{1.0}, {256, 256}).value());
  LookAhead look_ahead = controller();
  departures_ = {{0, {0.8, 1.2}}};
  double nearest = 10.0;
  for (int i = 0; i < 3000; ++i) {
    decide(look_ahead);
    // Like the filter, the world keeps the drone off the polygon.
    departures_[0].position = keep_inside(region_, departures_[0].position + kDt * u_[0]).point;
    nearest = std::min(nearest, (departures_[0].position - Vec2(2.3, 2.2)).norm());
  }
  EXPECT_LT(nearest, 0.1);
}

}  // namespace
}  // namespace vigil::ergodic
