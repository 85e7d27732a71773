#include "vigil/adapters/report/findings.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/report/sample_flight.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

/// The sample, to be changed before it is judged.
struct Case {
  SampleOptions options;
  runtime::RecordedFlight flight;
  runtime::Mission mission;

  explicit Case(SampleOptions chosen = {})
      : options(chosen), flight(sample_flight(chosen)), mission(sample_mission(chosen)) {}
  FlightData data() const { return prepare(flight, mission); }
  CoverageMap map() const { return coverage_map(data(), runtime::importance(mission)); }
};

bool says(const Finding& finding, const std::string& words) {
  return finding.measured.find(words) != std::string::npos;
}

TEST(MetricFindings, A_metric_that_ends_small_holds_and_one_that_does_not_differs) {
  Case c;
  EXPECT_EQ(metric_findings(c.data())[0].verdict, Verdict::kHolds);
  c.flight.ticks.metric_percent.back() = 5.25;
  const Finding finding = metric_findings(c.data())[0];
  EXPECT_EQ(finding.verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(finding, "5.25 %")) << finding.measured;
}

TEST(MetricFindings, Survivors_that_make_it_worse_differ) {
  Case c;
  EXPECT_EQ(metric_findings(c.data())[1].verdict, Verdict::kHolds);
  c.flight.ticks.metric_percent.back() = 60.0;
  EXPECT_EQ(metric_findings(c.data())[1].verdict, Verdict::kDiffers);
}

TEST(MetricFindings, A_flight_without_a_metric_tests_nothing) {
  Case c;
  for (double& percent : c.flight.ticks.metric_percent) percent = std::nan("");
  EXPECT_EQ(metric_findings(c.data())[0].verdict, Verdict::kNotTested);
}

TEST(DensityFindings, Drones_that_leave_a_target_out_differ_and_the_target_is_named) {
  Case c;
  for (std::size_t row = 0; row < c.flight.rows.true_position_m.size(); ++row) {
    c.flight.rows.true_position_m[row] = row % 2 == 0 ? Vec2(0.82, 0.27) : Vec2(-0.75, 0.72);
  }
  const std::vector<Finding> findings = density_findings(c.map());
  EXPECT_EQ(findings[0].verdict, Verdict::kDiffers);
  EXPECT_EQ(findings[1].verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(findings[1], "'south'")) << findings[1].measured;
}

TEST(DensityFindings, Drones_that_visit_all_targets_alike_hold) {
  EXPECT_EQ(density_findings(Case().map())[1].verdict, Verdict::kHolds);
}

TEST(DensityFindings, A_target_with_two_thirds_of_what_it_asked_for_is_not_attended_to) {
  Case c;
  CoverageMap map = c.map();
  for (AttentionShare& share : map.shares) share.achieved = share.asked;
  map.shares[0].achieved = 0.72 * map.shares[0].asked;
  EXPECT_EQ(density_findings(map)[1].verdict, Verdict::kHolds);
  map.shares[0].achieved = 0.66 * map.shares[0].asked;
  EXPECT_EQ(density_findings(map)[1].verdict, Verdict::kDiffers);
}

TEST(SnapshotFindings, A_swarm_that_is_around_targets_half_as_long_as_asked_is_not_drawn_to_them) {
  const Case c;
  CoverageMap map = c.map();
  const double asked = 1.0 - map.shares.back().asked;
  map.shares.back().achieved = 1.0 - 0.54 * asked;
  ASSERT_LT(1.0 - map.shares.back().area, 0.54 * asked);  // more than flying anywhere would give
  EXPECT_EQ(snapshot_findings(c.data(), map)[0].verdict, Verdict::kDiffers);
}

TEST(InputFindings, One_command_over_the_limit_differs_and_is_named) {
  Case c;
  EXPECT_EQ(input_findings(c.data())[0].verdict, Verdict::kHolds);
  c.flight.rows.command_m_s[c.flight.row(100, 2)] = {0.0, 0.301};
  const Finding finding = input_findings(c.data())[0];
  EXPECT_EQ(finding.verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(finding, "0.3010 m/s (cf3, 10 s)")) << finding.measured;
}

TEST(InputFindings, Survivors_that_stop_differ) {
  Case c;
  EXPECT_EQ(input_findings(c.data())[1].verdict, Verdict::kHolds);
  for (std::size_t row = c.flight.row(230, 0); row < c.flight.rows.command_m_s.size(); ++row) {
    c.flight.rows.command_m_s[row] = {0.0, 0.0};
  }
  EXPECT_EQ(input_findings(c.data())[1].verdict, Verdict::kDiffers);
}

