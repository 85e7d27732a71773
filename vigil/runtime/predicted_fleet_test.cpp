#include "vigil/runtime/predicted_fleet.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using swarm::Action;
using swarm::VehicleMode;

constexpr const char* kVehicle =
    "simulation: {vehicle: {model: first_order_lag, lag_s: 0.3, altitude_m: 2, take_off_s: 4, landing_s: 2, "
    "emergency_s: 1}}\n";

/// Three drones seen flying at their starts, the second as `mode` and `age_s` say.
class PredictedFleetTest : public ::testing::Test {
 protected:
  PredictedFleet fleet_of(VehicleMode mode, double age_s = 0.0) {
    std::vector<swarm::DroneObservation> seen(3);
    for (std::size_t i = 0; i < 3; ++i) {
      seen[i] = {.position = starts_in_field(mission)[i], .height_m = 2.0, .age_s = 0.0, .link_age_s = 0.0};
      seen[i].mode = VehicleMode::kFlying;
    }
    seen[1].mode = mode;
    seen[1].age_s = age_s;
    if (mode == VehicleMode::kGrounded) seen[1].height_m = 0.0;
    swarm::SwarmState state(swarm_parameters(mission, swarm::Intent::kHold));
    swarm::Snapshot snapshot(3);
    swarm::tick(state, seen, {}, snapshot);
    return {state, predicted_vehicle(mission, state.parameters().barrier.lag_s)};
  }
  /// So many ticks of 0.1 s under one order for the second drone.
  const swarm::DroneObservation& after(PredictedFleet& fleet, int ticks, Action action,
                                       const Vec2& velocity = Vec2::Zero()) {
    std::vector<swarm::DroneSnapshot> ordered(3);
    ordered[1].order = {action, velocity};
    for (int n = 0; n < ticks; ++n) fleet.advance(ordered, 0.1);
    return fleet.observations()[1];
  }

  Mission mission = small_mission(kVehicle);
};

TEST_F(PredictedFleetTest, A_drone_follows_its_order_with_its_lag) {
  PredictedFleet fleet = fleet_of(VehicleMode::kFlying);
  const swarm::DroneObservation& drone = after(fleet, 3, Action::kVelocity, {0.2, 0.0});
  EXPECT_NEAR(drone.velocity.x(), 0.2 * (1.0 - std::exp(-1.0)), 1e-12);  // v = u (1 - exp(-t / lag))
}

TEST_F(PredictedFleetTest, A_landing_takes_its_time_and_ends_on_the_ground) {
  PredictedFleet fleet = fleet_of(VehicleMode::kFlying);
  EXPECT_EQ(after(fleet, 19, Action::kLand).mode, VehicleMode::kLanding);
  EXPECT_EQ(after(fleet, 2, Action::kLand).mode, VehicleMode::kGrounded);
  EXPECT_EQ(fleet.observations()[1].height_m, 0.0);
}

TEST_F(PredictedFleetTest, A_take_off_takes_its_time_and_ends_in_flight) {
  PredictedFleet fleet = fleet_of(VehicleMode::kGrounded);
  EXPECT_EQ(after(fleet, 39, Action::kTakeOff).mode, VehicleMode::kTakingOff);
  EXPECT_EQ(after(fleet, 2, Action::kTakeOff).mode, VehicleMode::kFlying);
  EXPECT_DOUBLE_EQ(fleet.observations()[1].height_m, 2.0);
}

TEST_F(PredictedFleetTest, A_drone_whose_motors_stop_falls) {
  PredictedFleet fleet = fleet_of(VehicleMode::kFlying);
  EXPECT_EQ(after(fleet, 9, Action::kStopMotors).mode, VehicleMode::kFalling);
  EXPECT_EQ(after(fleet, 2, Action::kNone).mode, VehicleMode::kGrounded);
}

TEST_F(PredictedFleetTest, Who_is_on_the_ground_or_failed_stays_where_it_is_whatever_it_is_told) {
  for (const VehicleMode mode : {VehicleMode::kGrounded, VehicleMode::kFailed, VehicleMode::kManual}) {
    PredictedFleet fleet = fleet_of(mode);
    const Vec2 before = fleet.observations()[1].position;
    EXPECT_EQ(after(fleet, 10, Action::kVelocity, {0.2, 0.0}).position, before);
    EXPECT_EQ(fleet.observations()[1].mode, mode);
  }
}

TEST_F(PredictedFleetTest, Who_is_not_seen_any_more_stays_lost_and_all_others_are_seen_as_they_are) {
  const double timeout_s = mission.health.tracking_timeout_s;
  PredictedFleet lost = fleet_of(VehicleMode::kFlying, 1.5 * timeout_s);
  EXPECT_NEAR(after(lost, 10, Action::kVelocity).age_s, 1.5 * timeout_s + 1.0, 1e-9);
  PredictedFleet late = fleet_of(VehicleMode::kFlying, 0.5 * timeout_s);
  EXPECT_EQ(after(late, 10, Action::kVelocity).age_s, 0.0);
}

TEST(PredictedVehicleTest, A_recorded_autopilot_is_its_gain_and_the_lag_that_the_filter_takes_it_for) {
  const Mission mission = small_mission("simulation: {vehicle: {model: crazyflie}}\n");
  const PredictedVehicle vehicle = predicted_vehicle(mission, 0.25);
  EXPECT_EQ(vehicle.motion.lag_s, 0.25);
  EXPECT_EQ(vehicle.gain, dynamics::steady_gain(vehicle_model(mission).horizontal));
  EXPECT_LT(vehicle.gain, 1.0);
}

TEST_F(PredictedFleetTest, Batteries_are_emptied_in_the_air_and_charged_on_pads_where_there_are_stations) {
  mission.stations.push_back({.name = "s", .pads_m = {mission.drones[1].start_m}, .full_in_s = 100.0});
  std::vector<swarm::DroneObservation> seen(3);
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = {.position = starts_in_field(mission)[i], .height_m = 2.0, .age_s = 0.0, .link_age_s = 0.0};
    seen[i].mode = VehicleMode::kFlying;
  }
  seen[0].battery = 0.8;
  seen[1].battery = 0.5;
  seen[1].mode = VehicleMode::kGrounded;
  swarm::SwarmState state(swarm_parameters(mission, swarm::Intent::kHold));
  swarm::Snapshot snapshot(3);
  swarm::tick(state, seen, {}, snapshot);
  PredictedFleet fleet(state, predicted_vehicle(mission, state.parameters().barrier.lag_s));
  after(fleet, 100, Action::kNone);
  EXPECT_NEAR(fleet.observations()[0].battery, 0.8 - 10.0 * state.drones()[0].energy.rate_per_s(), 1e-9);
  EXPECT_NEAR(fleet.observations()[1].battery, 0.6, 1e-9);
  EXPECT_TRUE(std::isnan(fleet.observations()[2].battery));  // not reported
}

}  // namespace
}  // namespace vigil::runtime
