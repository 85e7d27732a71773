// Every mission of the project that flies by the program's own choices, over many seeds, judged by ground truth.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/apps/flight_for_tests.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {
namespace {

constexpr int kSeeds = 10;
constexpr int kSeedsOfAVehicle = 5;

runtime::FlightSummary fly(const std::string& name, std::vector<runtime::Override> overrides, int seed) {
  overrides.push_back({"simulation.seed", std::to_string(seed)});
  return apps::fly(runtime::load_mission(VIGIL_MISSIONS_DIR "/" + name + ".yaml", overrides));
}

void expect_safe(const std::string& name, const std::vector<runtime::Override>& overrides = {}) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(name + ", seed " + std::to_string(seed));
    const runtime::FlightSummary summary = fly(name, overrides, seed);
    EXPECT_EQ(summary.audit.separation_violations, 0U);
    EXPECT_EQ(summary.audit.wall_violations, 0U);
    EXPECT_EQ(summary.audit.no_fly_violations, 0U);
    EXPECT_EQ(summary.audit.speed_violations, 0U);
    EXPECT_EQ(summary.fallback_ticks, 0U);
  }
}

void expect_covered_and_apart(const std::string& vehicle, int drones) {
  for (int seed = 1; seed <= kSeedsOfAVehicle; ++seed) {
    SCOPED_TRACE(vehicle + ", seed " + std::to_string(seed));
    const runtime::FlightSummary summary =
        fly("vehicles/" + vehicle, {{"drone_grid.count", std::to_string(drones)}}, seed);
    EXPECT_TRUE(summary.complete);
    EXPECT_LT(summary.last_percent, drones < 10 ? 15.0 : 10.0);
    EXPECT_EQ(summary.audit.separation_violations, 0U);
    EXPECT_EQ(summary.audit.wall_violations, 0U);
    EXPECT_EQ(summary.audit.no_fly_violations, 0U);
    EXPECT_EQ(summary.audit.speed_violations, 0U);
  }
}

TEST(ShippedMissions, Crazyflies_keep_their_distances_over_a_lossy_link) {
  for (const int drones : {3, 10}) expect_covered_and_apart("crazyflie", drones);
}

TEST(ShippedMissions, Three_arducopters_keep_their_distances_over_a_lossy_link) {
  expect_covered_and_apart("arducopter", 3);
}

TEST(ShippedMissions, Px4_drones_keep_their_distances_over_a_lossy_link) {
  for (const int drones : {3, 10}) expect_covered_and_apart("px4", drones);
}

TEST(ShippedMissions, The_laboratory_is_safe_with_every_seed) { expect_safe("lab"); }

TEST(ShippedMissions, The_wildfire_watch_is_safe_with_every_seed) { expect_safe("wildfire"); }

TEST(ShippedMissions, The_crowd_is_safe_with_every_seed) { expect_safe("crowd"); }

TEST(ShippedMissions, Targets_in_a_corner_press_nobody_into_the_wall) {
  expect_safe("lab", {{"targets.clusters", "[{name: corner, points_m: [[-1.2, -1.2], [-1.25, -1.25]]}]"}});
}

TEST(ShippedMissions, Drones_that_are_lost_for_a_while_press_nobody_out_of_the_field) {
  expect_safe("lab", {{"simulation.tracker.dropouts_per_min", "6"}});
  expect_safe("lab", {{"simulation.events", "[{at_s: 20, do: lose_tracking, drone: cf1, for_s: 20}]"}});
}

TEST(ShippedMissions, A_drone_that_takes_off_again_comes_up_into_nobodys_way) {
  for (int at_s = 26; at_s <= 110; at_s += 6)
    expect_safe("lab", {{"simulation.events", "[{at_s: 23, do: land, drone: cf2}, {at_s: " + std::to_string(at_s) +
                                                  ", do: take_off, drone: cf2}]"}});
}

}  // namespace
}  // namespace vigil::apps
