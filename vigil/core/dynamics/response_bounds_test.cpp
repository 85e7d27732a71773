#include "vigil/core/dynamics/response_bounds.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {
namespace {

constexpr double kDt = 0.01;

/// D of command_deviation() after each step of a command sequence, by its own differential equation.
std::vector<double> deviations(const VelocityLoop& loop, double tau, double leak, const std::vector<double>& commands) {
  const int late = static_cast<int>(std::lround(loop.response_delay_s / kDt));
  std::vector<double> all;
  AxisState state;
  double d = 0.0;
  for (int i = 0; i < static_cast<int>(commands.size()); ++i) {
    const double seen = i < late ? 0.0 : commands[static_cast<std::size_t>(i - late)];
    const AxisState next = advance(loop, state, seen, kDt);
    const double z_gained = next.position_m - state.position_m + tau * (next.velocity_m_s - state.velocity_m_s);
    d = std::exp(-leak * kDt) * d +
        (z_gained - commands[static_cast<std::size_t>(i)] * kDt) * std::exp(-0.5 * leak * kDt);
    all.push_back(d);
    state = next;
  }
  return all;
}

double greatest(const std::vector<double>& values) {
  double worst = 0.0;
  for (const double value : values) worst = std::max(worst, std::abs(value));
  return worst;
}

/// Bang-bang commands that switch where the impulse response changes sign: what reaches the L1 norm of a linear loop.
std::vector<double> worst_commands(const VelocityLoop& loop, double tau, double leak, double u_max, int steps) {
  std::vector<double> unit(static_cast<std::size_t>(steps), 1.0);
  const std::vector<double> step = deviations(loop, tau, leak, unit);
  std::vector<double> commands(step.size());
  for (std::size_t i = 0; i < step.size(); ++i) {
    const double impulse = step[i] - (i > 0 ? step[i - 1] : 0.0);
    commands[step.size() - 1 - i] = impulse >= 0.0 ? u_max : -u_max;
  }
  return commands;
}

/// The worst of many random commands that jump between -u_max, 0 and u_max at random times.
double worst_of_random(const VelocityLoop& loop, double tau, double leak, double u_max, int trials) {
  std::mt19937_64 random(20'240'611);
  double worst = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> commands;
    const std::uint64_t longest = 5 + random() % 200;
    while (commands.size() < 1000) {
      const double u = u_max * (static_cast<double>(random() % 3) - 1.0);
      commands.insert(commands.end(), 1 + random() % longest, u);
    }
    worst = std::max(worst, greatest(deviations(loop, tau, leak, commands)));
  }
  return worst;
}

TEST(CommandDeviation, Is_zero_for_a_first_order_lag_at_its_own_time_constant) {
  const VelocityLoop loop = first_order_lag_vehicle(0.3).horizontal;
  EXPECT_LT(command_deviation(loop, 0.3, 0.0, 2.0), 1e-9);
  EXPECT_LT(command_deviation(loop, 0.3, 5.0, 2.0), 1e-9);
  EXPECT_NEAR(effective_lag(loop, 0.0, 2.0).tau_s, 0.3, 1e-3);
}

TEST(CommandDeviation, Of_a_pure_dead_time_is_the_way_covered_meanwhile) {
  VelocityLoop loop = ideal_vehicle().horizontal;
  loop.response_delay_s = 0.1;
  EXPECT_NEAR(command_deviation(loop, 0.0, 0.0, 3.0), 0.3, 1e-12);
  // With a leak: (exp(-0.1 s) - 1) / (s + 5), whose impulse response has the norm 2 (1 - exp(-0.5)) / 5.
  EXPECT_NEAR(command_deviation(loop, 0.0, 5.0, 3.0), 3.0 * 2.0 * (1.0 - std::exp(-0.5)) / 5.0, 1e-6);
}

