#include "vigil/runtime/margins.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/response_bounds.hpp"
#include "vigil/core/dynamics/vehicle_model.hpp"
#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

/// A vehicle that does just what the filter assumes: what is left is what it meets.
MarginProblem plain() {
  MarginProblem problem;
  problem.loop = dynamics::first_order_lag_vehicle(0.3).horizontal;
  problem.u_max_m_s = 0.5;
  problem.separation_m = 0.2;
  return problem;
}

Mission derived(std::string_view world = "") {
  return parse_mission(right_mission_but("  lag_s: 0.1\nhealth", "health") + std::string(world), "right");
}

TEST(Margins, Nothing_met_needs_no_margin_and_the_highest_gains) {
  const Margins margins = derive_margins(plain());
  EXPECT_EQ(margins.lag_s, 0.3);
  EXPECT_EQ(margins.pair_gain, 5.0);
  EXPECT_EQ(margins.wall_gain, 5.0);
  EXPECT_EQ(margins.pair.total(), 0.0);
  EXPECT_EQ(margins.wall.total(), 0.0);
}

TEST(Margins, Silence_bounds_the_gains) {
  MarginProblem problem = plain();
  problem.silence_s = 0.4;
  problem.command_delay_s = 0.1;
  const Margins margins = derive_margins(problem);
  EXPECT_NEAR(2.0 * std::exp(-margins.pair_gain * 0.5) - 1.0, 0.0, 1e-12);  // h(L) = h0 (2 exp(-gain L) - 1)
  EXPECT_NEAR(margins.wall_gain * 0.5, 1.0, 1e-12);
}

TEST(Margins, Noise_of_z_counts_as_a_barrier_of_the_gain_lets_it_through) {
  MarginProblem problem = plain();
  problem.noise_m = 0.004;
  problem.velocity_noise_m_s = 0.01;
  const Margins margins = derive_margins(problem);
  const double z = std::hypot(0.004, 0.3 * 0.01);
  // d' = -k (d + n), n new every tick: a variance of k dt / (2 - k dt) of that of n.
  EXPECT_NEAR(margins.wall.noise_m, 3.0 * z, 1e-12);  // more than six times what gets through of it
  EXPECT_NEAR(margins.pair.noise_m, 3.0 * std::numbers::sqrt2 * z, 1e-12);
  problem.measurement_period_s = 0.15;
  EXPECT_NEAR(derive_margins(problem).wall.noise_m, 6.0 * z * std::sqrt(0.75 / 1.25), 1e-12);
}

TEST(Margins, Two_drones_err_by_more_than_one) {
  MarginProblem problem = plain();
  problem.bias_m = 0.1;
  problem.unsteady_delay_s = 0.02;
  problem.swap_s = 0.3;
  const Margins margins = derive_margins(problem);
  EXPECT_NEAR(margins.wall.bias_m, 0.5, 1e-12);
  EXPECT_NEAR(margins.pair.bias_m, 0.5 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(margins.wall.delay_m, 0.01, 1e-12);
  EXPECT_NEAR(margins.pair.delay_m, 0.02, 1e-12);
  EXPECT_NEAR(margins.pair.swaps_m, 2.0 * 0.5 * 0.3, 1e-12);
}

TEST(Margins, What_is_given_is_kept_and_reckoned_with) {
  MarginProblem problem = plain();
  problem.given_lag_s = 0.1;  // not the vehicle's
  problem.given_pair_gain = 2.0;
  const Margins margins = derive_margins(problem);
  EXPECT_EQ(margins.lag_s, 0.1);
  EXPECT_EQ(margins.pair_gain, 2.0);
  EXPECT_GT(margins.pair.model_m, 0.0);
}

TEST(Margins, The_same_problem_has_the_same_margins_remembered_or_not) {
  MarginProblem problem = plain();
  problem.loop = dynamics::crazyflie_vehicle().horizontal;
  const Margins first = derive_margins(problem);
  const Margins anew = computed_margins(problem);
  EXPECT_EQ(first.pair.total(), anew.pair.total());
  EXPECT_EQ(first.lag_s, anew.lag_s);
  EXPECT_EQ(derive_margins(problem).wall.total(), first.wall.total());
}

TEST(MissionMargins, A_mission_that_gives_none_gets_the_derived_ones) {
  Mission mission = derived();
  mission.simulation.tracker.noise_m = 0.01;
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const Margins margins = derived_margins(mission);
  EXPECT_EQ(barrier.lag_s, 0.1);  // the simulated vehicle's
  EXPECT_EQ(barrier.margin_m, margins.wall.total());
  EXPECT_EQ(barrier.pair_margin_m, margins.pair.total());
  EXPECT_GT(barrier.pair_margin_m, 0.0);
}

TEST(MissionMargins, A_mission_s_own_values_win) {
  Mission mission = derived();
  mission.simulation.tracker.noise_m = 0.01;
  mission.safety.margin_m = 0.07;
  mission.safety.pair_gain = 3.0;
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  EXPECT_EQ(barrier.margin_m, 0.07);
  EXPECT_EQ(barrier.pair_margin_m, 0.14);
  EXPECT_EQ(barrier.pair_gain, 3.0);
  EXPECT_EQ(barrier.lag_s, 0.1);
}

TEST(MissionMargins, The_whole_way_of_an_order_is_made_up_for) {
  Mission mission = derived();
  mission.safety.vehicle = AssumedVehicle::kPx4;  // 0.135 s of dead time
  mission.simulation.vehicle.command_delay_s = 0.05;
  mission.simulation.link.delay_s = 0.02;
  EXPECT_NEAR(command_delay_s(mission), 0.2, 1e-12);  // the nearest tick of 0.02 s
  mission.simulation.link.jitter_s = 0.04;
  mission.simulation.link.rate_hz = 10.0;
  EXPECT_NEAR(command_delay_s(mission), 0.205 + 0.5 * 0.04 + 0.5 * (0.1 - 0.02), 1e-12);
}

TEST(MissionMargins, A_silence_lasts_until_the_failsafe_s_stop_or_as_long_as_a_burst_of_losses) {
  Mission mission = derived();
  mission.simulation.vehicle = {};
  mission.control.speed_limit_m_s = 0.5;
  EXPECT_EQ(derived_silence_s(mission), 0.0);
  mission.simulation.link.loss = 0.1;
  mission.simulation.link.burst_packets = 2.0;
  EXPECT_NEAR(derived_silence_s(mission), 0.02 * (1.0 + std::ceil(std::log(1e6) / std::log(2.0))), 1e-12);
  mission.simulation.vehicle.model = dynamics::VehicleKind::kCrazyflie;
  const double stop_s = dynamics::stop_from(dynamics::crazyflie_vehicle().horizontal, 0.5).distance_m / 0.5;
  EXPECT_NEAR(derived_silence_s(mission), 0.5 + stop_s, 1e-12);  // it hovers after 0.5 s
}

}  // namespace
}  // namespace vigil::runtime
