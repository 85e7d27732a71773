#include "vigil/core/dynamics/velocity_loop.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {
namespace {

/// sat of the contract, written down once more.
double saturated(double x, double limit) {
  return std::isinf(limit) ? x : x / std::pow(1.0 + std::pow(std::abs(x) / limit, 4.0), 0.25);
}

/// The contract's equations in tiny midpoint steps: the oracle.
AxisState integrate(const VelocityLoop& loop, AxisState state, double u, double dt_s, int steps, double push) {
  const double h = dt_s / steps;
  const auto rate = [&](const AxisState& x) {
    const double e = loop.gain * u - x.velocity_m_s;
    const double c = saturated(loop.proportional_per_s * e + x.correction_m_s2, loop.acceleration_limit_m_s2) -
                     loop.drag_per_s * x.velocity_m_s;
    const double change = saturated((c - x.acceleration_m_s2) / loop.actuator_lag_s, loop.jerk_limit_m_s3);
    return AxisState{x.velocity_m_s, x.acceleration_m_s2 + push, change, loop.integral_per_s2 * e};
  };
  const auto moved = [](const AxisState& x, const AxisState& by, double dt) {
    return AxisState{x.position_m + dt * by.position_m, x.velocity_m_s + dt * by.velocity_m_s,
                     x.acceleration_m_s2 + dt * by.acceleration_m_s2, x.correction_m_s2 + dt * by.correction_m_s2};
  };
  for (int i = 0; i < steps; ++i) state = moved(state, rate(moved(state, rate(state), 0.5 * h)), h);
  return state;
}

void expect_close(const AxisState& a, const AxisState& b, double tolerance) {
  EXPECT_NEAR(a.position_m, b.position_m, tolerance);
  EXPECT_NEAR(a.velocity_m_s, b.velocity_m_s, tolerance);
  EXPECT_NEAR(a.acceleration_m_s2, b.acceleration_m_s2, tolerance);
  EXPECT_NEAR(a.correction_m_s2, b.correction_m_s2, tolerance);
}

TEST(VelocityLoop, Its_steps_solve_the_differential_equations) {
  const AxisState start{0.3, -0.8, 0.4, 0.1};
  for (const VehicleModel& model : {crazyflie_vehicle(), arducopter_vehicle(), px4_vehicle()})
    for (const VelocityLoop& loop : {model.horizontal, model.vertical})
      for (const double dt : {0.0001, 0.02, 0.1, 1.5})
        expect_close(advance(loop, start, 2.5, dt, 0.2), integrate(loop, start, 2.5, dt, 50'000, 0.2), 1e-6);
}

TEST(VelocityLoop, A_second_order_loop_has_the_textbook_s_step_response) {
  const VelocityLoop loop{.gain = 0.9, .proportional_per_s = 4.0, .actuator_lag_s = 0.2};
  const double wn = std::sqrt(4.0 / 0.2);
  const double zeta = 1.0 / (2.0 * std::sqrt(4.0 * 0.2));
  const double wd = wn * std::sqrt(1.0 - zeta * zeta);
  for (const double t : {0.05, 0.3, 1.0, 2.0}) {
    const double ring = std::cos(wd * t) + zeta * wn / wd * std::sin(wd * t);
    EXPECT_NEAR(advance(loop, {}, 1.5, t).velocity_m_s, 0.9 * 1.5 * (1.0 - std::exp(-zeta * wn * t) * ring), 2e-8);
  }
}

TEST(VelocityLoop, Without_actuator_lag_the_closed_form_is_the_limit_of_a_short_one) {
  VelocityLoop loop{.proportional_per_s = 1.0 / 0.3};
  const AxisState start{.velocity_m_s = -0.5};
  const AxisState exact = advance(loop, start, 1.0, 0.7, 0.4);
  EXPECT_NEAR(exact.velocity_m_s, 1.12 - 1.62 * std::exp(-0.7 / 0.3), 1e-12);
  loop.actuator_lag_s = 1e-4;
  EXPECT_NEAR(exact.velocity_m_s, integrate(loop, start, 1.0, 0.7, 100'000, 0.4).velocity_m_s, 1e-3);
  EXPECT_NEAR(exact.position_m, integrate(loop, start, 1.0, 0.7, 100'000, 0.4).position_m, 1e-3);
}

TEST(VelocityLoop, Acceleration_and_jerk_stay_below_their_limits) {
  const VelocityLoop loop = arducopter_vehicle().horizontal;
  AxisState state;
  for (int i = 0; i < 4000; ++i) {
    const AxisState next = advance(loop, state, (i / 137) % 2 == 0 ? 8.0 : -8.0, 0.005);
    EXPECT_LT(std::abs(next.acceleration_m_s2), loop.acceleration_limit_m_s2);
    EXPECT_LT(std::abs(next.acceleration_m_s2 - state.acceleration_m_s2), 0.005 * loop.jerk_limit_m_s3);
    state = next;
  }
}

TEST(VelocityLoop, A_flight_at_the_command_s_own_speed_goes_on_unchanged) {
  for (const VehicleModel& model : {crazyflie_vehicle(), arducopter_vehicle(), px4_vehicle(), ideal_vehicle()})
    for (const VelocityLoop& loop : {model.horizontal, model.vertical}) {
      const double speed = 0.8 * steady_gain(loop);
      const AxisState after = advance(loop, in_flight(loop, speed, 0.8), 0.8, 3.0);
      EXPECT_NEAR(after.velocity_m_s, speed, 1e-12);
      EXPECT_NEAR(after.position_m, 3.0 * speed, 1e-12);
    }
}

TEST(VelocityLoop, Drag_without_an_integral_lowers_the_steady_speed) {
  const VelocityLoop loop{.proportional_per_s = 2.0, .drag_per_s = 0.5, .actuator_lag_s = 0.1};
  EXPECT_NEAR(advance(loop, {}, 1.0, 20.0).velocity_m_s, steady_gain(loop), 1e-9);
  EXPECT_DOUBLE_EQ(steady_gain(loop), 0.8);
}

}  // namespace
}  // namespace vigil::dynamics
