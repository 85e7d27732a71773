// What faults do to the orders of a whole swarm.
#include <cmath>

#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::swarm {
namespace {

SwarmParameters watched(std::size_t drones) {
  SwarmParameters parameters = laboratory(drones);
  dynamics::FaultProblem problem;
  problem.u_max_m_s = parameters.barrier.u_max_m_s;
  problem.noise_m = 0.001;
  parameters.faults.watches = true;
  parameters.faults.bounds = dynamics::fault_bounds(problem);
  parameters.faults.bounds.never_repeats = false;  // here the noise is imagined
  return parameters;
}

/// Two drones on their way to places across each other's.
IdealWorld crossing_world() {
  IdealWorld world(watched(3), {{0.5, 0.5}, {2.5, 0.7}, {1.5, 2.5}});
  world.step();
  Command first = wish(CommandKind::kGoTo, 0);
  first.place = {2.4, 1.5};
  Command second = wish(CommandKind::kGoTo, 1);
  second.place = {0.6, 1.5};
  world.step({first, second});
  world.run(1.0);
  return world;
}

/// One tick of which the controller is told `told`, while the world goes on as it is.
void step_told(IdealWorld& world, const std::vector<DroneObservation>& told) {
  const std::vector<DroneObservation> real = world.observations;
  world.observations = told;
  tick(world.state, world.observations, {}, world.snapshot);
  world.observations = real;
  for (std::size_t i = 0; i < real.size(); ++i)
    world.observations[i].position += world.snapshot.drones[i].order.velocity * kDt;
}

template <class Spoil>
void expect_no_sudden_order(const Spoil& spoil, Fault fault) {
  IdealWorld sound = crossing_world();
  IdealWorld spoilt = crossing_world();
  while (spoilt.snapshot.drones[0].fault.kind == Fault::kNone && spoilt.state.ticks() < 200) {
    std::vector<DroneObservation> told = spoilt.observations;
    spoil(told);
    step_told(spoilt, told);
    sound.step();
    if (spoilt.snapshot.drones[0].fault.kind != Fault::kNone) break;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LE((spoilt.snapshot.drones[i].order.velocity - sound.snapshot.drones[i].order.velocity).norm(), 1e-9);
  }
  EXPECT_EQ(spoilt.snapshot.drones[0].fault.kind, fault);
  EXPECT_EQ(spoilt.activity(0), Activity::kTrackingLost);
  EXPECT_EQ(spoilt.snapshot.drones[0].order.velocity, Vec2(0.0, 0.0));
}

TEST(FaultFlight, Until_a_jump_is_named_every_order_is_what_it_would_have_been_and_then_the_drone_hovers) {
  expect_no_sudden_order([](auto& told) { told[0].position += Vec2(0.5, 0.9); }, Fault::kJumped);
}

TEST(FaultFlight, Until_a_swap_is_named_every_order_is_what_it_would_have_been_and_then_the_drones_hover) {
  expect_no_sudden_order([](auto& told) { std::swap(told[0].position, told[1].position); }, Fault::kSwapped);
}

TEST(FaultFlight, A_drone_whose_names_are_right_again_recovers_before_it_goes_on) {
  IdealWorld world = crossing_world();
  for (int i = 0; i < 20; ++i) {
    std::vector<DroneObservation> told = world.observations;
    std::swap(told[0].position, told[1].position);
    step_told(world, told);
  }
  ASSERT_EQ(world.activity(0), Activity::kTrackingLost);
  world.step();
  EXPECT_EQ(world.activity(0), Activity::kRecovering);
  world.run(1.0);
  EXPECT_EQ(world.activity(0), Activity::kTravelling);
}

TEST(FaultFlight, A_swap_is_not_believed_of_a_drone_that_is_not_heard_either) {
  IdealWorld world = crossing_world();
  for (int i = 0; i < 60; ++i) {
    std::vector<DroneObservation> told = world.observations;
    std::swap(told[0].position, told[1].position);
    if (i > 5 && i < 40) told[0].link_age_s = 2.0;
    step_told(world, told);
    for (const std::size_t drone : {0U, 1U}) {
      const Vec2& real = world.observations[drone].position;
      ASSERT_LE((world.snapshot.drones[drone].position - real).norm(), 0.1) << "drone " << drone << ", tick " << i;
    }
  }
  world.run(0.1);
  EXPECT_EQ(world.activity(0), Activity::kRecovering);
  EXPECT_LE((world.snapshot.drones[0].position - world.observations[0].position).norm(), 0.01);
}

TEST(FaultFlight, Of_a_drone_that_nobody_steers_a_place_is_believed_once_it_can_have_flown_there) {
  IdealWorld world = crossing_world();
  std::vector<DroneObservation> told = world.observations;
  told[0].link_age_s = 60.0;
  step_told(world, told);
  told[0].position += Vec2(0.0, 1.0);
  int ticks = 0;
  for (; ticks < 500; ++ticks) {
    step_told(world, told);
    if (world.snapshot.drones[0].position == told[0].position) break;
  }
  EXPECT_GT(ticks * kDt, 1.0);  // its kind flies 0.6 m/s at most
  EXPECT_LT(ticks * kDt, 2.0);
}

/// What was believed of a drone was wrong, and where it cannot be is where it is: the others must not fly through it.
TEST(FaultFlight, Others_keep_clear_of_where_a_doubted_drone_is_seen) {
  IdealWorld world(watched(2), {{0.5, 2.5}, {0.6, 0.7}});
  world.run(0.2);
  Command go = wish(CommandKind::kGoTo, 1);
  go.place = {2.4, 0.7};
  world.step({go});
  const Vec2 seen(1.5, 0.72);
  double least = HUGE_VAL;
  for (int i = 0; i < 1000; ++i) {
    std::vector<DroneObservation> told = world.observations;
    told[0].position = seen;
    step_told(world, told);
    world.observations[0].position = {0.5, 2.5};
    least = std::min(least, (world.observations[1].position - seen).norm());
    for (const safety::HoldingRow& row : world.snapshot.drones[1].filter.holding)
      ASSERT_TRUE(row.kind != safety::RowKind::kNeighbour || row.index < 2);
    if (world.snapshot.drones[0].fault.kind == Fault::kNone && i > 10) break;
  }
  EXPECT_GE(least, 0.2);
  EXPECT_LT(least, 0.5);  // it came by
}

TEST(FaultFlight, A_fault_is_one_event_that_names_it) {
  IdealWorld world = crossing_world();
  std::size_t events = 0;
  for (int i = 0; i < 50; ++i) {
    std::vector<DroneObservation> told = world.observations;
    told[0].position += Vec2(0.0, 1.0);
    step_told(world, told);
    for (const Event& event : world.snapshot.events) {
      ++events;
      EXPECT_EQ(event.kind, EventKind::kActivityChanged);
      EXPECT_EQ(event.fault, Fault::kJumped);
      EXPECT_EQ(event.after, Activity::kTrackingLost);
    }
  }
  EXPECT_EQ(events, 1U);
}

TEST(FaultFlight, A_drone_that_does_not_follow_stays_an_obstacle_that_may_come_closer) {
  IdealWorld world = crossing_world();
  for (int i = 0; i < 400 && world.activity(0) != Activity::kNotFollowing; ++i) {
    const Vec2 before = world.observations[0].position;
    world.step();
    world.observations[0].position = before + Vec2(0.0, 0.2) * kDt;
    world.observations[0].velocity = {0.0, 0.2};
  }
  ASSERT_EQ(world.activity(0), Activity::kNotFollowing);
  EXPECT_TRUE(world.snapshot.drones[0].is_obstacle);
  EXPECT_EQ(world.snapshot.drones[0].order.action, Action::kVelocity);
  EXPECT_EQ(world.snapshot.drones[0].order.velocity, Vec2(0.0, 0.0));
}

/// The least distance between a pilot's drone that crosses the whole field, at so much of u_max, and one that holds its
/// place, so much beside its way.
double least_beside_a_pilot(double speed, double beside_m) {
  IdealWorld world(watched(2), {{0.3, 1.5}, {1.8, 1.5 + beside_m}});
  world.step({wish(CommandKind::kHold, 1)});
  const Vec2 velocity(speed * laboratory(2).barrier.u_max_m_s, 0.0);
  double least = HUGE_VAL;
  while (world.observations[0].position.x() < 2.8 && world.state.ticks() < 1000) {
    const Vec2 place = world.observations[0].position + kDt * velocity;
    world.step();
    world.observations[0].position = place;
    world.observations[0].velocity = velocity;
    world.observations[0].mode = VehicleMode::kManual;
    least = std::min(least, (world.observations[1].position - place).norm());
  }
  return least;
}

TEST(FaultFlight, Who_is_in_the_way_of_a_drone_that_nobody_steers_lets_it_pass_and_is_not_driven_into_a_wall) {
  for (const double speed : {0.5, 1.0, 1.5, 2.0}) {
    EXPECT_GE(least_beside_a_pilot(speed, 0.0), 0.2) << speed;
    EXPECT_GE(least_beside_a_pilot(speed, 0.1), 0.2) << speed;
    EXPECT_GE(least_beside_a_pilot(speed, -0.15), 0.2) << speed;
  }
}

TEST(FaultFlight, Watching_allocates_nothing) {
  IdealWorld world = crossing_world();
  std::vector<DroneObservation> told = world.observations;
  testing::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    tick(world.state, told, {}, world.snapshot);
    std::swap(told[0].position, told[1].position);
  }
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(FaultFlight, A_model_of_the_flight_believes_what_it_is_told) {
  IdealWorld world = crossing_world();
  world.state.become_model(0.1);
  std::vector<DroneObservation> told = world.observations;
  told[0].position += Vec2(0.0, 1.0);
  tick(world.state, told, {}, world.snapshot);
  EXPECT_EQ(world.snapshot.drones[0].position, told[0].position);
}

}  // namespace
}  // namespace vigil::swarm
