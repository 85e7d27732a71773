#include "vigil/core/dynamics/fault_bounds.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/gauss_markov.hpp"
#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {
namespace {

FaultProblem laboratory() {
  FaultProblem problem;
  problem.loop = first_order_lag_vehicle(0.3).horizontal;
  problem.u_max_m_s = 0.5;
  problem.noise_m = 0.002;
  problem.velocity_noise_m_s = 0.02;
  problem.push_m_s2 = 0.05;
  return problem;
}

/// Of an order for u_max that it was given while it stood: the residual against what lost orders explain, by steps.
TEST(FaultBounds, A_vehicle_that_flies_nothing_exceeds_what_is_explained_right_after_its_blind_time) {
  constexpr double kStep = 1e-4;
  for (const double held_s : {0.0, 0.4, 3.0}) {
    FaultProblem problem = laboratory();
    problem.held_s = held_s;
    const FaultBounds bounds = fault_bounds(problem);
    const double keep = std::exp(-bounds.residual_leak_per_s * kStep);
    double residual = 0.0;
    double explained = 0.0;
    double time_s = 0.0;
    for (; residual <= bounds.residual_m + explained; time_s += kStep) {
      residual = keep * residual + kStep * problem.u_max_m_s;
      const double astray = time_s < held_s ? time_s * problem.u_max_m_s : 0.0;
      explained = std::max(keep * explained, astray);
    }
    EXPECT_NEAR(time_s, bounds.blind_s, 2e-3) << held_s;
  }
}

TEST(FaultBounds, Who_is_silent_is_not_judged_before_a_burst_of_losses_or_its_own_failsafe_may_explain_it) {
  FaultProblem problem = laboratory();
  EXPECT_EQ(fault_bounds(problem).silent_s, 5.0 * problem.packet_period_s);
  problem.held_s = 0.7;
  EXPECT_EQ(fault_bounds(problem).silent_s, 0.7);
  problem.hovers_after_s = 0.5;
  EXPECT_EQ(fault_bounds(problem).silent_s, 0.5);
}

TEST(FaultBounds, What_is_not_known_of_the_world_raises_every_threshold_that_it_touches) {
  const FaultBounds plain = fault_bounds(laboratory());
  FaultProblem noisy = laboratory();
  noisy.noise_m *= 3.0;
  const FaultBounds with_noise = fault_bounds(noisy);
  EXPECT_GT(with_noise.jump_m, plain.jump_m);
  EXPECT_GT(with_noise.residual_m, plain.residual_m);
  EXPECT_GT(with_noise.disagreement_m, plain.disagreement_m);
  FaultProblem windy = laboratory();
  windy.push_m_s2 *= 3.0;
  EXPECT_GT(fault_bounds(windy).residual_m, plain.residual_m);
  EXPECT_GT(fault_bounds(windy).reach_m_s, plain.reach_m_s);
  EXPECT_EQ(fault_bounds(windy).jump_m, plain.jump_m);
  FaultProblem seldom = laboratory();
  seldom.period_s = 0.2;
  EXPECT_GE(fault_bounds(seldom).confirm_s, 0.4);
  EXPECT_GE(fault_bounds(seldom).frozen_s, 1.0);
}

TEST(FaultBounds, A_tracker_without_noise_may_repeat_itself) {
  FaultProblem problem = laboratory();
  EXPECT_TRUE(fault_bounds(problem).never_repeats);
  problem.noise_m = 0.0;
  EXPECT_FALSE(fault_bounds(problem).never_repeats);
}

/// The formula for the leaky integral of a Gauss-Markov process, against a long run of one.
TEST(FaultBounds, Gusts_move_the_residual_as_much_as_the_bound_has_it) {
  constexpr double kStep = 0.02;
  FaultProblem problem = laboratory();
  problem.noise_m = 0.0;
  problem.dt_s = 1e-9;
  const FaultBounds bounds = fault_bounds(problem);
  const double give_s = 0.3;
  const GaussMarkov gusts{problem.push_m_s2, problem.push_time_s};
  RandomStream random(7, 1, 1);
  double push = 0.0;
  double velocity = 0.0;
  double residual = 0.0;
  double squares = 0.0;
  constexpr int kSteps = 2'000'000;
  for (int i = 0; i < kSteps; ++i) {
    push = advance(gusts, push, random.normal(1.0).x(), kStep);
    velocity += kStep * (push - velocity / give_s);
    residual = std::exp(-bounds.residual_leak_per_s * kStep) * residual + kStep * velocity;
    squares += residual * residual;
  }
  const double sigma = std::sqrt(squares / kSteps);
  const double allowed = bounds.residual_m / kFaultSigmas;
  EXPECT_LE(sigma, allowed);
  EXPECT_GE(sigma, 0.7 * allowed);  // and the bound is not idle
}

}  // namespace
}  // namespace vigil::dynamics
