#include "vigil/core/dynamics/battery.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

TEST(Battery, Open_voltage_rises_with_the_charge_and_gives_it_back) {
  for (int i = 0; i < 1000; ++i) {
    const double charge = i / 1000.0;
    EXPECT_LT(open_cell_voltage(charge), open_cell_voltage(charge + 0.001));
    EXPECT_NEAR(charge_at(open_cell_voltage(charge)), charge, 1e-12);
  }
  EXPECT_EQ(open_cell_voltage(1.2), open_cell_voltage(1.0));
  EXPECT_EQ(charge_at(5.0), 1.0);
  EXPECT_EQ(charge_at(2.0), 0.0);
}

TEST(Battery, The_voltage_falls_with_the_load_and_with_the_charge) {
  const Battery battery = outdoor_battery();
  EXPECT_GT(voltage_under(battery, {0.8}, 5.0), voltage_under(battery, {0.8}, 15.0));
  EXPECT_GT(voltage_under(battery, {0.8}, 15.0), voltage_under(battery, {0.3}, 15.0));
  EXPECT_DOUBLE_EQ(voltage_under(battery, {1.0}, 0.0), 6 * 4.2);
}

TEST(Battery, The_current_delivers_the_power) {
  for (const Battery& battery : {crazyflie_battery(), outdoor_battery()})
    for (const double power : {0.0, 1.0, 5.0, 30.0}) {
      const double current = current_for(battery, {0.6}, power);
      EXPECT_NEAR(current * voltage_under(battery, {0.6}, current), power, 1e-9);
    }
}

TEST(Battery, Asked_for_too_much_it_gives_the_greatest_power) {
  const Battery battery = crazyflie_battery();
  const double v0 = open_cell_voltage(0.5);
  EXPECT_NEAR(current_for(battery, {0.5}, 1000.0), v0 / (2.0 * battery.resistance_ohm), 1e-9);
  EXPECT_FALSE(can_deliver(battery, {0.5}, 1000.0));
}

TEST(Battery, No_energy_is_lost_but_in_the_resistance) {
  // Integral of OCV dQ = integral of P dt + integral of R I^2 dt, over a flight of five minutes.
  const Battery battery{.cells = 1, .capacity_ah = 0.25, .health = 0.8, .resistance_ohm = 0.06};
  const double r = battery.resistance_ohm / battery.health;
  BatteryState state;
  double stored = 0.0;
  double delivered = 0.0;
  double heat = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const BatteryState next = after_power(battery, state, 7.0, 0.1);
    const double coulombs = (state.charge - next.charge) * 3600.0 * battery.capacity_ah * battery.health;
    stored += 0.5 * (open_cell_voltage(state.charge) + open_cell_voltage(next.charge)) * coulombs;
    heat += r * coulombs * coulombs / 0.1;
    delivered += 7.0 * 0.1;
    state = next;
  }
  EXPECT_GT(state.charge, 0.05);
  EXPECT_NEAR(stored, delivered + heat, 1e-5 * stored);
}

TEST(Battery, A_constant_current_empties_it_in_capacity_over_current) {
  const Battery battery = crazyflie_battery();
  EXPECT_NEAR(after_current(battery, {}, 2.0, 225.0).charge, 0.5, 1e-12);
  EXPECT_EQ(after_current(battery, {}, 2.0, 1000.0).charge, 0.0);
}

TEST(Battery, Power_drawn_in_many_steps_or_in_one_costs_the_same_charge) {
  const Battery battery = crazyflie_battery();
  BatteryState state;
  for (int i = 0; i < 10'000; ++i) state = after_power(battery, state, kCrazyflieHoverPower, 0.02);
  EXPECT_NEAR(state.charge, after_power(battery, {}, kCrazyflieHoverPower, 200.0).charge, 1e-6);
}

TEST(Battery, Hovering_lasts_as_long_as_it_does) {
  EXPECT_NEAR(endurance_s(crazyflie_battery(), kCrazyflieHoverPower), 7.0 * 60.0, 10.0);
  EXPECT_NEAR(endurance_s(outdoor_battery(), kOutdoorHoverPower), 20.0 * 60.0, 30.0);
}

TEST(Battery, Twice_the_capacity_lasts_twice_as_long) {
  Battery large = crazyflie_battery();
  large.capacity_ah *= 2.0;
  EXPECT_NEAR(endurance_s(large, kCrazyflieHoverPower), 2.0 * endurance_s(crazyflie_battery(), kCrazyflieHoverPower),
              2.0);
}

TEST(Battery, Age_shortens_the_flight_by_more_than_the_capacity_lost) {
  Battery old = outdoor_battery();
  old.health = 0.7;
  EXPECT_LT(endurance_s(old, kOutdoorHoverPower), 0.7 * endurance_s(outdoor_battery(), kOutdoorHoverPower));
}

}  // namespace
}  // namespace vigil::dynamics
