#include "vigil/adapters/sim/simulated_fleet.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"
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
  explicit Flight(FleetParameters parameters = {}, std::size_t count = 1, parallel::Workers* workers = nullptr)
      : fleet(parameters, starts(count), workers), observed(count), orders(count) {}

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

TEST(SimulatedFleet, Any_number_of_threads_gives_the_same_bits) {
  FleetParameters parameters;
  parameters.tracker = {.noise_m = 0.01, .delay_s = 0.06, .jitter_s = 0.04, .dropouts_per_min = 6.0};
  parameters.confusion = {.swaps_per_h = 3600.0};
  parameters.link.packets = dynamics::bursty_link(0.1, 3.0, 0.04, 0.04);
  parameters.wind.gusts = {.sigma = 0.5, .time_s = 2.0};
  constexpr std::size_t kDrones = 1500;
  parallel::Workers three(3);
  Flight alone(parameters, kDrones);
  Flight shared(parameters, kDrones, &three);
  for (Flight* const flight : {&alone, &shared}) {
    flight->ask(Action::kVelocity, {0.3, -0.1});
    flight->run(1.0);
  }
  for (std::size_t i = 0; i < kDrones; ++i) {
    ASSERT_EQ(shared.fleet.truth()[i].position, alone.fleet.truth()[i].position) << i;
    ASSERT_EQ(shared.observed[i].position, alone.observed[i].position) << i;
    ASSERT_EQ(shared.observed[i].link_age_s, alone.observed[i].link_age_s) << i;
  }
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

/// Everything that a mission can ask for.
FleetParameters everything() {
  FleetParameters parameters;
  parameters.vehicle.motion = dynamics::px4_vehicle().horizontal;
  parameters.vehicle.failsafe = dynamics::failsafe_of(dynamics::VehicleKind::kPx4);
  parameters.vehicle.battery = {dynamics::outdoor_battery(), dynamics::kOutdoorHoverPower, 0.9};
  parameters.vehicle.command_delay_s = 0.03;
  parameters.tracker = {.noise_m = 0.01,
                        .velocity_noise_m_s = 0.02,
                        .delay_s = 0.05,
                        .jitter_s = 0.05,
                        .measurements_per_tick = 0.5,
                        .dropouts_per_min = 6.0,
                        .bias = {0.5, 10.0}};
  parameters.confusion = {.swaps_per_h = 3600.0, .swap_s = 0.3};
  parameters.link = {.packets = dynamics::bursty_link(0.1, 5.0, 0.02, 0.04), .packets_per_tick = 0.5};
  parameters.wind = {.mean_m_s = Vec3(3.0, 1.0, 0.0), .gusts = {1.0, 3.0}};
  return parameters;
}

TEST(SimulatedFleet, Each_autopilot_flies_as_its_core_model_after_all_delays) {
  for (const dynamics::VehicleModel& model :
       {dynamics::crazyflie_vehicle(), dynamics::arducopter_vehicle(), dynamics::px4_vehicle()}) {
    FleetParameters parameters;
    parameters.vehicle.motion = model.horizontal;
    parameters.vehicle.command_delay_s = 0.02;
    parameters.link.packets.delay_s = 0.012;
    Flight flight(parameters);
    flight.ask(Action::kVelocity, {0.8, -0.3});
    flight.run(2.0);
    // Rounded at once: 0.032 s + 0.135 s are eight ticks, where each by itself would make two and seven.
    const double whole_s = 0.032 + model.horizontal.response_delay_s;
    const double dead_s = static_cast<double>(std::lround(whole_s / kDt)) * kDt;
    const dynamics::PlanarLoopState after = dynamics::advance(model.horizontal, {}, {0.8, -0.3}, 2.0 - dead_s);
    EXPECT_LT((flight.truth().position - after.position).norm(), 1e-6) << name_of(model.kind);
    EXPECT_LT((flight.truth().velocity - after.velocity).norm(), 1e-6) << name_of(model.kind);
  }
}

TEST(SimulatedFleet, When_the_link_dies_for_good_each_autopilot_ends_as_recorded) {
  struct End {
    dynamics::VehicleModel model;
    double flies_on_s;
    VehicleMode at_the_end;
  };
  for (const End& end : {End{dynamics::crazyflie_vehicle(), 0.5, VehicleMode::kGrounded},
                         End{dynamics::arducopter_vehicle(), 3.0, VehicleMode::kFlying},
                         End{dynamics::px4_vehicle(), 1.0, VehicleMode::kFailed}}) {
    FleetParameters parameters;
    parameters.vehicle.motion = end.model.horizontal;
    parameters.vehicle.failsafe = dynamics::failsafe_of(end.model.kind);
    Flight flight(parameters);
    flight.ask(Action::kVelocity, {0.5, 0.0});
    flight.run(60.0);
    const double speed = flight.truth().velocity.x();
    flight.fleet.cut_link(DroneId(0), 1e6);
    flight.run(end.flies_on_s - 0.04);
    EXPECT_NEAR(flight.truth().velocity.x(), speed, 1e-3) << name_of(end.model.kind);
    flight.run(20.0 - end.flies_on_s);
    EXPECT_EQ(flight.truth().mode, end.at_the_end) << name_of(end.model.kind);
    EXPECT_LT(flight.truth().velocity.norm(), 0.1 * speed);
    EXPECT_NEAR(flight.observed[0].link_age_s, 20.0 - 0.04, kDt + 1e-9);
    EXPECT_EQ(flight.observed[0].mode, VehicleMode::kFlying);  // the last that was heard
    EXPECT_DOUBLE_EQ(flight.observed[0].age_s, 0.0);           // the tracker needs no link
  }
}

TEST(SimulatedFleet, What_is_not_heard_ages_and_comes_back) {
  FleetParameters parameters = grounded();
  parameters.vehicle.battery = {dynamics::crazyflie_battery(), dynamics::kCrazyflieHoverPower, 0.5};
  Flight flight(parameters);
  flight.run(1.0);
  EXPECT_EQ(flight.observed[0].link_age_s, 0.0);
  EXPECT_NEAR(flight.observed[0].battery, 0.5, 1e-9);
  flight.fleet.cut_link(DroneId(0), 0.5);
  flight.run(0.4);
  EXPECT_NEAR(flight.observed[0].link_age_s, 0.4, 1e-9);
  flight.run(0.2);
  EXPECT_EQ(flight.observed[0].link_age_s, 0.0);
}

TEST(SimulatedFleet, A_position_that_comes_over_the_link_is_lost_with_it_and_as_old_as_it_says) {
  FleetParameters parameters;
  parameters.positions_over_link = true;
  parameters.tracker.delay_s = 0.06;
  parameters.link.packets.delay_s = 0.04;
  Flight flight(parameters);
  flight.ask(Action::kVelocity, {1.0, 0.0});
  flight.run(1.0);
  EXPECT_NEAR(flight.observed[0].age_s, 0.1, 1e-9);
  EXPECT_NEAR(flight.observed[0].position.x(), flight.truth().position.x() - kDt - 0.1, 1e-9);
  flight.fleet.cut_link(DroneId(0), 0.5);
  flight.run(0.5);
  // What was sent before the cut has arrived in the meantime.
  EXPECT_NEAR(flight.observed[0].age_s, 0.1 + 0.5 - 0.04, 1e-9);
  flight.run(0.1);
  EXPECT_NEAR(flight.observed[0].age_s, 0.1, 1e-9);
}

TEST(SimulatedFleet, Bodies_that_are_confused_are_seen_at_each_others_place) {
  FleetParameters parameters;
  parameters.confusion = {.swaps_per_h = 36'000.0, .swap_s = 0.2};
  Flight flight(parameters, 2);
  flight.orders = {{Action::kVelocity, {0.0, 0.1}}, {Action::kVelocity, {0.0, -0.2}}};
  int confused = 0;
  for (int i = 0; i < 500; ++i) {
    const std::vector<runtime::TruthSample> truth(flight.fleet.truth().begin(), flight.fleet.truth().end());
    flight.step();
    const bool is_confused = flight.observed[0].position != truth[0].position;
    const std::size_t body = is_confused ? 1 : 0;
    EXPECT_EQ(flight.observed[0].position, truth[body].position);
    EXPECT_EQ(flight.observed[0].velocity, truth[body].velocity);
    EXPECT_EQ(flight.observed[1].position, truth[1 - body].position);
    EXPECT_EQ(flight.observed[1].velocity, truth[1 - body].velocity);
    confused += is_confused ? 1 : 0;
  }
  EXPECT_GT(confused, 100);
  EXPECT_LT(confused, 450);
}

TEST(SimulatedFleet, The_same_seed_gives_the_same_bits_and_another_one_others) {
  FleetParameters other_seed = everything();
  other_seed.seed = 2;
  Flight first(everything(), 5);
  Flight again(everything(), 5);
  Flight other(other_seed, 5);
  for (Flight* const flight : {&first, &again, &other}) {
    flight->ask(Action::kVelocity, {1.0, 0.5});
    flight->run(20.0);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(first.fleet.truth()[i].position, again.fleet.truth()[i].position);
    EXPECT_EQ(first.observed[i].position, again.observed[i].position);
    EXPECT_EQ(first.observed[i].link_age_s, again.observed[i].link_age_s);
    EXPECT_EQ(first.observed[i].battery, again.observed[i].battery);
    EXPECT_NE(first.fleet.truth()[i].position, other.fleet.truth()[i].position);
  }
}

TEST(SimulatedFleet, It_allocates_nothing_in_flight) {
  Flight flight(everything(), 10);
  flight.ask(Action::kVelocity, {1.0, 0.5});
  testing::AllocationGuard guard;
  flight.run(5.0);
  flight.fleet.cut_link(DroneId(0), 0.5);
  flight.run(5.0);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::sim