TEST(CommandDeviation, Of_a_gain_error_grows_for_ever_unless_it_leaks) {
  VelocityLoop loop = ideal_vehicle().horizontal;
  loop.gain = 0.88;
  EXPECT_TRUE(std::isinf(command_deviation(loop, 0.0, 0.0, 1.0)));
  EXPECT_NEAR(command_deviation(loop, 0.0, 5.0, 1.0), 0.12 / 5.0, 1e-6);
  EXPECT_TRUE(std::isinf(effective_lag(loop, 0.0, 1.0).deviation_m));
}

TEST(CommandDeviation, Of_a_linear_loop_is_reached_by_a_bang_bang_command_and_by_none_exceeded) {
  struct Case {
    VelocityLoop loop;
    double leak;
  };
  VelocityLoop px4 = px4_vehicle().horizontal;
  px4.response_delay_s = 0.13;  // a whole number of steps of the oracle
  VelocityLoop unit_gain = crazyflie_vehicle().horizontal;
  unit_gain.gain = 1.0;
  for (const Case& c : {Case{crazyflie_vehicle().horizontal, 5.0}, Case{unit_gain, 0.0}, Case{px4, 1.0}}) {
    for (const double tau : {0.0, 0.14, 0.5}) {
      const double bound = command_deviation(c.loop, tau, c.leak, 0.7);
      const double reached = greatest(deviations(c.loop, tau, c.leak, worst_commands(c.loop, tau, c.leak, 0.7, 3000)));
      EXPECT_LE(reached, 1.005 * bound);
      EXPECT_GE(reached, 0.98 * bound);
      EXPECT_LE(worst_of_random(c.loop, tau, c.leak, 0.7, 40), 1.005 * bound);
    }
  }
}

TEST(CommandDeviation, Scales_with_the_greatest_command_of_a_linear_loop) {
  const VelocityLoop loop = crazyflie_vehicle().horizontal;
  EXPECT_NEAR(command_deviation(loop, 0.1, 5.0, 3.0), 10.0 * command_deviation(loop, 0.1, 5.0, 0.3), 1e-9);
}

TEST(CommandDeviation, Found_by_dynamic_programming_is_the_norm_where_the_limits_are_out_of_reach) {
  const VelocityLoop linear = crazyflie_vehicle().horizontal;
  VelocityLoop limited = linear;
  limited.acceleration_limit_m_s2 = 1000.0;
  for (const double leak : {1.0, 5.0}) {
    const double norm = command_deviation(linear, 0.14, leak, 0.5);
    EXPECT_NEAR(command_deviation(limited, 0.14, leak, 0.5), norm, 0.015 * norm) << leak;
  }
}

TEST(CommandDeviation, Of_a_limited_loop_is_exceeded_by_no_random_command) {
  VelocityLoop loop = arducopter_vehicle().horizontal;
  for (const double u_max : {1.0, 5.0}) {
    const EffectiveLag best = effective_lag(loop, 5.0, u_max);
    const double found = worst_of_random(loop, best.tau_s, 5.0, u_max, 60);
    EXPECT_LE(found, best.deviation_m);
    EXPECT_GE(found, 0.6 * best.deviation_m);  // so the bound is no fantasy
  }
}

