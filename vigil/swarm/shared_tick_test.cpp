#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::swarm {
namespace {

/// Many drones close to each other, in no order, that cover by the gradient and lag behind what they are told; a few of
/// each kind of trouble among them.
IdealWorld throng(std::size_t drones) {
  SwarmParameters parameters = laboratory(drones);
  const double columns = std::ceil(std::sqrt(static_cast<double>(drones)));
  parameters.field = {0.3 * columns + 0.6, 0.3 * columns + 0.6};
  parameters.controller = ergodic::ControllerKind::kGradient;
  parameters.barrier.lag_s = 0.1;
  parameters.barrier.pair_gain = 1.2;
  std::vector<std::size_t> order(drones);
  for (std::size_t i = 0; i < drones; ++i) order[i] = i;
  std::mt19937_64 random(3);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Vec2> starts;
  for (const std::size_t place : order)
    starts.emplace_back(0.45 + 0.3 * std::fmod(static_cast<double>(place), columns),
                        0.45 + 0.3 * std::floor(static_cast<double>(place) / columns));
  IdealWorld world(parameters, starts);
  for (std::size_t i = 0; i < drones; i += 97) world.observations[i].mode = VehicleMode::kFailed;
  for (std::size_t i = 5; i < drones; i += 89) world.land(i);
  for (std::size_t i = 9; i < drones; i += 83) world.observations[i].age_s = 0.3;
  return world;
}

std::vector<Command> begin_to_cover(const IdealWorld& world) {
  auto target = std::make_shared<CoverageTarget>();
  target->has_targets = true;
  target->phi_k = 0.1 * world.state.basis().norm().cwiseInverse();
  return {{.kind = CommandKind::kSetTarget, .drone = {}, .target = target}};
}

void step(IdealWorld& world, const std::vector<Command>& commands, parallel::Workers* workers) {
  tick(world.state, world.observations, commands, world.snapshot, workers);
  for (std::size_t i = 0; i < world.observations.size(); ++i) {
    world.observations[i].velocity = world.snapshot.drones[i].order.velocity;
    world.observations[i].position += world.snapshot.drones[i].order.velocity * kDt;
  }
}

void expect_same_bits(const DroneSnapshot& a, const DroneSnapshot& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.activity, b.activity);
  EXPECT_EQ(a.is_obstacle, b.is_obstacle);
  EXPECT_EQ(a.u_nom, b.u_nom);
  EXPECT_EQ(a.order.action, b.order.action);
  EXPECT_EQ(a.order.velocity, b.order.velocity);
  EXPECT_EQ(a.filter.holding_count, b.filter.holding_count);
  for (std::size_t i = 0; i < a.filter.holding.size(); ++i) {
    EXPECT_EQ(a.filter.holding[i].kind, b.filter.holding[i].kind);
    EXPECT_EQ(a.filter.holding[i].index, b.filter.holding[i].index);
    EXPECT_EQ(a.filter.holding[i].distance_m, b.filter.holding[i].distance_m);
  }
  EXPECT_EQ(a.filter.speed_limited, b.filter.speed_limited);
  EXPECT_EQ(a.filter.margin_used, b.filter.margin_used);
  EXPECT_EQ(a.filter.fallback, b.filter.fallback);
  EXPECT_EQ(a.filter.violation_m_s, b.filter.violation_m_s);
  EXPECT_EQ(a.filter.correction_m_s, b.filter.correction_m_s);
  EXPECT_EQ(a.filter.nearest, b.filter.nearest);
  EXPECT_EQ(a.filter.nearest_distance_m, b.filter.nearest_distance_m);
}

void expect_same_bits(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.metric, b.metric);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.fallback, b.fallback);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].drone, b.events[i].drone);
    EXPECT_EQ(a.events[i].after, b.events[i].after);
  }
  for (std::size_t i = 0; i < a.drones.size(); ++i) expect_same_bits(a.drones[i], b.drones[i]);
}

/// Flies the same swarm alone and with 1, 2 and 3 threads.
void fly_with_several_threads(std::size_t drones, int ticks) {
  IdealWorld alone = throng(drones);
  std::array<IdealWorld, 3> shared{throng(drones), throng(drones), throng(drones)};
  const std::array<std::unique_ptr<parallel::Workers>, 3> workers{std::make_unique<parallel::Workers>(1),
                                                                  std::make_unique<parallel::Workers>(2),
                                                                  std::make_unique<parallel::Workers>(3)};
  for (int i = 0; i < ticks; ++i) {
    std::vector<Command> commands;
    if (i == 0) commands = begin_to_cover(alone);
    if (i == ticks / 2) commands = {wish(CommandKind::kTakeOff, 5), wish(CommandKind::kHold, 6)};
    step(alone, commands, nullptr);
    for (std::size_t k = 0; k < shared.size(); ++k) {
      step(shared[k], commands, workers[k].get());
      expect_same_bits(alone.snapshot, shared[k].snapshot);
    }
    ASSERT_FALSE(::testing::Test::HasFailure()) << "tick " << i;
  }
  EXPECT_GT(alone.snapshot.active, drones / 2);
}

TEST(SharedTick, Any_number_of_threads_gives_the_same_bits) { fly_with_several_threads(1'300, 20); }

TEST(SharedTick, With_workers_it_allocates_nothing_either) {
  IdealWorld world = throng(1'300);
  parallel::Workers workers(2);
  step(world, begin_to_cover(world), &workers);
  testing::AllocationGuard guard;
  for (int i = 0; i < 10; ++i) step(world, {}, &workers);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(SharedTick, A_swarm_that_takes_off_at_once_waits_for_whoever_is_in_the_way) {
  IdealWorld world = throng(600);
  for (std::size_t i = 0; i < world.observations.size(); ++i) world.land(i);
  world.observations[0] = flying_at(world.observations[1].position);
  step(world, {}, nullptr);
  step(world, {{.kind = CommandKind::kTakeOff, .drone = {}, .target = {}}}, nullptr);
  EXPECT_EQ(world.snapshot.drones[1].order.action, Action::kNone);
  for (int i = 0; i < 50; ++i) step(world, {}, nullptr);  // until it has been announced for long enough
  std::size_t taking_off = 0;
  for (const DroneSnapshot& drone : world.snapshot.drones) taking_off += drone.order.action == Action::kTakeOff;
  EXPECT_GT(taking_off, 550U);
}

}  // namespace
}  // namespace vigil::swarm
