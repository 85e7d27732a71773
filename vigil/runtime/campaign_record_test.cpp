#include "vigil/runtime/campaign_record.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/flow_yaml.hpp"
#include "vigil/runtime/goal_throughput.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

TEST(CampaignRecord, A_shell_takes_a_quoted_word_for_itself) {
  EXPECT_EQ(shell_quoted("simulation.seed=5"), "simulation.seed=5");
  EXPECT_EQ(shell_quoted("a b"), "'a b'");
  EXPECT_EQ(shell_quoted("drones=[{id: a}]"), "'drones=[{id: a}]'");
  EXPECT_EQ(shell_quoted("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_quoted(""), "''");
}

TEST(CampaignRecord, A_command_names_mission_settings_and_a_directory_of_its_own) {
  const CampaignRun run{
      .number = 42, .seed = 5, .settings = {{"a.b", "[1, 2]"}, {"simulation.seed", "5"}}, .mission = {}};
  EXPECT_EQ(
      repeat_command(run, "out/c 1"),
      "vigil simulate 'out/c 1/mission.yaml' --set 'a.b=[1, 2]' --set simulation.seed=5 --out 'out/c 1/run-000042'");
}

TEST(CampaignRecord, A_line_reads_back_with_its_summary) {
  const CampaignRun run{.number = 42, .seed = 5, .settings = {{"simulation.seed", "5"}}, .mission = {}};
  FlightSummary summary;
  summary.ticks = 17;
  const std::string line = record_line(run, "vigil \"x\"", summary);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const std::optional<RunRecord> record = parse_record(line);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->number, 42U);
  EXPECT_EQ(record->command, "vigil \"x\"");
  EXPECT_EQ(record->summary.at("ticks"), 17);
}

TEST(CampaignRecord, No_part_of_a_line_passes_for_a_record) {
  const CampaignRun run{.number = 1, .seed = 5, .settings = {}, .mission = {}};
  const std::string line = record_line(run, "vigil", {});
  for (std::size_t size = 0; size < line.size(); ++size) EXPECT_FALSE(parse_record(line.substr(0, size))) << size;
  EXPECT_TRUE(parse_record(line));
}

TEST(FlowYaml, Events_and_drones_read_back_bit_for_bit) {
  const std::vector<Override> settings{
      {"simulation.events",
       "[{at_s: 0.1, do: override, drone: cf1, velocity_m_s: [0.1, -0.30000000000000004]}, {at_s: 0.2, do: give_back, "
       "drone: all}, "
       "{at_s: 1, do: lose_tracking, drone: cf3, for_s: 0.7}, {at_s: 2, do: add_target, cluster: \"a: b\", point_m: "
       "[0.1, 0.2]}, "
       "{at_s: 3, do: set_weight, cluster: east, weight: 3}, {at_s: 4, do: start_afresh}]"}};
  const Mission mission = load_mission(VIGIL_MISSIONS_DIR "/lab.yaml", settings);
  const std::vector<Override> again{{"simulation.events", in_flow(mission.simulation.events)},
                                    {"drones", in_flow(mission.drones)},
                                    {"targets.clusters[1].points_m", in_flow(mission.targets.clusters[1].points_m)}};
  EXPECT_EQ(load_mission(VIGIL_MISSIONS_DIR "/lab.yaml", again), mission);
}

TEST(GoalThroughput, Ten_drones_that_reach_thirty_goals_in_half_a_minute_make_six_each_a_minute) {
  EXPECT_DOUBLE_EQ(goals_per_drone_minute(30, 10, 30.0), 6.0);
}

}  // namespace
}  // namespace vigil::runtime
