#include "vigil/swarm/recharging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::swarm {
namespace {

constexpr double kTick = 0.1;
constexpr double kEnduranceS = 200.0;
constexpr double kFullInS = 40.0;
constexpr double kReserve = 0.2;

SwarmParameters with_stations(std::size_t drones, const std::vector<Vec2>& pads) {
  SwarmParameters parameters = laboratory(drones);
  parameters.field = {6.0, 6.0};
  parameters.dt_s = kTick;
  parameters.barrier.dt_s = kTick;
  parameters.health.battery_reserve = kReserve;
  for (std::size_t n = 0; n < pads.size(); ++n)
    parameters.recharge.pads.push_back({.place = pads[n], .station = n, .full_in_s = kFullInS, .radius_m = 0.1});
  parameters.recharge.take_off_s = 2.0;
  parameters.recharge.landing_s = 2.0;
  parameters.recharge.endurance_s = kEnduranceS;
  return parameters;
}

/// Ideal drones with batteries, and stations that charge them.
class BatteryWorld {
 public:
  BatteryWorld(const SwarmParameters& parameters, const std::vector<Vec2>& starts)
      : state(parameters), snapshot(parameters.drones), charges(parameters.recharge.pads.size(), true) {
    auto target = std::make_shared<CoverageTarget>();
    target->phi_k = ergodic::Coefficients::Zero(state.basis().indices_per_axis(), state.basis().indices_per_axis());
    target->phi_k(0, 0) = 1.0;
    target->phi_k(1, 1) = 0.3;
    target->has_targets = true;
    first_commands.push_back({.kind = CommandKind::kSetTarget, .drone = {}, .target = target});
    for (const Vec2& start : starts) {
      drones.push_back(flying_at(start));
      drones.back().battery = 1.0;
    }
  }

  void step(std::vector<Command> commands = {}) {
    commands.insert(commands.begin(), first_commands.begin(), first_commands.end());
    first_commands.clear();
    tick(state, drones, commands, snapshot);
    for (std::size_t i = 0; i < drones.size(); ++i) live(i);
    std::size_t away = 0;
    for (const DroneSnapshot& drone : snapshot.drones) away += drone.pad >= 0 && drone.activity != Activity::kActive;
    most_away = std::max(most_away, away);
    for (const Event& event : snapshot.events)
      if (event.kind == EventKind::kStationFailed || event.kind == EventKind::kStationWorks) events.push_back(event);
  }
  void run(double seconds) {
    for (double t = 0.0; t < seconds; t += kTick) step();
  }
  /// Until the drone does it; false where it does not within so long.
  bool run_until(std::size_t drone, Activity activity, double at_most_s) {
    for (double t = 0.0; t < at_most_s; t += kTick) {
      step();
      if (this->activity(drone) == activity) return true;
    }
    return false;
  }
  [[nodiscard]] Activity activity(std::size_t drone) const { return snapshot.drones[drone].activity; }

  SwarmState state;
  Snapshot snapshot;
  std::vector<bool> charges;  ///< of each pad
  std::vector<DroneObservation> drones;
  std::vector<Command> first_commands;
  std::vector<Event> events;
  std::size_t most_away = 0;
  std::size_t ran_empty = 0;
  double drain = 1.0;            ///< times as fast as they should
  Vec2 blown_to = Vec2::Zero();  ///< beside where it landed

