#include "vigil/core/dynamics/wind.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {
namespace {

const Wind kBreeze{.mean_m_s = Vec3(4.0, 1.0, 0.0), .gusts = {1.5, 3.0}, .vertical_gusts = {0.5, 1.0}};

TEST(Wind, A_steady_wind_that_has_been_leant_against_moves_nothing) {
  Wind steady = kBreeze;
  steady.gusts.sigma = steady.vertical_gusts.sigma = 0.0;
  WindState state = settled_wind(steady, Vec3::Ones());
  for (int i = 0; i < 100; ++i) state = advance(steady, state, Vec3::Ones(), 0.02);
  EXPECT_LT(push_of(steady, state).norm(), 1e-12);
  EXPECT_EQ(air_velocity(steady, state), steady.mean_m_s);
}

TEST(Wind, A_sudden_wind_pushes_by_its_drag_and_is_rejected_with_the_time_constant) {
  Wind sudden = kBreeze;
  sudden.gusts.sigma = sudden.vertical_gusts.sigma = 0.0;
  WindState state;
  EXPECT_LT((push_of(sudden, state) - sudden.drag_per_s * sudden.mean_m_s).norm(), 1e-12);
  for (int i = 0; i < 30; ++i) state = advance(sudden, state, Vec3::Zero(), sudden.rejection_time_s / 30);
  EXPECT_LT((push_of(sudden, state) - std::exp(-1.0) * sudden.drag_per_s * sudden.mean_m_s).norm(), 1e-12);
}

TEST(Wind, Gusts_have_their_strength_about_the_mean_and_push_both_ways) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto normals = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  WindState state = settled_wind(kBreeze, normals());
  Vec3 mean = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  Vec3 push = Vec3::Zero();
  constexpr int kSteps = 200'000;
  for (int i = 0; i < kSteps; ++i) {
    state = advance(kBreeze, state, normals(), 0.1);
    mean += air_velocity(kBreeze, state) / kSteps;
    squares += (air_velocity(kBreeze, state) - kBreeze.mean_m_s).cwiseAbs2() / kSteps;
    push += push_of(kBreeze, state) / kSteps;
  }
  EXPECT_LT((mean - kBreeze.mean_m_s).norm(), 0.1);
  EXPECT_NEAR(std::sqrt(squares.x()), 1.5, 0.05);
  EXPECT_NEAR(std::sqrt(squares.y()), 1.5, 0.05);
  EXPECT_NEAR(std::sqrt(squares.z()), 0.5, 0.02);
  EXPECT_LT(push.norm(), 0.01);
}

TEST(Wind, A_gust_moves_every_autopilot_and_lets_it_come_to_rest_again) {
  for (const VehicleModel& model : {crazyflie_vehicle(), arducopter_vehicle(), px4_vehicle()}) {
    Wind gust{.mean_m_s = Vec3(3.0, 0.0, 0.0)};
    WindState wind;
    VehicleState vehicle;
    double fastest = 0.0;
    for (int i = 0; i < 3000; ++i) {
      vehicle = advance(model, vehicle, Vec3::Zero(), 0.02, push_of(gust, wind));
      wind = advance(gust, wind, Vec3::Zero(), 0.02);
      fastest = std::max(fastest, vehicle.velocity.norm());
    }
    EXPECT_GT(fastest, 0.05);
    EXPECT_LT(fastest, gust.mean_m_s.norm() * gust.drag_per_s * gust.rejection_time_s);
    EXPECT_LT(vehicle.velocity.norm(), 0.01);
  }
}

}  // namespace
}  // namespace vigil::dynamics
