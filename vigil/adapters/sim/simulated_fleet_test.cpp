#include "vigil/adapters/sim/simulated_fleet.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/testing/allocation_guard.hpp"

namespace vigil::sim {
namespace {

using swarm::Action;
using swarm::DroneId;
using swarm::VehicleMode;

constexpr double kDt = 0.02;

/// A fleet of `count` drones, one metre apart, and what a controller sees of it.
class Flight {
 public:
  explicit Flight(FleetParameters parameters = {}, std::size_t count = 1)
      : fleet(parameters, starts(count)), observed(count), orders(count) {}

  void step() {
    fleet.observe(runtime::MissionTime(0), observed);
    fleet.order(runtime::MissionTime(0), orders);
    fleet.advance(kDt);
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / kDt); ++i) step();
  }
  void ask(Action action, const Vec2& velocity = Vec2::Zero()) {
    for (swarm::DroneOrder& order : orders) order = {action, velocity};
  }
  [[nodiscard]] const runtime::TruthSample& truth() const { return fleet.truth()[0]; }

  SimulatedFleet fleet;
  std::vector<swarm::DroneObservation> observed;
  std::vector<swarm::DroneOrder> orders;

 private:
  static std::vector<Vec2> starts(std::size_t count) {
    std::vector<Vec2> starts;
    for (std::size_t i = 0; i < count; ++i) starts.emplace_back(static_cast<double>(i), 0.0);
    return starts;
  }
};

FleetParameters grounded() {
  FleetParameters parameters;
  parameters.starts_flying = false;
  return parameters;
}

TEST(SimulatedFleet, An_ideal_drone_moves_as_it_is_told) {
  Flight flight;
  flight.ask(Action::kVelocity, {0.3, -0.1});
  flight.run(2.0);
  EXPECT_NEAR(flight.truth().position.x(), 0.6, 1e-12);
  EXPECT_NEAR(flight.truth().position.y(), -0.2, 1e-12);
}

TEST(SimulatedFleet, Take_off_and_landing_take_their_time) {
  Flight flight(grounded());
  flight.ask(Action::kTakeOff);
  flight.run(1.9);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kTakingOff);
  flight.run(0.2);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kFlying);
  EXPECT_DOUBLE_EQ(flight.truth().height_m, 1.0);
  flight.ask(Action::kLand);
  flight.run(1.9);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kLanding);
  flight.run(0.2);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedFleet, A_drone_on_the_ground_ignores_velocities) {
  Flight flight(grounded());
  flight.ask(Action::kVelocity, {0.3, 0.0});
  flight.run(1.0);
  EXPECT_EQ(flight.truth().position, Vec2::Zero());
}

TEST(SimulatedFleet, Stopping_the_motors_in_the_air_brings_a_drone_down_in_the_emergency_time) {
  Flight flight;
  flight.ask(Action::kStopMotors);
  flight.run(0.4);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kFalling);
  flight.ask(Action::kVelocity, {0.3, 0.0});  // nothing brings it back
  flight.run(0.2);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedFleet, A_failed_drone_hovers_and_obeys_nothing_but_a_stop_of_its_motors) {
  Flight flight;
  flight.fleet.fail(DroneId(0));
  flight.ask(Action::kVelocity, {0.3, 0.0});
  flight.run(1.0);
  EXPECT_EQ(flight.truth().position, Vec2::Zero());
  EXPECT_DOUBLE_EQ(flight.truth().height_m, 1.0);
  flight.ask(Action::kLand);
  flight.run(1.0);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kFailed);
  flight.ask(Action::kStopMotors);
  flight.run(1.0);
  EXPECT_EQ(flight.truth().mode, VehicleMode::kGrounded);
}

TEST(SimulatedFleet, A_pilot_flies_it_until_it_is_given_back) {
  Flight flight;
  flight.fleet.take_over(DroneId(0), {0.0, 0.5});
  flight.ask(Action::kVelocity, {0.3, 0.0});
  flight.run(1.0);
  EXPECT_NEAR(flight.truth().position.y(), 0.5, 1e-12);
  EXPECT_EQ(flight.truth().position.x(), 0.0);
  flight.fleet.give_back(DroneId(0));
  flight.run(1.0);
  EXPECT_NEAR(flight.truth().position.x(), 0.3, 1e-12);
}