 private:
  void live(std::size_t i) {
    DroneObservation& drone = drones[i];
    const DroneOrder& order = snapshot.drones[i].order;
    drone.velocity = order.velocity;
    drone.position += order.velocity * kTick;
    const bool is_down = drone.mode == VehicleMode::kGrounded;
    if (order.action == Action::kTakeOff && is_down) drone.mode = VehicleMode::kTakingOff;
    if (order.action == Action::kLand && drone.mode == VehicleMode::kFlying) drone.mode = VehicleMode::kLanding;
    if (drone.mode == VehicleMode::kTakingOff) drone.height_m += 0.5 * kTick;
    if (drone.mode == VehicleMode::kLanding) drone.height_m -= 0.5 * kTick;
    if (drone.mode == VehicleMode::kTakingOff && drone.height_m >= 1.0) drone.mode = VehicleMode::kFlying;
    if (drone.mode == VehicleMode::kLanding && drone.height_m <= 0.0) {
      drone.mode = VehicleMode::kGrounded;
      drone.height_m = 0.0;
      drone.position += blown_to;
    }
    if (!is_down) drone.battery -= drain * kTick / kEnduranceS;
    ran_empty += drone.battery <= 0.0;
    const std::vector<ChargingPad>& pads = state.parameters().recharge.pads;
    for (std::size_t pad = 0; pad < pads.size(); ++pad)
      if (is_down && charges[pad] && (drone.position - pads[pad].place).norm() <= pads[pad].radius_m)
        drone.battery = std::min(1.0, drone.battery + kTick / pads[pad].full_in_s);
  }
};

const Vec2 kWest(0.6, 3.0);
const Vec2 kEast(5.4, 3.0);

TEST(Recharging, A_drone_is_charged_in_time_and_covers_again) {
  BatteryWorld world(with_stations(1, {kWest}), {{3.0, 3.0}});
  ASSERT_TRUE(world.run_until(0, Activity::kReturning, kEnduranceS));
  ASSERT_TRUE(world.run_until(0, Activity::kCharging, 60.0));
  EXPECT_GT(world.drones[0].battery, kReserve);
  ASSERT_TRUE(world.run_until(0, Activity::kActive, 60.0));
  EXPECT_GT(world.drones[0].battery, 0.9);
  world.run(3600.0);
  EXPECT_EQ(world.ran_empty, 0U);
}

TEST(Recharging, It_leaves_as_late_as_its_battery_allows) {
  BatteryWorld world(with_stations(1, {kWest}), {{3.0, 3.0}});
  world.run(1000.0);  // until its battery is known
  ASSERT_TRUE(world.run_until(0, Activity::kCharging, 300.0));
  ASSERT_TRUE(world.run_until(0, Activity::kActive, 300.0));
  ASSERT_TRUE(world.run_until(0, Activity::kCharging, 300.0));
  EXPECT_LT(world.drones[0].battery, kReserve + 0.25);
}

TEST(Recharging, A_battery_that_is_emptied_half_again_as_fast_is_charged_in_time) {
  BatteryWorld world(with_stations(3, {kWest, kEast}), {{2.0, 3.0}, {3.0, 3.0}, {4.0, 3.0}});
  world.drain = 1.5;
  world.run(3600.0);
  EXPECT_EQ(world.ran_empty, 0U);
  for (const DroneObservation& drone : world.drones) EXPECT_GT(drone.battery, 0.5 * kReserve);
}

TEST(Recharging, No_more_are_away_at_a_time_than_the_energy_demands_and_one) {
  const std::vector<Vec2> pads{{0.6, 2.0}, {0.6, 4.0}, {5.4, 2.0}, {5.4, 4.0}};
  BatteryWorld world(with_stations(6, pads), {{2, 2}, {3, 2}, {4, 2}, {2, 4}, {3, 4}, {4, 4}});
  world.run(3600.0);
  EXPECT_EQ(world.ran_empty, 0U);
  // Away: some 20 s of way, 31 s of charge, 5 s up and down; covering: some 140 s.
  EXPECT_LE(world.most_away, 3U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NE(world.activity(i), Activity::kGrounded);
}

TEST(Recharging, A_station_that_does_not_charge_is_noticed_and_its_drone_flies_to_another) {
  BatteryWorld world(with_stations(1, {kWest, kEast}), {{2.0, 3.0}});
  world.charges[0] = false;
  ASSERT_TRUE(world.run_until(0, Activity::kCharging, 2.0 * kEnduranceS));
  world.run(300.0);
  ASSERT_EQ(world.events.size(), 1U);
  EXPECT_EQ(world.events[0].kind, EventKind::kStationFailed);
  EXPECT_EQ(world.events[0].station, 0U);
  world.run(1800.0);
  EXPECT_EQ(world.ran_empty, 0U);
  EXPECT_EQ(world.events.size(), 1U);
  EXPECT_GT(world.drones[0].battery, kReserve);
}

TEST(Recharging, Where_no_station_charges_a_drone_stays_down_until_one_does) {
  BatteryWorld world(with_stations(1, {kWest}), {{2.0, 3.0}});
  world.charges[0] = false;
  world.run(2.0 * kEnduranceS);
  EXPECT_EQ(world.activity(0), Activity::kGrounded);
  EXPECT_EQ(world.ran_empty, 0U);
  world.charges[0] = true;
  ASSERT_TRUE(world.run_until(0, Activity::kActive, 120.0));
  ASSERT_EQ(world.events.size(), 2U);
  EXPECT_EQ(world.events[1].kind, EventKind::kStationWorks);
}

TEST(Recharging, Who_comes_down_beside_its_pad_tries_again) {
  BatteryWorld world(with_stations(1, {kWest}), {{2.0, 3.0}});
  world.blown_to = Vec2(0.3, 0.0);
  ASSERT_TRUE(world.run_until(0, Activity::kLanding, 2.0 * kEnduranceS));
  ASSERT_TRUE(world.run_until(0, Activity::kTakingOff, 30.0));
  world.blown_to.setZero();
  ASSERT_TRUE(world.run_until(0, Activity::kActive, 120.0));
  EXPECT_GT(world.drones[0].battery, 0.9);
}

TEST(Recharging, An_operator_keeps_a_drone_on_its_pad_by_landing_it) {
  BatteryWorld world(with_stations(1, {kWest}), {{2.0, 3.0}});
  ASSERT_TRUE(world.run_until(0, Activity::kCharging, 2.0 * kEnduranceS));
  world.step({wish(CommandKind::kLand, 0)});
  world.run(300.0);
  EXPECT_EQ(world.activity(0), Activity::kGrounded);
  world.step({wish(CommandKind::kTakeOff, 0)});
  EXPECT_TRUE(world.run_until(0, Activity::kActive, 20.0));
}

TEST(Recharging, A_held_drone_goes_when_its_battery_demands_it) {
  BatteryWorld world(with_stations(1, {kWest}), {{2.0, 3.0}});
  world.step({wish(CommandKind::kHold, 0)});
  ASSERT_TRUE(world.run_until(0, Activity::kReturning, kEnduranceS));
  EXPECT_LT(world.drones[0].battery, kReserve + 0.35);
  EXPECT_TRUE(world.run_until(0, Activity::kCharging, 60.0));
}

TEST(Recharging, Who_says_nothing_of_its_battery_is_never_sent) {
  BatteryWorld world(with_stations(1, {kWest}), {{2.0, 3.0}});
  for (double t = 0.0; t < 300.0; t += kTick) {
    world.drones[0].battery = std::numeric_limits<double>::quiet_NaN();
    world.step();
    ASSERT_EQ(world.activity(0), Activity::kActive);
  }
}

TEST(Recharging, It_allocates_nothing) {
  BatteryWorld world(with_stations(3, {kWest, kEast}), {{2.0, 3.0}, {3.0, 3.0}, {4.0, 3.0}});
  world.step();
  std::vector<Command> none;
  for (double t = 0.0; t < 400.0; t += kTick) {
    {
      const testing::AllocationGuard guard;
      tick(world.state, world.drones, none, world.snapshot);
      ASSERT_EQ(guard.allocations(), 0U);
    }
    world.step();
  }
}

}  // namespace
}  // namespace vigil::swarm
