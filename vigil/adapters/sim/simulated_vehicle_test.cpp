#include "vigil/adapters/sim/simulated_vehicle.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/response_bounds.hpp"
#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::sim {
namespace {

using dynamics::VehicleKind;
using swarm::Action;
using swarm::VehicleMode;

constexpr double kDt = 0.02;

VehicleParameters parameters_of(const dynamics::VehicleModel& model) {
  VehicleParameters parameters;
  parameters.motion = model.horizontal;
  parameters.failsafe = dynamics::failsafe_of(model.kind);
  return parameters;
}

/// A vehicle in steady flight at a commanded metre per second.
SimulatedVehicle flying(const VehicleParameters& parameters, std::size_t dead_ticks = 0) {
  SimulatedVehicle vehicle(parameters, Vec2::Zero(), true, dead_ticks);
  for (int i = 0; i < 3000; ++i) {
    vehicle.obey({Action::kVelocity, {1.0, 0.0}});
    vehicle.advance(kDt);
  }
  return vehicle;
}

/// Without an order.
void wait(SimulatedVehicle& vehicle, double seconds) {
  for (int i = 0; i < std::lround(seconds / kDt); ++i) vehicle.advance(kDt);
}

TEST(SimulatedVehicle, A_failed_one_stops_as_its_model_does_and_ignores_velocities) {
  for (const dynamics::VehicleModel& model :
       {dynamics::crazyflie_vehicle(), dynamics::arducopter_vehicle(), dynamics::px4_vehicle()}) {
    const auto dead_ticks = static_cast<std::size_t>(std::lround(model.horizontal.response_delay_s / kDt));
    SimulatedVehicle vehicle = flying(parameters_of(model), dead_ticks);
    const double speed = vehicle.truth().velocity.x();
    EXPECT_NEAR(speed, dynamics::steady_gain(model.horizontal), 0.01);
    const double from = vehicle.truth().position.x();
    double farthest = from;
    vehicle.fail();
    for (int i = 0; i < 3000; ++i) {
      vehicle.obey({Action::kVelocity, {-1.0, 0.5}});
      vehicle.advance(kDt);
      farthest = std::max(farthest, vehicle.truth().position.x());
    }
    dynamics::VelocityLoop loop = model.horizontal;
    loop.response_delay_s = static_cast<double>(dead_ticks) * kDt;
    EXPECT_NEAR(farthest - from, dynamics::stop_from(loop, speed).distance_m, 0.01) << name_of(model.kind);
    EXPECT_GT(farthest - from, 0.15);
    EXPECT_EQ(vehicle.truth().position.y(), 0.0);
    EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFailed);
    EXPECT_LT(vehicle.truth().velocity.norm(), 1e-3);
  }
}

/// How far gusts, here a slow push to and fro, carry a vehicle that has failed.
double greatest_drift(const VehicleParameters& parameters) {
  SimulatedVehicle vehicle = flying(parameters);
  vehicle.fail();
  wait(vehicle, 20.0);
  const Vec2 rest = vehicle.truth().position;
  double farthest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    vehicle.advance(kDt, Vec2(0.0, 0.3 * std::sin(0.2 * kDt * i)));
    farthest = std::max(farthest, (vehicle.truth().position - rest).norm());
  }
  return farthest;
}

TEST(SimulatedVehicle, A_position_hold_keeps_it_in_its_place_in_gusts) {
  for (const dynamics::VehicleModel& model : {dynamics::arducopter_vehicle(), dynamics::px4_vehicle()}) {
    VehicleParameters parameters = parameters_of(model);
    const double drifting = greatest_drift(parameters);
    parameters.position_hold_per_s = dynamics::position_hold_gain(model.kind);
    EXPECT_LT(greatest_drift(parameters), 0.3) << name_of(model.kind);
    EXPECT_GT(drifting, 0.6) << name_of(model.kind);
  }
}

