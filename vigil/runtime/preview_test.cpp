#include "vigil/runtime/preview.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/virtual_flight.hpp"
#include "vigil/runtime/what_if.hpp"

namespace vigil::runtime {
namespace {

constexpr const char* kMore = "sensor: {footprint_radius_m: 0.25}\nsimulation: {duration_s: 200}\n";

/// A flight of drones that do at once what they are told, and looks ahead from where it is.
class PreviewTest : public ::testing::Test {
 protected:
  PreviewTest() {
    watch.retarget(mission, flight.state().basis(), *coverage_target(mission, flight.state().basis()), 0.0);
    fly_until(5.0);
  }

  void fly_until(double time_s) {
    while (static_cast<double>(flight.ticks_flown()) * tick_s(mission) < time_s) {
      flight.step();
      std::vector<Vec2> places;
      for (const swarm::DroneSnapshot& drone : flight.snapshot().drones)
        if (drone.activity == swarm::Activity::kActive) places.push_back(drone.position);
      (void)watch.see(places, footprint_radius_m(mission), flight.snapshot().time_s);
    }
  }

  PreviewStart start() const {
    return {flight.state(), watch, predicted_vehicle(mission, flight.state().parameters().barrier.lag_s),
            footprint_radius_m(mission)};
  }
  Outlook future(const PreviewChange& change = {}, double seconds = 60.0) const {
    return look_into_future(start(), change, seconds, never).value();
  }
  static const AreaOutlook& area(const Outlook& outlook, const std::string& name) {
    return *std::find_if(outlook.areas.begin(), outlook.areas.end(),
                         [&](const AreaOutlook& one) { return one.what.name == name; });
  }
  static Vec2 ghost(const Outlook& outlook, std::size_t drone, std::size_t point) {
    return outlook.ghosts.at(drone * outlook.ghost_points + point);
  }

