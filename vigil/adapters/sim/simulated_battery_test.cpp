#include "vigil/adapters/sim/simulated_battery.hpp"

#include <gtest/gtest.h>

namespace vigil::sim {
namespace {

BatteryParameters crazyflie() {
  return {.battery = dynamics::crazyflie_battery(), .hover_power_w = dynamics::kCrazyflieHoverPower};
}

TEST(SimulatedBattery, It_lasts_in_the_air_as_long_as_core_says) {
  SimulatedBattery battery(crazyflie());
  double flown_s = 0.0;
  for (; !battery.is_empty(); flown_s += 0.02) battery.advance(true, 0.02);
  EXPECT_NEAR(flown_s, dynamics::endurance_s(dynamics::crazyflie_battery(), dynamics::kCrazyflieHoverPower), 1.5);
}

TEST(SimulatedBattery, On_the_ground_it_keeps_its_charge) {
  SimulatedBattery battery(crazyflie());
  for (int i = 0; i < 1000; ++i) battery.advance(false, 1.0);
  EXPECT_DOUBLE_EQ(battery.state_of_charge(), 1.0);
}

TEST(SimulatedBattery, A_new_one_is_reported_as_full_as_it_is) {
  SimulatedBattery battery(crazyflie());
  for (int i = 0; i < 300; ++i) {
    battery.advance(true, 1.0);
    EXPECT_NEAR(battery.reported(), battery.state_of_charge(), 1e-9);
  }
}

TEST(SimulatedBattery, An_old_one_is_reported_emptier_than_it_is_while_it_is_under_load) {
  BatteryParameters old = crazyflie();
  old.battery.health = 0.6;
  SimulatedBattery battery(old);
  for (int i = 0; i < 60; ++i) battery.advance(true, 1.0);
  EXPECT_LT(battery.reported(), battery.state_of_charge() - 0.05);
  battery.advance(false, 1.0);
  EXPECT_NEAR(battery.reported(), battery.state_of_charge(), 1e-9);
}

TEST(SimulatedBattery, What_is_charged_into_it_is_there_up_to_what_it_can_hold) {
  BatteryParameters half = crazyflie();
  half.start = 0.5;
  SimulatedBattery battery(half);
  battery.charge(0.2);
  EXPECT_DOUBLE_EQ(battery.state_of_charge(), 0.7);
  battery.charge(0.5);
  EXPECT_DOUBLE_EQ(battery.state_of_charge(), 1.0);
}

}  // namespace
}  // namespace vigil::sim
