#include "vigil/runtime/campaign_tally.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vigil::runtime {
namespace {

RunRecord record(std::uint64_t number, double separation_m, std::uint64_t violations = 0) {
  return {.number = number,
          .command = "run " + std::to_string(number),
          .summary = {{"metric", {{"percent_last", 10.0 * static_cast<double>(number)}}},
                      {"min_separation_m", {{"airborne", separation_m}, {"active", nullptr}}},
                      {"worst_revisit_s", {{"a", 3.0}, {"b", 7.0 + separation_m}}},
                      {"separation_violations", violations},
                      {"wall_violations", 0}}};
}

nlohmann::ordered_json tally(const std::vector<RunRecord>& records) {
  CampaignTally tally;
  for (const RunRecord& one : records) tally.add(one);
  return tally.to_json();
}

TEST(CampaignTally, Names_the_median_and_the_worst_run_of_each_figure) {
  const auto json = tally({record(0, 0.3), record(1, 0.1), record(2, 0.2)});
  const auto& separation = json["figures"]["min_separation_airborne_m"];
  EXPECT_EQ(separation["median"], 0.2);
  EXPECT_EQ(separation["worst"], 0.1);
  EXPECT_EQ(separation["run"], 1);
  EXPECT_EQ(separation["command"], "run 1");
  EXPECT_EQ(json["figures"]["metric_percent_last"]["run"], 2);  // most, not least
  EXPECT_EQ(json["figures"]["worst_revisit_s"]["worst"], 7.3);  // of all areas
}

TEST(CampaignTally, The_median_of_an_even_number_lies_between_the_middle_two) {
  const auto json = tally({record(0, 0.4), record(1, 0.1), record(2, 0.2), record(3, 0.9)});
  EXPECT_DOUBLE_EQ(json["figures"]["min_separation_airborne_m"]["median"], 0.3);
}

TEST(CampaignTally, Leaves_out_figures_that_no_run_has) {
  const auto json = tally({record(0, 0.3)});
  EXPECT_FALSE(json["figures"].contains("min_separation_active_m"));
  EXPECT_FALSE(json["figures"].contains("goals_per_drone_minute"));
}

TEST(CampaignTally, Counts_runs_with_violations_not_their_ticks) {
  const auto json = tally({record(0, 0.3), record(2, 0.1, 50), record(1, 0.1, 7)});
  EXPECT_EQ(json["flown"], 3);
  EXPECT_EQ(json["violations"]["runs"], 2);
  EXPECT_EQ(json["violations"]["separation"], 2);
  EXPECT_EQ(json["violations"]["wall"], 0);
  EXPECT_EQ(json["violations"]["first_runs"], nlohmann::ordered_json({1, 2}));
}

TEST(CampaignTally, Does_not_depend_on_the_order_of_the_runs) {
  std::vector<RunRecord> records{record(0, 0.3, 1), record(1, 0.1), record(2, 0.1), record(3, 0.5, 2)};
  const std::string expected = tally(records).dump();
  std::ranges::reverse(records);
  EXPECT_EQ(tally(records).dump(), expected);
}

}  // namespace
}  // namespace vigil::runtime
