#include "vigil/runtime/mission_explanation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

Mission right() { return parse_mission(right_mission(), "right"); }

bool any_note_says(const Mission& mission, std::string_view words) {
  return std::ranges::any_of(notes_on(mission),
                             [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(MissionExplanation, Shares_of_attention_follow_points_and_weights_and_sum_to_one) {
  Mission mission = right();
  mission.targets.uniform_floor = 0.3;
  // Two points of weight 1 against an area of weight 5 share what the floor leaves.
  const nlohmann::ordered_json attention = explanation_json(mission).at("attention");
  EXPECT_DOUBLE_EQ(attention.at(0).at("share").get<double>(), 0.7 * 2.0 / 7.0);
  EXPECT_DOUBLE_EQ(attention.at(1).at("share").get<double>(), 0.7 * 5.0 / 7.0);
  EXPECT_DOUBLE_EQ(attention.at(2).at("share").get<double>(), 0.3);
}

TEST(MissionExplanation, Derived_values_are_those_of_the_filter) {
  const nlohmann::ordered_json safety = explanation_json(right()).at("safety");
  EXPECT_NEAR(safety.at("barrier_radius_m").get<double>(), std::hypot(0.2, std::sqrt(5.0) * 0.3 * 0.02), 1e-15);
  EXPECT_GT(safety.at("least_sensing_range_m").get<double>(), 0.2 + 2.0 * 0.3 * 0.02);
  EXPECT_GE(safety.at("sensing_range_m").get<double>(), safety.at("least_sensing_range_m").get<double>());
}

TEST(MissionExplanation, Its_text_names_everything_that_the_mission_names) {
  const std::string text = explain(right());
  for (const std::string_view name :
       {"small", "north", "corner", "mast", "a, b", "lag_aware", "land b", "add_target west"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST(MissionExplanation, Its_text_names_what_is_simulated) {
  Mission mission = right();
  mission.simulation.vehicle = {.model = dynamics::VehicleKind::kPx4, .acceleration_limit_m_s2 = std::nullopt};
  mission.simulation.battery = {.start = 0.9, .endurance_s = std::nullopt};
  mission.simulation.wind.gust_m_s = 1.5;
  mission.simulation.link.loss = 0.1;
  mission.simulation.link.delay_s = 0.02;
  mission.simulation.tracker.over_link = true;
  const std::string text = explain(mission);
  for (const std::string_view words : {"px4, as recorded; an order acts after 0.155 s", "90 % charged",
                                       "gusts of 1.5 m/s", "loses 10 %", "satellites"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words;
  }
}

TEST(MissionNotes, A_mission_without_contradictions_needs_none) {
  EXPECT_TRUE(notes_on(right()).empty()) << notes_on(right()).front();
}

TEST(MissionNotes, The_papers_barrier_is_no_match_for_a_lagging_vehicle) {
  Mission mission = right();
  mission.safety.barrier = safety::BarrierKind::kPaper;
  EXPECT_TRUE(any_note_says(mission, "safe only for vehicles that follow their velocity at once"));
}

TEST(MissionNotes, A_lag_that_the_filter_does_not_know_is_noted) {
  Mission mission = right();
  mission.simulation.vehicle.lag_s = 0.2;
  EXPECT_TRUE(any_note_says(mission, "safety.lag_s (0.1 s) is less than the vehicle's lag (0.2 s)"));
}

TEST(MissionNotes, A_margin_below_what_noise_needs_is_noted) {
  Mission mission = right();
  mission.safety.margin_m = 0.0;
  EXPECT_TRUE(notes_on(mission).empty());
  mission.simulation.tracker.noise_m = 0.01;
  EXPECT_TRUE(any_note_says(mission, "safety.margin_m (0 m) is less than"));
  EXPECT_TRUE(any_note_says(mission, "safety.pair_margin_m (0 m) is less than"));
  mission.safety.margin_m = 0.05;
  EXPECT_TRUE(notes_on(mission).empty());
}

TEST(MissionNotes, Whatever_stands_between_filter_and_vehicle_is_noted_where_the_margin_leaves_it_out) {
  const auto is_noted = [](const std::function<void(SimulationSection&)>& change) {
    Mission mission = right();
    mission.safety.margin_m = 0.0;
    change(mission.simulation);
    return any_note_says(mission, "safety.margin_m (0 m) is less than");
  };
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) { simulation.link.jitter_s = 0.1; }));
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) { simulation.vehicle.acceleration_limit_m_s2 = 0.2; }));
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) { simulation.wind.gust_m_s = 1.0; }));
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) { simulation.tracker.bias_m = 1.0; }));
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) { simulation.tracker.swaps_per_h = 1.0; }));
  EXPECT_TRUE(is_noted([](SimulationSection& simulation) {
    simulation.vehicle.model = dynamics::VehicleKind::kPx4;
    simulation.vehicle.lag_s = 0.0;
  }));
}