TEST(SimulatedFleet, Commands_arrive_after_their_delay) {
  FleetParameters parameters;
  parameters.vehicle.command_delay_s = 0.1;
  Flight flight(parameters);
  flight.ask(Action::kVelocity, {1.0, 0.0});
  flight.run(0.1);
  EXPECT_EQ(flight.truth().position.x(), 0.0);
  flight.run(0.1);
  EXPECT_NEAR(flight.truth().position.x(), 0.1, 1e-12);
}

TEST(SimulatedFleet, The_tracker_delivers_late_and_says_how_old_it_is) {
  FleetParameters parameters;
  parameters.tracker.delay_s = 0.1;
  Flight flight(parameters);
  flight.ask(Action::kVelocity, {1.0, 0.0});
  flight.fleet.observe(runtime::MissionTime(0), flight.observed);
  EXPECT_EQ(flight.observed[0].age_s, swarm::DroneObservation::kNever);  // the first one is still on its way
  flight.run(1.0);
  EXPECT_NEAR(flight.observed[0].age_s, 0.1, 1e-12);
  const double now = flight.truth().position.x() - kDt;  // at the last observation
  EXPECT_NEAR(flight.observed[0].position.x(), now - 0.1, 1e-9);
}

TEST(SimulatedFleet, Its_noise_has_the_size_that_was_asked_for) {
  FleetParameters parameters;
  parameters.tracker.noise_m = 0.01;
  Flight flight(parameters);
  double squares = 0.0;
  constexpr int kSamples = 20'000;
  for (int i = 0; i < kSamples; ++i) {
    flight.fleet.observe(runtime::MissionTime(0), flight.observed);
    squares += flight.observed[0].position.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / (2.0 * kSamples)), 0.01, 2e-4);
}

TEST(SimulatedFleet, What_is_hidden_ages_and_comes_back) {
  Flight flight;
  flight.run(0.1);
  flight.fleet.hide(DroneId(0), 0.5);
  flight.run(0.4);
  EXPECT_NEAR(flight.observed[0].age_s, 0.4, kDt + 1e-9);
  flight.run(0.2);
  EXPECT_DOUBLE_EQ(flight.observed[0].age_s, 0.0);
}

TEST(SimulatedFleet, Dropouts_come_as_often_and_last_as_long_as_asked_for) {
  FleetParameters parameters;
  parameters.tracker.dropouts_per_min = 6.0;
  parameters.tracker.dropout_s = 0.5;
  Flight flight(parameters);
  int unseen = 0;
  constexpr int kTicks = 500'000;
  for (int i = 0; i < kTicks; ++i) {
    flight.fleet.observe(runtime::MissionTime(0), flight.observed);
    if (flight.observed[0].age_s > 0.0) ++unseen;
  }
  // One in ten seconds on average, half a second each: a share of 1 - exp(-0.05) of the time, one tick longer by
  // rounding up.
  const double busy = 0.1 * (0.5 + 0.5 * kDt);
  EXPECT_NEAR(static_cast<double>(unseen) / kTicks, 1.0 - std::exp(-busy), 0.005);
}

TEST(SimulatedFleet, One_drones_luck_does_not_depend_on_how_many_others_there_are) {
  FleetParameters parameters;
  parameters.tracker.noise_m = 0.01;
  Flight alone(parameters, 1);
  Flight together(parameters, 5);
  for (int i = 0; i < 100; ++i) {
    alone.step();
    together.step();
    ASSERT_EQ(alone.observed[0].position, together.observed[0].position);
  }
}

TEST(SimulatedFleet, It_allocates_nothing_in_flight) {
  FleetParameters parameters;
  parameters.tracker.noise_m = 0.01;
  parameters.tracker.delay_s = 0.1;
  parameters.vehicle.command_delay_s = 0.1;
  Flight flight(parameters, 10);
  testing::AllocationGuard guard;
  flight.run(1.0);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::sim
