// The paper's experiment (section IV) flown whole, judged by ground truth.

#include <algorithm>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vigil/apps/flight_for_tests.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {
namespace {

runtime::Mission paper(const std::vector<runtime::Override>& overrides = {}) {
  return runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml", overrides);
}

double percent_at(const runtime::FlightSummary& summary, double time_s) {
  for (const auto& [at_s, percent] : summary.percent_at)
    if (at_s == time_s) return percent;
  ADD_FAILURE() << "no metric at " << time_s;
  return 0.0;
}

void expect_safe(const runtime::FlightSummary& summary, double separation_m) {
  EXPECT_EQ(summary.audit.separation_violations, 0U);
  EXPECT_EQ(summary.audit.wall_violations, 0U);
  EXPECT_EQ(summary.audit.no_fly_violations, 0U);
  EXPECT_EQ(summary.audit.speed_violations, 0U);
  EXPECT_GE(summary.audit.least.active_pair_m, separation_m - 1e-9);
}

/// Three clusters of five points each, anywhere on the field.
std::vector<runtime::ClusterEntry> random_clusters(std::mt19937_64& random) {
  std::uniform_real_distribution<double> centre(-1.1, 1.1);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  std::vector<runtime::ClusterEntry> clusters(3);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    clusters[i].name = "random" + std::to_string(i);
    const Vec2 mean(centre(random), centre(random));
    for (int k = 0; k < 5; ++k) clusters[i].points_m.push_back(mean + Vec2(offset(random), offset(random)));
  }
  return clusters;
}

TEST(PaperExperiment, The_metric_falls_to_five_percent_without_a_single_violation) {
  const runtime::FlightSummary summary = fly(paper());
  RecordProperty("percent_last", std::to_string(summary.last_percent));
  expect_safe(summary, 0.2);
  EXPECT_LE(summary.last_percent, 5.0);
  EXPECT_EQ(summary.ticks, 6000U);
}

TEST(PaperExperiment, The_survivors_keep_covering_after_the_second_drone_landed) {
  const runtime::FlightSummary summary = fly(paper());
  const std::vector<std::pair<double, std::size_t>> expected{{0.0, 3}, {23.0, 2}};
  EXPECT_EQ(summary.active, expected);
  for (const double time_s : {30.0, 40.0, 60.0, 90.0, 120.0}) EXPECT_LE(percent_at(summary, time_s), 5.0) << time_s;
  for (const auto& [area, worst_s] : summary.worst_revisit_s) EXPECT_LE(worst_s, 90.0) << area;
}

TEST(PaperExperiment, Ten_random_sets_of_targets_end_low_and_safe) {
  std::mt19937_64 random(2025);
  std::vector<double> percents;
  for (int set = 0; set < 10; ++set) {
    runtime::Mission mission = paper();
    mission.targets.clusters = random_clusters(random);
    const runtime::FlightSummary summary = fly(mission);
    SCOPED_TRACE("set " + std::to_string(set));
    expect_safe(summary, 0.2);
    percents.push_back(summary.last_percent);
    std::printf("set %d: %.2f %%, least separation %.4f m\n", set, summary.last_percent,
                summary.audit.least.airborne_pair_m);
  }
  std::sort(percents.begin(), percents.end());
  EXPECT_LE(0.5 * (percents[4] + percents[5]), 3.0);
  EXPECT_LE(percents.back(), 8.0);
}

TEST(PaperExperiment, Equation_14_as_printed_jumps_at_the_failure_and_stays_high) {
  const runtime::FlightSummary sound = fly(paper());
  const runtime::FlightSummary printed = fly(paper({{"control.accounting", "paper_eq14"}}));
  expect_safe(printed, 0.2);
  EXPECT_EQ(percent_at(printed, 20.0), percent_at(sound, 20.0));  // the same law until then
  EXPECT_GT(printed.last_percent, 10.0 * sound.last_percent);
  EXPECT_GT(printed.last_percent, percent_at(printed, 20.0));
}

TEST(PaperExperiment, Flights_side_by_side_in_threads_are_the_same_flight) {
  const runtime::Mission mission = paper({{"simulation.duration_s", "30"}, {"simulation.tracker.noise_m", "0.002"}});
  const std::string alone = runtime::to_json(fly(mission)).dump();
  std::vector<std::string> together(4);
  {
    std::vector<std::jthread> threads;
    for (std::string& result : together)
      threads.emplace_back([&result, &mission] { result = runtime::to_json(fly(mission)).dump(); });
  }
  for (const std::string& result : together) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace vigil::apps
