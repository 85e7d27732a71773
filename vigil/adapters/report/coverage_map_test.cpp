#include "vigil/adapters/report/coverage_map.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "vigil/adapters/report/sample_flight.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

double integral(const CoverageMap& map, const Eigen::ArrayXXd& density) {
  return density.sum() * map.cell_x_m * map.cell_y_m;
}

struct Flown {
  runtime::RecordedFlight flight = sample_flight();
  runtime::Mission mission = sample_mission();
  CoverageMap map() const { return coverage_map(prepare(flight, mission), runtime::importance(mission)); }
};

TEST(CoverageMap, Both_densities_have_mass_one) {
  const CoverageMap map = Flown().map();
  EXPECT_NEAR(integral(map, map.flown), 1.0, 1e-9);
  EXPECT_NEAR(integral(map, map.wanted), 1.0, 1e-3);
  EXPECT_NEAR(integral(map, map.uniform()), 1.0, 1e-9);
}

TEST(CoverageMap, A_density_coincides_wholly_with_itself_and_less_with_another) {
  const CoverageMap map = Flown().map();
  EXPECT_NEAR(map.overlap(map.flown, map.flown), 1.0, 1e-9);
  EXPECT_LT(map.overlap(map.flown, map.uniform()), 0.6);
}

TEST(CoverageMap, Shares_of_attention_add_up_to_all_of_it) {
  const CoverageMap map = Flown().map();
  ASSERT_EQ(map.shares.size(), 4U);
  double asked = 0.0;
  double achieved = 0.0;
  double area = 0.0;
  for (const AttentionShare& share : map.shares) {
    asked += share.asked;
    achieved += share.achieved;
    area += share.area;
  }
  EXPECT_NEAR(asked, 1.0, 1e-3);
  EXPECT_NEAR(achieved, 1.0, 1e-9);
  EXPECT_NEAR(area, 1.0, 1e-9);
}

TEST(CoverageMap, All_attention_goes_to_the_target_over_which_every_drone_stays) {
  Flown flown;
  for (Vec2& place : flown.flight.rows.true_position_m) place = {0.82, 0.27};
  const CoverageMap map = flown.map();
  EXPECT_EQ(map.shares[1].name, "east");
  EXPECT_NEAR(map.shares[1].achieved, 1.0, 1e-9);
  EXPECT_NEAR(map.shares[0].achieved, 0.0, 1e-9);
  EXPECT_NEAR(map.shares[1].asked, 1.0 / 3.0, 0.05);
}

TEST(CoverageMap, A_drone_that_is_not_active_covers_nothing) {
  Flown flown;
  for (std::size_t tick = 0; tick < flown.flight.tick_count(); ++tick) {
    flown.flight.rows.activity[flown.flight.row(tick, 1)] = swarm::Activity::kHeld;
    flown.flight.rows.true_position_m[flown.flight.row(tick, 0)] = {0.82, 0.27};
    flown.flight.rows.true_position_m[flown.flight.row(tick, 2)] = {0.82, 0.27};
  }
  EXPECT_NEAR(flown.map().shares[1].achieved, 1.0, 1e-9);
}

TEST(CoverageMap, Time_before_a_fresh_start_does_not_count) {
  Flown flown;
  for (std::size_t tick = 0; tick < flown.flight.tick_count(); ++tick) {
    for (std::size_t i = 0; i < 3; ++i) {
      flown.flight.rows.true_position_m[flown.flight.row(tick, i)] =
          flown.flight.ticks.time_s[tick] < 30.0 ? Vec2(-0.75, 0.72) : Vec2(0.82, 0.27);
    }
  }
  EXPECT_NEAR(flown.map().shares[1].achieved, 0.45, 0.1);
  flown.flight.events.push_back({30.0, "operator", "start_afresh", "", ""});
  EXPECT_NEAR(flown.map().shares[1].achieved, 1.0, 1e-9);
}

TEST(CoverageMap, The_past_fades_as_the_mission_says) {
  Flown flown;
  for (std::size_t tick = 0; tick < flown.flight.tick_count(); ++tick) {
    for (std::size_t i = 0; i < 3; ++i) {
      flown.flight.rows.true_position_m[flown.flight.row(tick, i)] =
          flown.flight.ticks.time_s[tick] < 50.0 ? Vec2(-0.75, 0.72) : Vec2(0.82, 0.27);
    }
  }
  flown.mission.control.memory_s = 5.0;
  EXPECT_NEAR(flown.map().shares[1].achieved, 1.0 - std::exp(-2.0), 0.02);
}

TEST(CoverageMap, Smoothing_goes_no_farther_than_the_field) {
  Flown flown;
  flown.flight = sample_flight({.duration_s = 1.0});
  field::Importance importance = runtime::importance(flown.mission);
  importance.sigma_min_m = 1000.0;
  const CoverageMap map = coverage_map(prepare(flown.flight, flown.mission), importance);
  EXPECT_EQ(map.smoothing_m, 3.0);
  EXPECT_NEAR(integral(map, map.flown), 1.0, 1e-9);
  EXPECT_GT(map.overlap(map.flown, map.uniform()), 0.999);
}

TEST(CoverageMap, Without_targets_there_is_no_map_and_no_share) {
  Flown flown;
  flown.mission.targets.clusters.clear();
  const CoverageMap map = flown.map();
  EXPECT_FALSE(map.has_targets());
  EXPECT_TRUE(map.shares.empty());
  EXPECT_NEAR(integral(map, map.flown), 1.0, 1e-9);
}

}  // namespace
}  // namespace vigil::report