TEST(CommandDeviation, Of_one_axis_is_not_exceeded_in_the_plane) {
  // The limits bound the length of vectors, so the plane's answer is not made of its axes' answers: tried, not derived.
  const VehicleModel model = arducopter_vehicle();
  const double tau = 0.3;
  const double leak = 5.0;
  const double bound = command_deviation(model.horizontal, tau, leak, 5.0);
  const int late = static_cast<int>(std::lround(model.horizontal.response_delay_s / kDt));
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Vec3> commands(static_cast<std::size_t>(late), Vec3::Zero());
    const std::uint64_t longest = 5 + random() % 200;
    while (commands.size() < 1000) {
      const double angle = 2.0 * M_PI * static_cast<double>(random() % 360) / 360.0;
      commands.insert(commands.end(), 1 + random() % longest, 5.0 * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    VehicleState state;
    Vec3 d = Vec3::Zero();
    for (std::size_t i = static_cast<std::size_t>(late); i < commands.size(); ++i) {
      const VehicleState next = advance(model, state, commands[i - static_cast<std::size_t>(late)], kDt);
      const Vec3 z_gained = next.position - state.position + tau * (next.velocity - state.velocity);
      d = std::exp(-leak * kDt) * d + std::exp(-0.5 * leak * kDt) * (z_gained - kDt * commands[i]);
      state = next;
      ASSERT_LE(d.norm(), bound) << trial;
    }
  }
}

TEST(EffectiveLag, Leaves_no_better_lag_beside_it) {
  for (const VehicleModel& model : {crazyflie_vehicle(), px4_vehicle(), arducopter_vehicle()}) {
    const EffectiveLag best = effective_lag(model.horizontal, 5.0, 1.0);
    for (const double other : {0.0, 0.7 * best.tau_s, 0.95 * best.tau_s, 1.05 * best.tau_s, 1.5 * best.tau_s})
      EXPECT_GE(command_deviation(model.horizontal, other, 5.0, 1.0), best.deviation_m - 1e-6);
  }
}

TEST(GreatestSpeed, Of_a_swinging_loop_exceeds_its_overshoot_because_commands_can_swing_along) {
  const VelocityLoop loop = crazyflie_vehicle().horizontal;
  const double zeta = 1.0 / (2.0 * std::sqrt(loop.proportional_per_s * loop.actuator_lag_s));
  const double first = std::exp(-M_PI * zeta / std::sqrt(1.0 - zeta * zeta));
  EXPECT_NEAR(overshoot(loop, 1.0), loop.gain * (1.0 + first) - 1.0, 1e-4);
  // The total variation of the step response: swings of a falling geometric sequence.
  EXPECT_NEAR(greatest_speed(loop, 1.0), loop.gain * (1.0 + first) / (1.0 - first), 1e-3);
}

TEST(GreatestSpeed, Of_a_limited_loop_is_not_exceeded_by_random_commands) {
  for (const VelocityLoop& loop : {arducopter_vehicle().horizontal, arducopter_vehicle().vertical}) {
    const double bound = greatest_speed(loop, 1.0);
    std::mt19937_64 random(7);
    double fastest = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
      AxisState state;
      for (int i = 0; i < 20; ++i) {
        const double u = random() % 2 == 0 ? 1.0 : -1.0;
        const double lasting = 0.05 * static_cast<double>(1 + random() % 60);
        for (double t = 0.0; t < lasting; t += 0.05) {
          state = advance(loop, state, u, 0.05);
          fastest = std::max(fastest, std::abs(state.velocity_m_s));
        }
      }
    }
    EXPECT_LE(fastest, 1.005 * bound);
    EXPECT_GE(fastest, 0.97 * bound);
    EXPECT_GE(bound, (1.0 + overshoot(loop, 1.0)) * 0.999);
  }
}

TEST(Overshoot, Is_none_where_the_velocity_creeps_up) {
  EXPECT_EQ(overshoot(first_order_lag_vehicle(0.3).horizontal, 1.0), 0.0);
  EXPECT_EQ(overshoot(ideal_vehicle().horizontal, 1.0), 0.0);
}

TEST(StopFrom, Covers_speed_times_lag_where_the_lag_is_of_first_order) {
  VelocityLoop loop = first_order_lag_vehicle(0.3).horizontal;
  loop.response_delay_s = 0.1;
  const Stop stop = stop_from(loop, 2.0);
  EXPECT_NEAR(stop.distance_m, 2.0 * 0.4, 1e-6);
  EXPECT_NEAR(stop.time_s, 0.1 + 0.3 * std::log(20.0), 3e-3);
}

TEST(StopFrom, An_ideal_vehicle_stops_at_once) {
  EXPECT_EQ(stop_from(ideal_vehicle().horizontal, 2.0).distance_m, 0.0);
  EXPECT_EQ(stop_from(ideal_vehicle().horizontal, 2.0).time_s, 0.0);
}

}  // namespace
}  // namespace vigil::dynamics
