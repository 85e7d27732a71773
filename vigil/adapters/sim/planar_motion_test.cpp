#include "vigil/adapters/sim/planar_motion.hpp"

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::sim {
namespace {

constexpr double kDt = 0.02;

/// A command that turns, and now and then stops.
Vec2 command_at(int tick) { return tick % 100 < 60 ? Vec2(0.8, tick % 200 < 100 ? 0.3 : -0.6) : Vec2::Zero(); }

TEST(PlanarMotion, An_autopilot_flies_as_its_core_model_under_the_commands_of_a_dead_time_before) {
  constexpr int kDead = 6;
  for (const dynamics::VehicleModel& model :
       {dynamics::crazyflie_vehicle(), dynamics::arducopter_vehicle(), dynamics::px4_vehicle()}) {
    PlanarMotion motion(model.horizontal, kDead);
    dynamics::VehicleState state;
    const Vec2 push(0.2, -0.1);
    for (int tick = 0; tick < 300; ++tick) {
      motion.advance(command_at(tick), kDt, push);
      const Vec2 u = tick < kDead ? Vec2(Vec2::Zero()) : command_at(tick - kDead);
      state = dynamics::advance(model, state, Vec3(u.x(), u.y(), 0.0), kDt, Vec3(push.x(), push.y(), 0.0));
      ASSERT_EQ(motion.position(), state.position.head<2>());
      ASSERT_EQ(motion.velocity(), state.velocity.head<2>());
    }
  }
}

TEST(PlanarMotion, A_lag_feels_a_push_as_its_core_model_does) {
  const dynamics::VehicleModel model = dynamics::first_order_lag_vehicle(0.3);
  PlanarMotion motion(dynamics::PlanarVehicle{0.3, {}}, 0);
  dynamics::VehicleState state;
  for (int tick = 0; tick < 300; ++tick) {
    motion.advance(command_at(tick), kDt, Vec2(0.5, 0.0));
    const Vec2 u = command_at(tick);
    state = dynamics::advance(model, state, Vec3(u.x(), u.y(), 0.0), kDt, Vec3(0.5, 0.0, 0.0));
    ASSERT_LT((motion.position() - state.position.head<2>()).norm(), 1e-12);
    ASSERT_LT((motion.velocity() - state.velocity.head<2>()).norm(), 1e-12);
  }
}

TEST(PlanarMotion, An_ideal_vehicle_feels_no_push) {
  PlanarMotion motion(dynamics::PlanarVehicle{}, 0);
  motion.advance(Vec2(1.0, 0.0), kDt, Vec2(5.0, 5.0));
  EXPECT_EQ(motion.position(), Vec2(kDt, 0.0));
}

TEST(PlanarMotion, At_rest_it_has_forgotten_the_commands_that_were_under_way) {
  PlanarMotion motion(dynamics::PlanarVehicle{}, 5);
  for (int i = 0; i < 5; ++i) motion.advance(Vec2(1.0, 0.0), kDt, Vec2::Zero());
  motion.rest_at(Vec2(3.0, 4.0));
  for (int i = 0; i < 10; ++i) motion.advance(Vec2::Zero(), kDt, Vec2::Zero());
  EXPECT_EQ(motion.position(), Vec2(3.0, 4.0));
}

}  // namespace
}  // namespace vigil::sim