TEST(SnapshotFindings, A_drone_nearer_to_the_border_than_allowed_differs_with_its_time) {
  Case c;
  EXPECT_EQ(snapshot_findings(c.data(), c.map())[1].verdict, Verdict::kHolds);
  c.flight.ticks.clearances[42].wall_m = 0.1699;
  const Finding finding = snapshot_findings(c.data(), c.map())[1];
  EXPECT_EQ(finding.verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(finding, "0.1699 m at 4.2 s")) << finding.measured;
}

TEST(SnapshotFindings, Drones_that_stay_away_from_targets_differ) {
  Case c;
  EXPECT_EQ(snapshot_findings(c.data(), c.map())[0].verdict, Verdict::kHolds);
  for (Vec2& place : c.flight.rows.true_position_m) place = {1.3, -1.3};
  EXPECT_EQ(snapshot_findings(c.data(), c.map())[0].verdict, Verdict::kDiffers);
}

TEST(DistanceFindings, Two_active_drones_below_the_safety_distance_differ) {
  Case c;
  EXPECT_EQ(distance_findings(c.data(), closest_to_lost(c.data()))[0].verdict, Verdict::kHolds);
  c.flight.ticks.clearances[312].active_pair_m = 0.1999;
  const Finding finding = distance_findings(c.data(), closest_to_lost(c.data()))[0];
  EXPECT_EQ(finding.verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(finding, "0.1999 m at 31.2 s")) << finding.measured;
}

TEST(DistanceFindings, Passing_a_landed_drone_closer_than_the_safety_distance_is_seen) {
  Case c;
  const FlightData before = c.data();
  c.flight.rows.true_position_m[c.flight.row(400, 0)] =
      c.flight.rows.true_position_m[c.flight.row(400, 1)] + Vec2(0.05, 0.0);
  const Finding finding = distance_findings(c.data(), closest_to_lost(c.data()))[1];
  EXPECT_EQ(finding.verdict, Verdict::kHolds);
  EXPECT_TRUE(says(finding, "cf1 to cf2, 0.0500 m at 40 s")) << finding.measured;
}

TEST(DistanceFindings, Coming_near_a_lost_drone_that_is_still_in_the_air_is_never_praised) {
  Case c;
  for (double& height : c.flight.rows.true_height_m) height = 0.5;
  c.flight.rows.true_position_m[c.flight.row(400, 0)] =
      c.flight.rows.true_position_m[c.flight.row(400, 1)] + Vec2(0.01, 0.0);
  c.flight.ticks.clearances[400].airborne_pair_m = 0.01;
  const std::vector<Finding> findings = distance_findings(c.data(), closest_to_lost(c.data()));
  EXPECT_EQ(findings[0].verdict, Verdict::kHolds);  // of active drones
  EXPECT_EQ(findings[1].verdict, Verdict::kNotTested);
  EXPECT_EQ(findings[2].verdict, Verdict::kDiffers);
  EXPECT_TRUE(says(findings[2], "0.0100 m at 40 s")) << findings[2].measured;
}

TEST(DistanceFindings, A_lost_drone_is_down_by_what_was_known_where_there_is_no_truth) {
  Case c;
  for (Vec2& place : c.flight.rows.true_position_m) place = Vec2::Constant(std::nan(""));
  c.flight.rows.position_m[c.flight.row(400, 0)] = c.flight.rows.position_m[c.flight.row(400, 1)] + Vec2(0.05, 0.0);
  EXPECT_EQ(distance_findings(c.data(), closest_to_lost(c.data()))[1].verdict, Verdict::kNotTested);
  c.flight.rows.height_m[c.flight.row(400, 1)] = 0.02;
  EXPECT_EQ(distance_findings(c.data(), closest_to_lost(c.data()))[1].verdict, Verdict::kHolds);
}

TEST(DistanceFindings, Without_a_lost_drone_nothing_is_said_of_lost_drones) {
  const Case c({.landing_s = 1e9});
  EXPECT_EQ(distance_findings(c.data(), closest_to_lost(c.data()))[1].verdict, Verdict::kNotTested);
  EXPECT_EQ(metric_findings(c.data())[1].verdict, Verdict::kNotTested);
  EXPECT_EQ(input_findings(c.data())[1].verdict, Verdict::kNotTested);
}

TEST(AccountingNotes, The_printed_formula_is_explained_with_this_recordings_jump) {
  Case c;
  c.mission.control.accounting = ergodic::Accounting::kPaperEq14;
  for (std::size_t tick = 230; tick < c.flight.tick_count(); ++tick) c.flight.ticks.metric_percent[tick] = 47.0;
  const std::vector<std::string> notes = accounting_notes(c.data(), c.map());
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_NE(notes[1].find("to as much as 47 %"), std::string::npos) << notes[1];
  EXPECT_NE(notes[1].find("total mass 2."), std::string::npos) << notes[1];
}

TEST(AccountingNotes, The_default_needs_one_paragraph) {
  const Case c;
  EXPECT_EQ(accounting_notes(c.data(), c.map()).size(), 1U);
}

}  // namespace
}  // namespace vigil::report
