#include "vigil/swarm/energy.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/battery.hpp"
#include "vigil/swarm/ideal_world_for_tests.hpp"

namespace vigil::swarm {
namespace {

constexpr double kStep = 0.05;
constexpr double kReserve = 0.2;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A battery that flying empties evenly, whose report wavers by up to 2 %.
struct Even {
  double rate_per_s;
  double charge = 1.0;
  double time_s = 0.0;
  EnergyEstimate estimate{};

  [[nodiscard]] double report() const { return charge + 0.02 * std::sin(2.0 * std::numbers::pi * time_s / 17.0); }
  void fly(double seconds) {
    for (double t = 0.0; t < seconds; t += kStep) {
      charge -= rate_per_s * kStep;
      time_s += kStep;
      estimate.update(report(), true, kStep);
    }
  }
};

TEST(Energy, Before_the_first_report_nothing_is_known) {
  EnergyEstimate estimate;
  estimate.update(kNaN, true, kStep);
  EXPECT_FALSE(estimate.is_known());
  EXPECT_FALSE(estimate.time_to(kReserve));
  estimate.update(0.7, true, kStep);
  EXPECT_TRUE(estimate.is_known());
  EXPECT_DOUBLE_EQ(estimate.charge(), 0.7);
}

TEST(Energy, The_rate_of_discharge_is_learned) {
  for (const double endurance_s : {300.0, 900.0, 2400.0}) {
    Even even{.rate_per_s = 1.0 / endurance_s};
    even.fly(0.4 * endurance_s);
    EXPECT_NEAR(even.estimate.rate_per_s() * endurance_s, 1.0, 0.15) << endurance_s;
    EXPECT_NEAR(even.estimate.charge(), 0.6, 0.03) << endurance_s;
  }
}

TEST(Energy, The_time_left_is_never_less_than_said_and_the_error_shrinks) {
  for (const double endurance_s : {300.0, 900.0, 2400.0}) {
    Even even{.rate_per_s = 1.0 / endurance_s};
    even.fly(5.0);
    const TimeLeft first = *even.estimate.time_to(kReserve);
    for (int k = 0; k < 70; ++k) {
      even.fly(0.01 * endurance_s);
      const double truth_s = (even.charge - kReserve) * endurance_s;
      EXPECT_LE(even.estimate.time_to(kReserve)->least_s, truth_s + 1e-9) << endurance_s << ", " << k;
    }
    const TimeLeft last = *even.estimate.time_to(kReserve);
    EXPECT_LT(last.s - last.least_s, 0.5 * first.s);
    EXPECT_NEAR(last.s, 0.1 * endurance_s, 0.05 * endurance_s);
  }
}

TEST(Energy, A_report_that_jumps_for_a_moment_changes_little) {
  Even even{.rate_per_s = 1.0 / 900.0};
  even.fly(200.0);
  const double before_s = even.estimate.time_to(kReserve)->s;
  for (int k = 0; k < 20; ++k) even.estimate.update(0.0, true, kStep);
  EXPECT_NEAR(even.estimate.time_to(kReserve)->s, before_s, 0.1 * before_s);
}

TEST(Energy, Another_battery_is_noticed_within_seconds) {
  Even even{.rate_per_s = 1.0 / 900.0};
  even.fly(600.0);
  for (double t = 0.0; t < 15.0; t += kStep) even.estimate.update(1.0, false, kStep);
  EXPECT_NEAR(even.estimate.charge(), 1.0, 0.02);
}

TEST(Energy, On_the_ground_nothing_is_learned_of_the_rate) {
  Even even{.rate_per_s = 1.0 / 900.0};
  even.fly(300.0);
  const double rate = even.estimate.rate_per_s();
  for (double t = 0.0; t < 300.0; t += kStep) even.estimate.update(std::min(1.0, 0.6 + 0.001 * t), false, kStep);
  EXPECT_DOUBLE_EQ(even.estimate.rate_per_s(), rate);
}

TEST(Energy, Without_reports_the_charge_is_counted_down_and_becomes_less_certain) {
  Even even{.rate_per_s = 1.0 / 900.0};
  even.fly(300.0);
  const TimeLeft before = *even.estimate.time_to(kReserve);
  for (double t = 0.0; t < 100.0; t += kStep) even.estimate.update(kNaN, true, kStep);
  const TimeLeft after = *even.estimate.time_to(kReserve);
  EXPECT_NEAR(after.s, before.s - 100.0, 2.0);
  EXPECT_GT(after.s - after.least_s, before.s - before.least_s);
}

TEST(Energy, Whatever_is_reported_it_stays_finite_and_within_its_bounds) {
  std::mt19937_64 random(3);
  EnergyEstimate estimate;
  const double odd[] = {kNaN, HUGE_VAL, -HUGE_VAL, 1e300, -1e300, 0.0, 1.0, 0.5};
  for (int k = 0; k < 100'000; ++k) {
    const double dt_s = random() % 3 == 0 ? 10.0 : 0.02;
    estimate.update(odd[random() % 8], random() % 2 == 0, dt_s);
    if (!estimate.is_known()) continue;
    const TimeLeft left = *estimate.time_to(kReserve);
    ASSERT_TRUE(std::isfinite(left.s) && left.least_s >= 0.0 && left.least_s <= left.s);
    ASSERT_TRUE(estimate.charge() >= 0.0 && estimate.charge() <= 1.0);
    ASSERT_TRUE(estimate.rate_per_s() >= EnergyEstimate::kSlowest && estimate.rate_per_s() <= EnergyEstimate::kFastest);
  }
}

/// Until the report is down at the reserve, as long as the drone hovers: what a vehicle tells that measures voltage and
/// current and takes its battery for a new one.
TEST(Energy, It_holds_for_batteries_of_either_kind_and_any_age) {
  for (const bool is_outdoor : {false, true})
    for (const double health : {1.0, 0.8, 0.6}) {
      dynamics::Battery battery = is_outdoor ? dynamics::outdoor_battery() : dynamics::crazyflie_battery();
      const double power_w = is_outdoor ? dynamics::kOutdoorHoverPower : dynamics::kCrazyflieHoverPower;
      battery.health = health;
      const auto report = [&](const dynamics::BatteryState& state) {
        const double current_a = dynamics::current_for(battery, state, power_w);
        const double volt = dynamics::voltage_under(battery, state, current_a);
        return dynamics::charge_at((volt + battery.resistance_ohm * current_a) / battery.cells);
      };
      double end_s = 0.0;
      for (dynamics::BatteryState state; report(state) > kReserve; end_s += kStep)
        state = dynamics::after_power(battery, state, power_w, kStep);
      EnergyEstimate estimate;
      dynamics::BatteryState state;
      for (double t = 0.0; t < end_s; t += kStep) {
        state = dynamics::after_power(battery, state, power_w, kStep);
        estimate.update(report(state), true, kStep);
        const TimeLeft left = *estimate.time_to(kReserve);
        ASSERT_LE(left.least_s, end_s - t) << is_outdoor << ", health " << health << ", after " << t << " s";
      }
      EXPECT_NEAR(estimate.time_to(kReserve)->s, 0.0, 0.1 * end_s);
    }
}

TEST(Energy, The_snapshot_tells_how_long_a_drone_still_flies_until_it_lands) {
  IdealWorld world(laboratory(2), {{0.5, 0.5}, {2.5, 2.5}});
  world.observations[0].battery = 0.9;
  double low_s = 0.0;
  double told_s = 0.0;
  for (; world.activity(0) != Activity::kBatteryLow; low_s += 0.02) {
    world.step();
    world.observations[0].battery -= 0.02 / 300.0;
    ASSERT_TRUE(world.snapshot.drones[0].time_left);
    ASSERT_FALSE(world.snapshot.drones[1].time_left);
    if (low_s < 150.0) told_s = low_s + world.snapshot.drones[0].time_left->s;
  }
  EXPECT_NEAR(low_s, 0.7 * 300.0, 0.1);
  EXPECT_NEAR(told_s, low_s, 0.1 * low_s);
}

}  // namespace
}  // namespace vigil::swarm
