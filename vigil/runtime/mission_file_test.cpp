#include "vigil/runtime/mission_file.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_writer.hpp"

namespace vigil::runtime {
namespace {

Mission right_with(std::initializer_list<Override> overrides) {
  return parse_mission(right_mission(), "right", std::vector<Override>(overrides));
}

MissionFault fault_of(std::initializer_list<Override> overrides) {
  try {
    static_cast<void>(right_with(overrides));
  } catch (const MissionError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

TEST(MissionFile, The_papers_mission_says_what_the_paper_says) {
  const Mission mission = load_mission(std::filesystem::path(VIGIL_MISSIONS_DIR) / "paper.yaml");
  EXPECT_EQ(mission.field.size_m, Vec2(3.0, 3.0));
  EXPECT_EQ(mission.drones.size(), 3U);
  EXPECT_EQ(mission.targets.clusters.size(), 3U);
  EXPECT_EQ(mission.control.speed_limit_m_s, 0.3);
  EXPECT_EQ(mission.control.fade, 0.0);
  EXPECT_EQ(mission.control.controller, ergodic::ControllerKind::kGradient);
  EXPECT_EQ(mission.control.memory, Memory::kEndless);
  EXPECT_EQ(mission.safety.barrier, safety::BarrierKind::kPaper);
  EXPECT_EQ(mission.safety.obstacles, Obstacles::kActiveOnly);
  ASSERT_EQ(mission.simulation.events.size(), 1U);
  EXPECT_EQ(mission.simulation.events[0].at_s, 23.0);
  EXPECT_EQ(mission.simulation.events[0].what, EventKind::kLand);
  EXPECT_EQ(mission.simulation.events[0].drone, "cf2");
}

TEST(MissionFile, Every_mission_of_the_repository_is_right_and_survives_writing) {
  int missions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VIGIL_MISSIONS_DIR)) {
    if (entry.path().extension() != ".yaml") continue;
    const Mission mission = load_mission(entry.path());
    EXPECT_EQ(parse_mission(mission_yaml(mission), "written"), mission) << entry.path();
    ++missions;
  }
  EXPECT_GE(missions, 1);
}

TEST(MissionFile, Absent_keys_take_the_defaults_of_the_structures) {
  const Mission mission = parse_mission(right_mission(), "right");
  EXPECT_EQ(mission.control.fade, ControlSection{}.fade);
  EXPECT_EQ(mission.control.basis_max_index, ControlSection{}.basis_max_index);
  EXPECT_EQ(mission.simulation.tracker, TrackerSection{});
  EXPECT_FALSE(mission.safety.sensing_range_m);
}

TEST(MissionFile, Line_ends_of_other_systems_and_a_byte_order_mark_change_nothing) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : right_mission()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse_mission(text, "right"), parse_mission(right_mission(), "right"));
}

TEST(MissionFile, Numbers_are_read_to_their_last_digit) {
  const auto speed = [](const std::string& written) {
    return parse_mission(right_mission_but("speed_limit_m_s: 0.3", "speed_limit_m_s: " + written), "right")
        .control.speed_limit_m_s;
  };
  EXPECT_EQ(speed("0.30000000000000004"), 0.1 + 0.2);
  EXPECT_EQ(speed("3e-1"), 0.3);
  EXPECT_EQ(speed("+.3"), 0.3);
  EXPECT_EQ(speed("1."), 1.0);
}

TEST(MissionFile, A_clamped_target_is_kept_as_written) {
  const std::string clamped = right_mission_but("targets:", "targets:\n  outside_field: clamp");
  const Mission mission =
      parse_mission(std::string(clamped).replace(clamped.find("[0.2, 1.1]"), 10, "[0.2, 1.9]"), "right");
  EXPECT_EQ(mission.targets.clusters[0].points_m[1], Vec2(0.2, 1.9));
}

TEST(Overrides, Change_a_value_in_a_section_a_list_and_a_section_that_is_not_written) {
  const Mission mission = right_with({{"safety.separation_m", "0.25"},
                                      {"drones[1].start_m", "[0.5, 0.25]"},
                                      {"drones[0].start_m[0]", "-0.5"},
                                      {"simulation.tracker.noise_m", "0.01"}});
  EXPECT_EQ(mission.safety.separation_m, 0.25);
  EXPECT_EQ(mission.drones[1].start_m, Vec2(0.5, 0.25));
  EXPECT_EQ(mission.drones[0].start_m, Vec2(-0.5, -1.0));
  EXPECT_EQ(mission.simulation.tracker.noise_m, 0.01);
}

