#include "vigil/core/dynamics/planar_vehicle.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

/// The differential equation itself, in tiny Euler steps: the oracle of the closed form.
PlanarState integrate(const PlanarVehicle& vehicle, PlanarState state, const Vec2& u, double dt_s, int steps) {
  const double h = dt_s / steps;
  for (int i = 0; i < steps; ++i) {
    Vec2 acceleration = (u - state.velocity) / vehicle.lag_s;
    if (vehicle.acceleration_limit_m_s2 && acceleration.norm() > *vehicle.acceleration_limit_m_s2)
      acceleration *= *vehicle.acceleration_limit_m_s2 / acceleration.norm();
    state.position += (state.velocity + 0.5 * h * acceleration) * h;
    state.velocity += acceleration * h;
  }
  return state;
}

TEST(PlanarVehicle, Without_lag_the_velocity_is_the_command) {
  const PlanarState after = advance({}, {Vec2(1.0, 2.0), Vec2(9.0, 9.0)}, Vec2(0.3, -0.1), 0.5);
  EXPECT_EQ(after.position, Vec2(1.15, 1.95));
  EXPECT_EQ(after.velocity, Vec2(0.3, -0.1));
}

TEST(PlanarVehicle, The_closed_form_solves_the_differential_equation) {
  const PlanarState start{Vec2(0.2, -0.4), Vec2(-0.5, 0.3)};
  for (const double dt : {0.02, 0.3, 2.0}) {
    for (const std::optional<double>& limit :
         {std::optional<double>{}, std::optional<double>{0.4}, std::optional<double>{50.0}}) {
      const PlanarVehicle vehicle{0.3, limit};
      const PlanarState exact = advance(vehicle, start, Vec2(1.0, 0.5), dt);
      const PlanarState slow = integrate(vehicle, start, Vec2(1.0, 0.5), dt, 200'000);
      EXPECT_LT((exact.position - slow.position).norm(), 2e-5) << dt;
      EXPECT_LT((exact.velocity - slow.velocity).norm(), 2e-5) << dt;
    }
  }
}

TEST(PlanarVehicle, Two_half_steps_equal_one_step) {
  const PlanarVehicle vehicle{0.2, 1.5};
  const PlanarState start{Vec2(0.0, 0.0), Vec2(0.0, -1.0)};
  const Vec2 u(2.0, 1.0);
  const PlanarState once = advance(vehicle, start, u, 1.0);
  const PlanarState twice = advance(vehicle, advance(vehicle, start, u, 0.5), u, 0.5);
  EXPECT_LT((once.position - twice.position).norm(), 1e-12);
  EXPECT_LT((once.velocity - twice.velocity).norm(), 1e-12);
}

TEST(PlanarVehicle, It_never_goes_faster_than_its_fastest_command) {
  const PlanarVehicle vehicle{0.3, 2.0};
  PlanarState state;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.7 * i * i;
    state = advance(vehicle, state, 0.3 * Vec2(std::cos(angle), std::sin(angle)), 0.02);
    EXPECT_LE(state.velocity.norm(), 0.3 + 1e-12);
  }
}

}  // namespace
}  // namespace vigil::dynamics
