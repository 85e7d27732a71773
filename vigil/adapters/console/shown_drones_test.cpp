#include "vigil/adapters/console/shown_drones.hpp"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/frames.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Latest = ClientLine::Latest;

constexpr std::size_t kHeader = 104;

template <typename Number>
Number at(const std::string& bytes, std::size_t offset) {
  Number value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(Number));
  return value;
}

/// Drones in a row, one metre apart, of whom all are seen and cover.
runtime::LiveFrame row_of(std::size_t drones) {
  runtime::LiveFrame frame(drones);
  for (std::size_t i = 0; i < drones; ++i) {
    frame.snapshot.drones[i].position = {static_cast<double>(i), 0.0};
    frame.snapshot.drones[i].age_s = 0.0;
  }
  frame.snapshot.active = drones;
  return frame;
}

runtime::Mission grid_of(std::size_t drones) {
  return runtime::parse_mission(
      "format: 1\nname: many\nfield: {size_m: [400, 400]}\ndrone_grid: {count: " + std::to_string(drones) +
          ", spacing_m: 3}\n"
          "control: {speed_limit_m_s: 1}\nsafety: {separation_m: 1, wall_distance_m: 2}\n"
          "simulation: {duration_s: 10}\n",
      "a test");
}

TEST(ShownDronesTest, A_fleet_that_is_not_very_large_is_shown_whole) {
  const ShownDrones shown(ShownDrones::kMost);
  ASSERT_EQ(shown.size(), ShownDrones::kMost);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown.drones()[i], i);
    EXPECT_EQ(shown.place_of(i), i);
  }
}

TEST(ShownDronesTest, Of_a_larger_one_some_are_that_can_be_told_from_the_others) {
  const ShownDrones shown(50'000);
  ASSERT_EQ(shown.size(), ShownDrones::kMost);
  std::size_t hidden = 0;
  for (std::size_t drone = 0; drone < 50'000; ++drone) {
    const std::uint32_t place = shown.place_of(drone);
    if (place == ShownDrones::kNotShown)
      ++hidden;
    else
      EXPECT_EQ(shown.drones()[place], drone);
  }
  EXPECT_EQ(hidden, 40'000U);
}

TEST(ShownDronesTest, A_snapshot_has_the_places_of_those_and_the_figures_of_all) {
  runtime::LiveFrame frame = row_of(30'000);
  const ShownDrones shown(30'000);
  const std::size_t held = shown.drones()[7];
  safety::FilterReport& filter = frame.snapshot.drones[held].filter;
  const std::size_t hidden = shown.place_of(held + 1) == ShownDrones::kNotShown ? held + 1 : held - 1;
  filter.holding = {{{safety::RowKind::kNeighbour, static_cast<int>(hidden), 0.25},
                     {safety::RowKind::kNeighbour, static_cast<int>(shown.drones()[9]), 0.5}}};
  filter.holding_count = 2;
  ASSERT_EQ(shown.place_of(hidden), ShownDrones::kNotShown);
  const std::string bytes = snapshot_frame(frame, {}, {.speed_limit_m_s = 1.0}, shown);
  EXPECT_EQ(at<std::uint32_t>(bytes, 12), ShownDrones::kMost);
  EXPECT_EQ(at<std::uint32_t>(bytes, 72), 30'000U);
  for (const std::size_t place : {0U, 1U, 5'000U, 9'999U})
    EXPECT_EQ(at<float>(bytes, kHeader + 8 * place), static_cast<float>(shown.drones()[place]));
  ASSERT_EQ(at<std::uint32_t>(bytes, 88), 2U);
  const std::size_t rows = bytes.size() - 2 * 16;
  EXPECT_EQ(at<std::uint32_t>(bytes, rows), 7U);
  EXPECT_EQ(at<std::uint32_t>(bytes, rows + 8), ShownDrones::kNotShown);
  EXPECT_EQ(at<std::uint32_t>(bytes, rows + 24), 9U);
}

TEST(ShownDronesTest, A_client_is_told_of_as_many_as_it_is_shown_and_how_many_there_are) {
  ConsoleForTests console;
  console.most_drones = 20'000;
  console.desk.begin(grid_of(11'000), nullptr);
  const ConsoleForTests::Visitor ana = console.join();
  console.pass(40ms);
  const Json mission = ana.line->of("mission").front();
  EXPECT_EQ(mission.at("display").at("drones"), 11'000);
  EXPECT_EQ(mission.at("mission").at("drones").size(), ShownDrones::kMost);
  EXPECT_EQ(at<std::uint32_t>(*ana.line->shown.at(Latest::kSnapshot), 12), ShownDrones::kMost);
  // A drone that is not shown is ordered by its id like any other.
  const ShownDrones shown(11'000);
  std::size_t hidden = 0;
  while (shown.place_of(hidden) != ShownDrones::kNotShown) ++hidden;
  const std::string id = console.flight->mission().drones[hidden].id;
  EXPECT_EQ(console.ask(ana, {{"type", "hold"}, {"id", 1}, {"drones", {id}}}).at("type"), "ack");
}

TEST(ShownDronesTest, Large_snapshots_come_less_often) {
  ConsoleForTests console;
  console.most_drones = 20'000;
  console.desk.begin(grid_of(10'000), nullptr);
  const ConsoleForTests::Visitor ana = console.join();
  console.pass(100ms);
  const int before = ana.line->shows[Latest::kSnapshot];
  console.pass(1s);
  const auto bytes = static_cast<double>(ana.line->shown.at(Latest::kSnapshot)->size());
  EXPECT_NEAR(ana.line->shows[Latest::kSnapshot] - before, 4e6 / bytes, 2.0);
}

TEST(ShownDronesTest, Of_events_that_come_by_the_thousand_some_are_told_and_how_many_more_there_were) {
  ConsoleForTests console;
  console.most_drones = 5'000;
  console.desk.begin(grid_of(5'000), nullptr);
  console.pass(2s);
  const ConsoleForTests::Visitor ana = console.join();
  const std::size_t before = ana.line->said.size();
  console.ask(ana, {{"type", "land_all"}, {"id", 1}});
  console.pass(100ms);
  std::size_t told = 0;
  for (std::size_t n = before; n < ana.line->said.size(); ++n)
    if (ana.line->said[n].at("type") == "events") told += ana.line->said[n].at("events").size();
  EXPECT_LT(told, 2'500U);
  const Json untold = ana.line->event("untold");
  ASSERT_FALSE(untold.is_null());
  EXPECT_NE(untold.at("text").get<std::string>().find("more events of single drones"), std::string::npos);
}

}  // namespace
}  // namespace vigil::console