TEST(Overrides, Later_ones_win_over_earlier_ones) {
  EXPECT_EQ(right_with({{"control.rate_hz", "20"}, {"control.rate_hz", "40"}}).control.rate_hz, 40.0);
}

TEST(Overrides, None_takes_an_optional_value_or_an_entry_away) {
  EXPECT_FALSE(right_with({{"sensor.footprint_radius_m", "none"}}).sensor.footprint_radius_m);
  EXPECT_FALSE(right_with({{"safety.lag_s", "none"}}).safety.lag_s);
  EXPECT_EQ(right_with({{"simulation.events[0]", "none"}}).simulation.events.size(), 2U);
  EXPECT_TRUE(right_with({{"no_fly", "none"}}).no_fly.empty());
  const Mission grid =
      right_with({{"drones", "none"}, {"no_fly", "none"}, {"drone_grid.count", "4"}, {"simulation.events", "none"}});
  EXPECT_EQ(grid.drones.size(), 4U);
}

TEST(Overrides, Are_refused_like_what_a_file_says_with_the_option_for_the_place) {
  EXPECT_EQ(fault_of({{"safety.separation_m", "-1"}}).place, "--set safety.separation_m");
  EXPECT_EQ(fault_of({{"safety.separation_m", "-1"}}).value, "-1");
  EXPECT_EQ(fault_of({{"safety.separation_m", "none"}}).problem, "is missing");
  EXPECT_EQ(fault_of({{"safety.separation_m", "none"}}).place, "--set safety.separation_m");
  EXPECT_EQ(fault_of({{"safety.seperation_m", "1"}}).advice, "did you mean separation_m?");
  EXPECT_EQ(fault_of({{"safety.sensing_range_m", "0.1"}}).place, "--set safety.sensing_range_m");
  EXPECT_EQ(fault_of({{"drones[2].id", "c"}}).problem, "has no entry [2]");
  EXPECT_EQ(fault_of({{"control.rate_hz.x", "1"}}).problem, "looks for `x` in what is no section");
  EXPECT_EQ(fault_of({{"control..rate_hz", "1"}}).problem, "is not the path of a key");
  EXPECT_EQ(fault_of({{"control.rate_hz", ""}}).problem, "has no value");
  EXPECT_TRUE(fault_of({{"control.rate_hz", "[1"}}).place.starts_with("--set control.rate_hz"));
  EXPECT_EQ(fault_of({{"drones[99999999999999999999].id", "c"}}).problem, "is not the path of a key");
}

TEST(Overrides, That_another_option_wrote_are_refused_in_its_name_as_written) {
  const MissionFault negative = fault_of({{"simulation.seed", "-1", "--seed"}});
  EXPECT_EQ(negative.place, "--seed");
  EXPECT_EQ(negative.value, "-1");
  EXPECT_EQ(fault_of({{"simulation.duration_s", "", "--seconds"}}).place, "--seconds");
  EXPECT_EQ(fault_of({{"simulation.duration_s", "", "--seconds"}}).problem, "has no value");
  EXPECT_EQ(fault_of({{"simulation.duration_s", "none", "--seconds"}}).value, "none");
  EXPECT_EQ(fault_of({{"simulation.duration_s", "1e-9", "--seconds"}}).place, "--seconds");
}

TEST(Overrides, Are_taken_apart_at_the_first_equals_sign) {
  EXPECT_EQ(parse_override("name=a=b").key, "name");
  EXPECT_EQ(parse_override("name=a=b").value, "a=b");
  EXPECT_THROW(static_cast<void>(parse_override("name")), MissionError);
  EXPECT_THROW(static_cast<void>(parse_override("=1")), MissionError);
}

TEST(MissionFile, One_tick_is_the_shortest_mission) {
  EXPECT_EQ(right_with({{"simulation.duration_s", "0.02"}}).simulation.duration_s, 0.02);
  EXPECT_EQ(fault_of({{"simulation.duration_s", "0.0199"}}).problem, "is shorter than one tick");
}

TEST(Overrides, A_shorter_duration_drops_the_events_after_it) {
  const Mission mission = right_with({{"simulation.duration_s", "25"}});
  ASSERT_EQ(mission.simulation.events.size(), 2U);
  EXPECT_EQ(parse_mission(mission_yaml(mission), "written"), mission);
}

}  // namespace
}  // namespace vigil::runtime
