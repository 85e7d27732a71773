#include "vigil/runtime/campaign_plan.hpp"

#include <set>

#include <gtest/gtest.h>

#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"

namespace vigil::runtime {
namespace {

CampaignPlan plan_of(const char* mission, const std::vector<std::string>& vary, std::uint64_t seed = 1) {
  CampaignPlan plan;
  plan.mission_yaml = mission_yaml(load_mission(std::string(VIGIL_MISSIONS_DIR "/") + mission));
  for (const std::string& text : vary) plan.variations.push_back(parse_variation(text));
  plan.seed = seed;
  plan.runs = 100;
  return plan;
}

const std::vector<std::string> kEverything{"starts",
                                           "targets",
                                           "faults=4",
                                           "safety.margin_m=0.02..0.05",
                                           "control.basis_max_index=5..8",
                                           "safety.obstacles=airborne|active_only"};

TEST(CampaignPlan, The_settings_of_a_run_make_its_very_mission_of_the_plans) {
  for (const char* mission : {"paper.yaml", "lab.yaml", "crowd.yaml"}) {
    const bool is_paper = std::string(mission) == "paper.yaml";  // its barrier has no margin
    const CampaignPlan plan = plan_of(mission, is_paper ? std::vector<std::string>{"starts", "faults"} : kEverything);
    for (std::uint64_t number = 0; number < 10; ++number) {
      const CampaignRun run = draw_run(plan, number);
      EXPECT_EQ(parse_mission(plan.mission_yaml, "plan", run.settings), run.mission);
      EXPECT_EQ(run.mission.simulation.seed, run.seed);
      EXPECT_EQ(run.mission.drones.size(), load_mission(std::string(VIGIL_MISSIONS_DIR "/") + mission).drones.size());
    }
  }
}

TEST(CampaignPlan, A_run_depends_on_plan_seed_and_number_and_on_nothing_else) {
  const CampaignPlan plan = plan_of("lab.yaml", kEverything);
  const CampaignRun later = draw_run(plan, 7);
  static_cast<void>(draw_run(plan, 3));
  EXPECT_EQ(draw_run(plan, 7).mission, later.mission);
  EXPECT_NE(draw_run(plan, 8).mission, later.mission);
  EXPECT_NE(draw_run(plan_of("lab.yaml", kEverything, 2), 7).mission, later.mission);
}

TEST(CampaignPlan, Every_run_has_a_seed_of_its_own_that_JSON_keeps_exact) {
  const CampaignPlan plan = plan_of("paper.yaml", {});
  std::set<std::uint64_t> seeds;
  for (std::uint64_t number = 0; number < 50; ++number) seeds.insert(draw_run(plan, number).seed);
  EXPECT_EQ(seeds.size(), 50U);
  EXPECT_LT(*seeds.rbegin(), std::uint64_t{1} << 53U);
}

TEST(CampaignPlan, Another_variation_leaves_the_starts_where_they_were) {
  const CampaignRun alone = draw_run(plan_of("lab.yaml", {"starts"}), 5);
  const CampaignRun beside = draw_run(plan_of("lab.yaml", {"faults", "targets", "starts"}), 5);
  EXPECT_EQ(alone.mission.drones, beside.mission.drones);
}

TEST(CampaignPlan, Values_fill_their_range_and_every_choice_comes_up) {
  const CampaignPlan plan = plan_of("lab.yaml", {"control.basis_max_index=5..7", "safety.margin_m=0.02..0.04",
                                                 "safety.obstacles=airborne|active_only"});
  std::set<int> indices;
  std::set<Obstacles> obstacles;
  double low = 1.0;
  double high = 0.0;
  for (std::uint64_t number = 0; number < 100; ++number) {
    const Mission mission = draw_run(plan, number).mission;
    indices.insert(mission.control.basis_max_index);
    obstacles.insert(mission.safety.obstacles);
    low = std::min(low, mission.safety.margin_m.value());
    high = std::max(high, mission.safety.margin_m.value());
  }
  EXPECT_EQ(indices, (std::set<int>{5, 6, 7}));
  EXPECT_EQ(obstacles.size(), 2U);
  EXPECT_GE(low, 0.02);
  EXPECT_LT(low, 0.022);
  EXPECT_LE(high, 0.04);
  EXPECT_GT(high, 0.038);
}

TEST(CampaignPlan, Faults_come_beside_the_missions_own_events) {
  const Mission mission = draw_run(plan_of("lab.yaml", {"faults=2:fail"}), 0).mission;
  ASSERT_EQ(mission.simulation.events.size(), 3U);
  EXPECT_EQ(std::ranges::count(mission.simulation.events, EventKind::kLand, &EventEntry::what), 1);
}

TEST(CampaignPlan, A_draw_that_the_checks_refuse_is_drawn_again) {
  // Half of the range is wider than the field.
  const CampaignPlan plan = plan_of("lab.yaml", {"safety.separation_m=0.2..6"});
  for (std::uint64_t number = 0; number < 10; ++number)
    EXPECT_LT(draw_run(plan, number).mission.safety.separation_m, 3.0);
}

TEST(CampaignPlan, A_variation_that_can_never_be_flown_is_refused_with_the_reason) {
  for (const char* vary : {"control.fadde=0..1", "safety.separation_m=4..6"}) {
    try {
      static_cast<void>(draw_run(plan_of("lab.yaml", {vary}), 4));
      FAIL() << vary;
    } catch (const MissionError& error) {
      EXPECT_NE(std::string(error.what()).find("run 4"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(std::string(vary).substr(0, 9)), std::string::npos) << error.what();
    }
  }
}

TEST(CampaignPlan, A_plan_that_was_written_reads_back_the_same) {
  const CampaignPlan plan = plan_of("crowd.yaml", kEverything);
  EXPECT_EQ(parse_plan(plan_json(plan), "plan.json"), plan);
  for (const char* text : {"", "{}", "[1]", "{\"format\":2}", "{\"format\":1,\"runs\":\"x\"}"})
    EXPECT_THROW(static_cast<void>(parse_plan(text, "plan.json")), MissionError) << text;
}

}  // namespace
}  // namespace vigil::runtime
