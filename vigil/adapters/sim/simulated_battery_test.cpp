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
  EXPECT_DOUBLE_EQ(battery.charge(), 1.0);
}

TEST(SimulatedBattery, A_new_one_is_reported_as_full_as_it_is) {
  SimulatedBattery battery(crazyflie());
  for (int i = 0; i < 300; ++i) {
    battery.advance(true, 1.0);
    EXPECT_NEAR(battery.reported(), battery.charge(), 1e-9);
  }
}

TEST(SimulatedBattery, An_old_one_is_reported_emptier_than_it_is_while_it_is_under_load) {
  BatteryParameters old = crazyflie();
  old.battery.health = 0.6;
  SimulatedBattery battery(old);
  for (int i = 0; i < 60; ++i) battery.advance(true, 1.0);
  EXPECT_LT(battery.reported(), battery.charge() - 0.05);
  battery.advance(false, 1.0);
  EXPECT_NEAR(battery.reported(), battery.charge(), 1e-9);
}

}  // namespace
}  // namespace vigil::sim
