#include "vigil/adapters/report/page.hpp"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "vigil/adapters/report/page_figures.hpp"
#include "vigil/adapters/report/plotting.hpp"
#include "vigil/adapters/report/sample_flight.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

constexpr const char* kSummary =
    R"({"complete": true, "metric": {"first": 0.08, "last": 0.001, "percent_last": 1.25, "percent_at": {"23": 4.5}},
  "min_separation_m": {"airborne": 0.0625, "active": 0.375}, "min_wall_distance_m": null, "separation_violations": 17,
  "worst_revisit_s": {"east": 12.5}, "tick_us": {"p50": 10, "p99": 21.0, "max": 50}})";

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

/// The page of the sample, without its drawings.
struct Report {
  runtime::RecordedFlight flight = sample_flight();
  runtime::Mission mission = sample_mission();
  std::optional<std::string> summary = kSummary;

  std::string write() const {
    const FlightData data = prepare(flight, mission);
    const CoverageMap map = coverage_map(data, runtime::importance(mission));
    return page(data, map, summary_facts(data, summary), page_figures(data, map));
  }
};

TEST(Page, A_broken_claim_is_called_broken) {
  Report report;
  const std::size_t before = count_of(report.write(), "does not hold");
  report.flight.ticks.clearances[99].active_pair_m = 0.15;
  const std::string page = report.write();
  EXPECT_EQ(count_of(page, "does not hold"), before + 1);
  EXPECT_NE(page.find("0.1500 m at 9.9 s"), std::string::npos);
}

TEST(Page, A_deadline_that_was_missed_does_not_hold_and_one_that_was_kept_does) {
  Report report;
  const std::size_t before = count_of(report.write(), "does not hold");
  report.mission.targets.clusters[1].revisit_s = 12.0;
  const std::string missed = report.write();
  EXPECT_EQ(count_of(missed, "does not hold"), before + 1);
  EXPECT_NE(missed.find("Asked: 12 s. Worst: 12.5 s."), std::string::npos);
  report.mission.targets.clusters[1].revisit_s = 12.5;
  EXPECT_EQ(count_of(report.write(), "does not hold"), before);
  report.mission.targets.clusters[0].revisit_s = 5.0;  // of which the summary says nothing
  EXPECT_NE(report.write().find("The worst is not known"), std::string::npos);
}

TEST(Page, Fall_backs_are_judged_in_ticks_of_how_many) {
  Report report;
  report.summary = "{\"fallback_ticks\": 0, \"ticks\": 6000}";
  const std::string none = report.write();
  EXPECT_NE(none.find("<td>0</td><td>0</td><td>holds</td>"), std::string::npos);
  report.summary = "{\"fallback_ticks\": 7, \"ticks\": 6000}";
  EXPECT_NE(report.write().find("does not hold in 7 of 6000 ticks"), std::string::npos);
}

TEST(Page, What_befell_drones_stands_beside_when_it_was_noticed) {
  Report report;
  EXPECT_EQ(report.write().find("id=\"faults\""), std::string::npos);
  report.summary = R"({"detections": [
    {"at_s": 20, "befell": "land_by_itself", "drone": "cf1", "noticed_as": "own_mode", "noticed_s": 0.02},
    {"at_s": 30, "befell": "ignore_orders", "drone": "<b>", "noticed_as": null, "noticed_s": null}, 7],
    "faults": {"own_mode": 1}, "false_alarms": 2})";
  const std::string page = report.write();
  EXPECT_NE(page.find("<td>cf1: land by itself at 20 s</td><td>noticed after 0.02 s as own mode</td>"),
            std::string::npos);
  EXPECT_NE(page.find("<td>&lt;b&gt;: ignore orders at 30 s</td><td>not noticed</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>alarms about drones that nothing befell</td><td>2</td>"), std::string::npos);
}

TEST(Page, Captions_speak_of_inactive_drones_only_where_there_are_such) {
  Report report;
  for (const char* words : {"Grey:", "crosses:", "Pale:"})
    EXPECT_NE(report.write().find(words), std::string::npos) << words;
  report.flight = sample_flight({.landing_s = 1e9});
  for (const char* words : {"Grey:", "crosses:", "Pale:"})
    EXPECT_EQ(report.write().find(words), std::string::npos) << words;
}

TEST(Page, The_mission_s_demands_are_not_called_the_paper_s) {
  const std::string page = Report().write();
  const std::size_t mission = page.find("What the mission asks for", page.find("id=\"fig8_distances\""));
  ASSERT_NE(mission, std::string::npos);
  EXPECT_GT(page.find("Drones that are in the air keep"), mission);
  EXPECT_LT(page.find("Active drones always keep"), mission);
}

TEST(Page, A_wide_figure_does_not_widen_a_narrow_page) {
  EXPECT_NE(Report().write().find(".figure { grid-template-columns: minmax(0, 1fr); }"), std::string::npos);
}

TEST(Page, Maps_say_which_frame_their_axes_are_in) {
  const Report report;
  const std::string axes = field_axes(prepare(report.flight, report.mission), true);
  EXPECT_NE(axes.find("'x, field frame [m]'"), std::string::npos);
  EXPECT_NE(axes.find("'y, field frame [m]'"), std::string::npos);
}

TEST(Page, The_summary_goes_before_the_recording_where_both_know) {
  Report report;
  const std::string page = report.write();
  for (const char* words : {"1.25 %", "0.375 m", "0.0625 m", "<td>17</td>", "metric at 23 s", "12.5 s", "21 us"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
}

TEST(Page, Without_a_summary_the_recording_is_enough_and_the_page_says_so) {
  Report report;
  report.summary.reset();
  EXPECT_NE(report.write().find("There is no summary.json"), std::string::npos);
  report.summary = "{\"metric\": [1, 2";
  EXPECT_NE(report.write().find("summary.json cannot be read"), std::string::npos);
  report.summary = "[7]";
  EXPECT_NE(report.write().find("summary.json cannot be read"), std::string::npos);
}

TEST(Page, A_partial_recording_and_a_flight_cut_short_are_told) {
  Report report;
  EXPECT_EQ(report.write().find("class=\"warning\""), std::string::npos);
  report.flight.is_complete = false;
  report.flight.incomplete_reason = "drones.csv ends in the middle of a line";
  report.summary = "{\"complete\": false}";
  const std::string page = report.write();
  EXPECT_NE(page.find("This recording is partial: drones.csv ends in the middle of a line"), std::string::npos);
  EXPECT_NE(page.find("The flight was stopped before its time"), std::string::npos);
}

TEST(Page, The_printed_formula_of_the_paper_is_explained) {
  Report report;
  EXPECT_EQ(report.write().find("total mass of 2"), std::string::npos);
  report.mission.control.accounting = ergodic::Accounting::kPaperEq14;
  EXPECT_NE(report.write().find("total mass of 2"), std::string::npos);
}

}  // namespace
}  // namespace vigil::report