TEST(MissionNotes, A_link_slower_than_what_waits_for_it_is_noted) {
  Mission mission = right();
  mission.simulation.link.rate_hz = 0.8;
  EXPECT_TRUE(any_note_says(mission, "Drones are heard every 1.25 s"));
  mission.simulation.vehicle.model = dynamics::VehicleKind::kPx4;
  EXPECT_TRUE(any_note_says(mission, "Orders come every 1.25 s, and the vehicle takes 1 s of silence for a lost link"));
}

TEST(MissionNotes, Links_that_are_lost_by_vehicles_without_a_failsafe_are_noted) {
  Mission mission = right();
  EXPECT_FALSE(any_note_says(mission, "has no failsafe"));
  mission.simulation.events.emplace_back().what = EventKind::kLoseLink;
  EXPECT_TRUE(any_note_says(mission, "the model `first_order_lag` has no failsafe"));
  mission.simulation.vehicle.model = dynamics::VehicleKind::kArduCopter;
  EXPECT_FALSE(any_note_says(mission, "has no failsafe"));
}

TEST(MissionNotes, A_battery_that_starts_below_the_reserve_is_noted) {
  Mission mission = right();
  mission.simulation.battery.emplace();
  EXPECT_FALSE(any_note_says(mission, "every drone lands"));
  mission.simulation.battery->start = 0.1;
  EXPECT_TRUE(any_note_says(mission, "Batteries start at 0.1, below health.battery_reserve (0.2)"));
}

TEST(MissionNotes, Positions_older_than_the_timeout_are_noted) {
  Mission mission = right();
  mission.simulation.tracker.delay_s = 0.6;
  EXPECT_TRUE(any_note_says(mission, "every drone will count as lost"));
}

TEST(MissionNotes, Targets_in_a_slit_that_nothing_can_be_seen_through_are_noted) {
  Mission mission = right();
  mission.targets = {};
  mission.targets.sigma_min_m = 0.05;
  mission.targets.clusters.emplace_back();
  mission.targets.clusters.front().name = "slit";
  mission.targets.clusters.front().points_m = {Vec2(0.0, 0.6)};
  EXPECT_FALSE(any_note_says(mission, "No target can be seen"));
  mission.no_fly = {
      {.name = "left", .outline_m = {Vec2(-1.0, 0.0), Vec2(-1e-9, 0.0), Vec2(-1e-9, 1.2), Vec2(-1.0, 1.2)}},
      {.name = "right", .outline_m = {Vec2(1e-9, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.2), Vec2(1e-9, 1.2)}}};
  EXPECT_TRUE(any_note_says(mission, "No target can be seen"));
}

TEST(MissionNotes, A_pilot_who_flies_faster_than_the_speed_limit_is_noted) {
  Mission mission = right();
  EventEntry taken_over;
  taken_over.at_s = 5.0;
  taken_over.what = EventKind::kOverride;
  taken_over.drone = "a";
  taken_over.velocity_m_s = Vec2(0.18, 0.24);
  mission.simulation.events = {taken_over};
  EXPECT_FALSE(any_note_says(mission, "a pilot flies"));
  mission.simulation.events.front().velocity_m_s = Vec2(0.3, 0.4);
  EXPECT_TRUE(any_note_says(mission, "At 5 s a pilot flies a at 0.5 m/s, above control.speed_limit_m_s (0.3 m/s)"));
}

TEST(MissionNotes, Nothing_to_look_at_and_nobody_in_the_air_are_noted) {
  Mission mission = right();
  mission.targets = {};
  mission.simulation.start = StartState::kGrounded;
  EXPECT_TRUE(any_note_says(mission, "nothing to look at"));
  EXPECT_TRUE(any_note_says(mission, "no event lets them take off"));
}

TEST(MissionNotes, The_papers_choices_that_change_its_result_are_noted) {
  Mission mission = right();
  mission.control.accounting = ergodic::Accounting::kPaperEq14;
  mission.safety.obstacles = Obstacles::kActiveOnly;
  EXPECT_TRUE(any_note_says(mission, "paper_eq14"));
  EXPECT_TRUE(any_note_says(mission, "avoided by nobody"));
}

TEST(MissionExplanation, What_the_filter_is_told_wrongly_is_noted) {
  Mission mission = right();
  EXPECT_FALSE(any_note_says(mission, "another one than the simulated one"));
  mission.safety.vehicle = AssumedVehicle::kPx4;
  EXPECT_TRUE(any_note_says(mission, "another one than the simulated one"));
  mission = right();
  mission.simulation.vehicle.command_delay_s = 0.3;
  EXPECT_FALSE(any_note_says(mission, "than what orders take"));
  mission.safety.command_delay_s = 0.1;
  EXPECT_TRUE(any_note_says(mission, "than what orders take, 0.3 s"));
  mission = right();
  mission.simulation.wind.gust_m_s = 20.0;
  EXPECT_TRUE(any_note_says(mission, "no margin makes that safe"));
}

}  // namespace
}  // namespace vigil::runtime