TEST(SimulatedVehicle, A_crazyflie_without_orders_flies_on_hovers_then_falls) {
  SimulatedVehicle vehicle = flying(parameters_of(dynamics::crazyflie_vehicle()));
  wait(vehicle, 0.46);
  EXPECT_NEAR(vehicle.truth().velocity.x(), 0.878, 0.01);  // follows its last setpoint
  wait(vehicle, 1.5);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFlying);
  EXPECT_LT(vehicle.truth().velocity.norm(), 0.05);
  EXPECT_DOUBLE_EQ(vehicle.truth().height_m, 1.0);
  wait(vehicle, 0.1);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFalling);
  vehicle.obey({Action::kVelocity, {1.0, 0.0}});  // too late
  wait(vehicle, 0.6);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedVehicle, A_crazyflie_that_hears_again_in_time_goes_on) {
  SimulatedVehicle vehicle = flying(parameters_of(dynamics::crazyflie_vehicle()));
  for (int i = 0; i < 50; ++i) {
    wait(vehicle, 1.5);
    vehicle.obey({Action::kVelocity, {1.0, 0.0}});
  }
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFlying);
}

TEST(SimulatedVehicle, An_arducopter_without_orders_brakes_after_three_seconds_and_follows_the_next_one) {
  SimulatedVehicle vehicle = flying(parameters_of(dynamics::arducopter_vehicle()));
  wait(vehicle, 2.96);
  EXPECT_NEAR(vehicle.truth().velocity.x(), 1.0, 0.01);
  wait(vehicle, 60.0);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFlying);
  EXPECT_LT(vehicle.truth().velocity.norm(), 1e-6);
  for (int i = 0; i < 500; ++i) {
    vehicle.obey({Action::kVelocity, {0.0, 1.0}});
    vehicle.advance(kDt);
  }
  EXPECT_NEAR(vehicle.truth().velocity.y(), 1.0, 0.01);
}

TEST(SimulatedVehicle, A_px4_without_orders_hovers_after_a_second_and_says_that_it_follows_nobody) {
  SimulatedVehicle vehicle = flying(parameters_of(dynamics::px4_vehicle()));
  wait(vehicle, 0.96);
  EXPECT_NEAR(vehicle.truth().velocity.x(), 1.0, 0.01);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFlying);
  wait(vehicle, 0.1);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kFailed);
  for (int i = 0; i < 3000; ++i) {
    vehicle.obey({Action::kVelocity, {0.0, 1.0}});
    vehicle.advance(kDt);
  }
  EXPECT_LT(vehicle.truth().velocity.norm(), 0.01);
  EXPECT_EQ(vehicle.truth().velocity.y(), 0.0);
  EXPECT_DOUBLE_EQ(vehicle.truth().height_m, 1.0);
}

TEST(SimulatedVehicle, Take_off_landing_and_a_pilot_need_no_orders) {
  VehicleParameters parameters = parameters_of(dynamics::crazyflie_vehicle());
  parameters.take_off_s = parameters.landing_s = 5.0;
  SimulatedVehicle vehicle(parameters, Vec2::Zero(), false);
  vehicle.obey({Action::kTakeOff, Vec2::Zero()});
  wait(vehicle, 4.9);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kTakingOff);
  wait(vehicle, 0.2);
  vehicle.take_over({0.2, 0.0});
  wait(vehicle, 10.0);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kManual);
  vehicle.give_back();
  vehicle.obey({Action::kLand, Vec2::Zero()});
  wait(vehicle, 4.9);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kLanding);
  wait(vehicle, 0.2);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedVehicle, With_an_empty_battery_it_lands_and_takes_off_no_more) {
  VehicleParameters parameters = parameters_of(dynamics::crazyflie_vehicle());
  parameters.battery = {dynamics::crazyflie_battery(), dynamics::kCrazyflieHoverPower, 0.1};
  SimulatedVehicle vehicle(parameters, Vec2::Zero(), true);
  double flown_s = 0.0;
  double reported = vehicle.reported_battery();
  while (vehicle.truth().mode == VehicleMode::kFlying) {
    vehicle.obey({Action::kVelocity, {0.1, 0.0}});
    vehicle.advance(kDt);
    flown_s += kDt;
    EXPECT_LE(vehicle.reported_battery(), reported);
    reported = vehicle.reported_battery();
  }
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kLanding);
  EXPECT_GT(flown_s, 20.0);
  EXPECT_LT(flown_s, 42.0);
  wait(vehicle, 2.1);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kGrounded);
  vehicle.obey({Action::kTakeOff, Vec2::Zero()});
  wait(vehicle, 1.0);
  EXPECT_EQ(vehicle.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedVehicle, Without_a_battery_it_reports_none) {
  EXPECT_TRUE(std::isnan(SimulatedVehicle({}, Vec2::Zero(), true).reported_battery()));
}

}  // namespace
}  // namespace vigil::sim