  Mission mission = small_mission(kMore);
  ObedientFleet fleet{starts_in_field(mission)};
  VirtualFlight flight{mission, fleet, nullptr, [] { return std::chrono::nanoseconds{}; }};
  AreaWatch watch;
  std::atomic<bool> never{false};
};

TEST_F(PreviewTest, The_next_seconds_of_obedient_drones_are_what_then_happens) {
  const Outlook outlook = future();
  const double least_step_m = mission.control.speed_limit_m_s * outlook.tick_s;
  fly_until(6.0);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((ghost(outlook, i, 1) - flight.snapshot().drones[i].position).norm(), 2.0 * least_step_m);
  fly_until(65.0);
  EXPECT_NEAR(outlook.samples.back().metric_percent, flight.snapshot().metric_percent, 1.0);
}

TEST_F(PreviewTest, Looking_ahead_changes_nothing_and_gives_the_same_twice) {
  const PreviewStart before = start();
  const Outlook first = future();
  EXPECT_EQ(flight.state().ticks(), before.state.ticks());
  const Outlook second = look_into_future(before, {}, 60.0, never).value();
  EXPECT_EQ(first.samples.back().metric, second.samples.back().metric);
  EXPECT_EQ(first.ghosts, second.ghosts);
}

TEST_F(PreviewTest, The_samples_go_from_now_to_the_end_second_by_second) {
  const Outlook outlook = future({}, 12.0);
  ASSERT_EQ(outlook.samples.size(), 13U);
  EXPECT_EQ(outlook.seconds, 12.0);
  for (std::size_t n = 0; n < outlook.samples.size(); ++n)
    EXPECT_NEAR(outlook.samples[n].in_s, static_cast<double>(n), 1e-9);
  EXPECT_NEAR(outlook.samples.front().metric_percent, flight.snapshot().metric_percent, 0.5);
}

TEST_F(PreviewTest, Every_second_has_its_sample_whatever_the_tick) {
  mission.control.rate_hz = 3.0;  // a tick of a third of a second
  ObedientFleet slow_fleet(starts_in_field(mission));
  VirtualFlight slow(mission, slow_fleet, nullptr, [] { return std::chrono::nanoseconds{}; });
  slow.step();
  const PreviewStart from{slow.state(), watch, predicted_vehicle(mission, 0.0), 0.3};
  const Outlook outlook = look_into_future(from, {}, 7.5, never).value();
  ASSERT_EQ(outlook.samples.size(), 9U);  // of 0, 1, ..., 7 s, and of the end
  for (std::size_t n = 0; n < 8; ++n) {
    EXPECT_GE(outlook.samples[n].in_s, static_cast<double>(n) - 1e-6);
    EXPECT_LT(outlook.samples[n].in_s, static_cast<double>(n) + outlook.tick_s);
  }
}

TEST_F(PreviewTest, An_area_is_covered_when_it_first_has_nine_tenths_of_what_is_asked) {
  const Outlook outlook = future();
  for (const AreaOutlook& one : outlook.areas) {
    ASSERT_TRUE(one.covered_in_s) << one.what.name;
    const Outlook until = future({}, *one.covered_in_s);
    EXPECT_GE(area(until, one.what.name).achieved, kCoveredShare * one.asked);
    const Outlook before = future({}, *one.covered_in_s - 0.2);
    EXPECT_LT(area(before, one.what.name).achieved, kCoveredShare * one.asked);
  }
}

TEST_F(PreviewTest, An_area_is_seen_when_no_part_of_it_has_waited_since_now) {
  const Outlook outlook = future();
  for (const AreaOutlook& one : outlook.areas) {
    ASSERT_GT(one.seen_in_s.value_or(0.0), 0.4) << one.what.name;
    EXPECT_LE(*one.seen_in_s, one.worst_age_s + 1e-9);
    EXPECT_FALSE(area(future({}, *one.seen_in_s - 0.2), one.what.name).seen_in_s);
  }
}

TEST_F(PreviewTest, Ages_go_on_from_what_has_been_seen_until_now) {
  const double now_s = flight.snapshot().time_s;
  const std::vector<AreaState> states = watch.states({}, now_s);
  const Outlook outlook = future({}, 1.0);
  for (std::size_t n = 0; n < states.size(); ++n) EXPECT_GE(outlook.areas[n].worst_age_s, states[n].age_s);
  EXPECT_GE(outlook.samples.front().worst_age_s, std::max(states[0].age_s, states[1].age_s));
}

TEST_F(PreviewTest, Without_a_drone_it_lands_where_it_is_and_the_others_go_on) {
  const Outlook outlook = future({nullptr, {swarm::DroneId(1)}});
  EXPECT_EQ(outlook.samples.back().active, 2U);
  const std::size_t last = outlook.ghost_points - 1;
  EXPECT_LT((ghost(outlook, 1, last) - ghost(outlook, 1, 0)).norm(), 0.1);
  EXPECT_EQ(ghost(outlook, 1, last), ghost(outlook, 1, last / 2));
  const Outlook all = future();
  EXPECT_EQ(all.samples.back().active, 3U);
  EXPECT_NE(outlook.samples.back().metric, all.samples.back().metric);
}

TEST_F(PreviewTest, Without_anybody_ages_grow_as_fast_as_time) {
  const Outlook outlook = future({nullptr, {swarm::DroneId(0), swarm::DroneId(1), swarm::DroneId(2)}});
  EXPECT_EQ(outlook.samples.back().active, 0U);
  const double first = outlook.samples[10].worst_age_s;
  const double last = outlook.samples.back().worst_age_s;
  EXPECT_NEAR(last - first, outlook.samples.back().in_s - outlook.samples[10].in_s, 1e-9);
}

TEST_F(PreviewTest, New_targets_draw_the_drones_to_them) {
  WhatIf question;
  question.targets = mission;
  question.targets->targets.clusters.push_back({"new", {Vec2(1.5, 11.6), Vec2(1.6, 11.7)}, 20.0, {}});
  const Outlooks outlooks = look_ahead(start(), question, never).value();
  EXPECT_EQ(outlooks.tick, flight.state().ticks());
  EXPECT_EQ(outlooks.as_is.areas.size(), 2U);
  ASSERT_TRUE(outlooks.what_if);
  const AreaOutlook& added = area(*outlooks.what_if, "new");
  EXPECT_GT(added.asked, 0.3);
  EXPECT_TRUE(added.seen_in_s);
  EXPECT_GT(added.achieved, 0.2);
}

TEST_F(PreviewTest, Where_nothing_is_to_change_there_is_one_future) {
  const Outlooks outlooks = look_ahead(start(), {.seconds = 3.0, .targets = {}, .without = {}}, never).value();
  EXPECT_FALSE(outlooks.what_if);
  EXPECT_EQ(outlooks.as_is.seconds, 3.0);
}

TEST_F(PreviewTest, A_coarser_density_asks_for_the_same) {
  const ergodic::Basis& basis = flight.state().basis();
  const auto coarse = previewed_target(mission, basis);
  const auto fine = coverage_target(mission, basis);
  EXPECT_TRUE(coarse->has_targets);
  EXPECT_LT((coarse->phi_k - fine->phi_k).norm(), 0.01 * fine->phi_k.norm());
}

TEST_F(PreviewTest, Who_is_cancelled_says_nothing) {
  const std::atomic<bool> cancelled{true};
  EXPECT_FALSE(look_into_future(start(), {}, 60.0, cancelled));
  EXPECT_FALSE(look_ahead(start(), {}, cancelled));
}

TEST_F(PreviewTest, Drones_keep_their_distance_in_every_future) {
  const Outlook outlook = future();
  EXPECT_GE(outlook.least_pair_m, mission.safety.separation_m);
  EXPECT_LT(outlook.least_pair_m, 3.0);
}

TEST_F(PreviewTest, Trails_are_thinned_out_to_a_bounded_number_of_points) {
  const Outlook shorter = future({}, 60.0);
  EXPECT_EQ(shorter.ghost_points, 61U);
  EXPECT_NEAR(shorter.ghost_spacing_s, 1.0, 1e-9);
  const Outlook longest = future({}, kLongestPreviewS);
  EXPECT_EQ(longest.ghosts.size(), 3 * longest.ghost_points);
  EXPECT_LE(longest.ghosts.size(), kMostGhostPoints);
}

TEST(PreviewTickTest, A_models_tick_is_a_whole_number_of_the_missions_and_longer_for_more_drones) {
  for (const double dt_s : {0.01, 0.02, 0.05, 0.3}) {
    double before = 0.0;
    for (const std::size_t drones : {1U, 100U, 101U, 300U, 1000U}) {
      const double tick_s = preview_tick_s(dt_s, drones);
      EXPECT_NEAR(tick_s / dt_s, std::round(tick_s / dt_s), 1e-9);
      EXPECT_GE(tick_s, std::max(dt_s, before));
      EXPECT_LE(tick_s, std::max(dt_s, 0.4 + 1e-9));
      before = tick_s;
    }
  }
}

}  // namespace
}  // namespace vigil::runtime
