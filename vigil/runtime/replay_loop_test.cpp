#include "vigil/runtime/replay_loop.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/memory_recording_for_tests.hpp"

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kTicks = 700;

/// A recording of the small mission's first ticks, at 50 Hz, in a clock that only the test turns.
class ReplayLoopTest : public ::testing::Test {
 protected:
  [[nodiscard]] static std::unique_ptr<FlightRecording> open() {
    static const KeptFlight kKept = kept_flight(kTicks);
    return std::make_unique<KeptRecording>(kKept);
  }

  void order(LiveCommand::Kind kind, double value = 0.0) {
    LiveCommand command;
    command.kind = kind;
    command.speed = value;
    command.seek_s = value;
    command.steps = static_cast<std::int64_t>(value);
    command.ticket = ++ticket;
    ASSERT_TRUE(loop.submit({command}));
  }
  void pass(std::chrono::nanoseconds time) {
    for (const auto until = now + time; now < until; now += 10ms) loop.turn(now);
    loop.turn(now);
  }
  void arrive() {
    do pass(10ms);
    while (loop.is_seeking());
  }
  [[nodiscard]] LiveFrame shown() {
    LiveFrame frame(mission.drones.size());
    std::size_t version = 0;
    EXPECT_TRUE(loop.read(frame, version));
    return frame;
  }
  [[nodiscard]] ClockState clock() {
    ClockState state;
    std::size_t version = 0;
    EXPECT_TRUE(loop.read(state, version));
    return state;
  }

  std::chrono::nanoseconds now{1000s};
  std::uint64_t ticket = 0;
  Mission mission = small_mission("simulation: {events: [{at_s: 2, do: land, drone: b}]}\n");
  ReplayLoop loop{mission, open, 1};
};

TEST_F(ReplayLoopTest, A_recording_stands_at_its_first_tick_until_somebody_lets_it_go_on) {
  pass(5s);
  EXPECT_EQ(shown().snapshot.tick, 0U);
  EXPECT_TRUE(clock().is_paused);
  EXPECT_TRUE(loop.is_recording());
}

TEST_F(ReplayLoopTest, It_plays_as_fast_as_the_flight_was_times_the_speed) {
  order(LiveCommand::Kind::kResumeClock);
  pass(2s);
  EXPECT_NEAR(shown().snapshot.time_s, 2.0, 0.02 + 1e-9);
  order(LiveCommand::Kind::kSetSpeed, 0.1);
  pass(10s);
  EXPECT_NEAR(shown().snapshot.time_s, 3.0, 0.04 + 1e-9);
  EXPECT_EQ(clock().speed, 0.1);
  order(LiveCommand::Kind::kSetSpeed, 100.0);
  pass(50ms);
  EXPECT_NEAR(shown().snapshot.time_s, 8.0, 0.06 + 1e-9);
}

TEST_F(ReplayLoopTest, It_stops_at_its_end_and_begins_anew_from_there) {
  order(LiveCommand::Kind::kSetSpeed, 100.0);
  order(LiveCommand::Kind::kResumeClock);
  pass(1s);
  EXPECT_EQ(shown().snapshot.tick, kTicks - 1);
  EXPECT_TRUE(clock().is_paused);
  EXPECT_TRUE(loop.is_at_end());
  order(LiveCommand::Kind::kSetSpeed, 1.0);
  order(LiveCommand::Kind::kResumeClock);
  pass(20ms);
  EXPECT_LE(shown().snapshot.tick, 2U);
  EXPECT_FALSE(clock().is_paused);
}

TEST_F(ReplayLoopTest, Seeking_shows_the_last_tick_at_that_time_or_before) {
  for (const double time_s : {12.03, 0.5, 13.98, 5.13, 5.12}) {
    order(LiveCommand::Kind::kSeek, time_s);
    arrive();
    EXPECT_LE(shown().snapshot.time_s, time_s + 1e-9);
    EXPECT_GT(shown().snapshot.time_s, time_s - 0.02 - 1e-9);
  }
  order(LiveCommand::Kind::kSeek, -5.0);
  arrive();
  EXPECT_EQ(shown().snapshot.tick, 0U);
  order(LiveCommand::Kind::kSeek, 1e9);
  arrive();
  EXPECT_EQ(shown().snapshot.tick, kTicks - 1);
}

TEST_F(ReplayLoopTest, From_its_end_it_goes_back_to_any_moment_also_before_it_has_come_to_the_end) {
  for (const double time_s : {12.34, 0.0, 3.0, 13.98, 7.5}) {
    order(LiveCommand::Kind::kSeek, time_s);
    arrive();
    EXPECT_NEAR(shown().snapshot.time_s, time_s, 1e-9);
    EXPECT_FALSE(loop.is_seeking());
  }
  for (const double time_s : {0.0, 13.98, 7.5}) order(LiveCommand::Kind::kSeek, time_s);
  arrive();
  EXPECT_NEAR(shown().snapshot.time_s, 7.5, 1e-9);
  order(LiveCommand::Kind::kSeek, 13.98);
  loop.turn(now);
  order(LiveCommand::Kind::kSeek, 7.5);
  arrive();
  EXPECT_NEAR(shown().snapshot.time_s, 7.5, 1e-9);
}

TEST_F(ReplayLoopTest, On_its_way_it_knows_which_share_of_it_is_behind) {
  pass(10ms);
  EXPECT_EQ(loop.progress(), 1.0);
  order(LiveCommand::Kind::kSeek, 13.98);
  loop.turn(now);
  const double goal = kTicks;
  while (loop.is_seeking()) {
    // The way began at the first tick, and one step of it shows where it began.
    EXPECT_NEAR(loop.progress(), (static_cast<double>(loop.scene().flight().number()) - 1.0) / (goal - 1.0),
                2.0 / goal);
    loop.turn(now);
  }
  EXPECT_EQ(loop.progress(), 1.0);
}

TEST_F(ReplayLoopTest, A_step_is_one_tick_on_or_back_and_stands_still_there) {
  order(LiveCommand::Kind::kResumeClock);
  pass(1s);
  const std::uint64_t before = shown().snapshot.tick;
  order(LiveCommand::Kind::kStep, 1);
  pass(1s);
  EXPECT_NEAR(static_cast<double>(shown().snapshot.tick), static_cast<double>(before + 1), 1.0);
  const std::uint64_t here = shown().snapshot.tick;
  order(LiveCommand::Kind::kStep, -3);
  pass(1s);
  EXPECT_EQ(shown().snapshot.tick, here - 3);
  order(LiveCommand::Kind::kStep, -1e6);
  arrive();
  EXPECT_EQ(shown().snapshot.tick, 0U);
}

TEST_F(ReplayLoopTest, What_is_shown_of_a_tick_does_not_depend_on_the_way_to_it) {
  ReplayScene stepped(mission, open);
  while (stepped.flight().number() < 600) ASSERT_TRUE(stepped.step());
  LiveFrame expected(mission.drones.size());
  stepped.write(expected);
  for (const double time_s : {13.0, 1.0, 11.98}) {
    order(LiveCommand::Kind::kSeek, time_s);
    arrive();
  }
  const LiveFrame frame = shown();
  ASSERT_EQ(frame.snapshot.tick, 599U);
  EXPECT_EQ(frame.snapshot.metric, expected.snapshot.metric);
  EXPECT_TRUE((frame.c_k.array() == expected.c_k.array()).all());
  const auto seen = loop.scene().ground().seen().seen_s();
  const auto seen_by_steps = stepped.ground().seen().seen_s();
  EXPECT_TRUE(std::equal(seen.begin(), seen.end(), seen_by_steps.begin(), seen_by_steps.end()));
}

TEST_F(ReplayLoopTest, What_is_recalled_ends_with_the_tick_that_is_shown) {
  order(LiveCommand::Kind::kSeek, 10.0);
  arrive();
  std::vector<std::uint64_t> ticks;
  loop.scene().recall(4.0, 50, [&](const swarm::Snapshot& snapshot) { ticks.push_back(snapshot.tick); });
  ASSERT_FALSE(ticks.empty());
  EXPECT_LE(ticks.size(), 50U);
  EXPECT_GE(ticks.size(), 25U);
  EXPECT_EQ(ticks.back(), shown().snapshot.tick);
  EXPECT_GE(ticks.front(), 200U);
}

TEST_F(ReplayLoopTest, What_plots_show_is_the_same_whatever_way_led_there) {
  order(LiveCommand::Kind::kSeek, 12.0);
  arrive();
  const FlightHistory at_once = loop.scene().history().until(9.0);
  order(LiveCommand::Kind::kSeek, 3.0);
  arrive();
  ASSERT_EQ(loop.scene().history().until(loop.scene().time_s()).rows().size(), 31U);
  order(LiveCommand::Kind::kSeek, 9.0);
  arrive();
  const FlightHistory again = loop.scene().history().until(loop.scene().time_s());
  ReplayLoop played{mission, open, 1};
  while (played.scene().time_s() < 9.0 - 1e-9) ASSERT_TRUE(played.scene().step());
  for (const FlightHistory* history : {&at_once, &again}) {
    ASSERT_EQ(history->rows().size(), played.scene().history().rows().size());
    for (std::size_t row = 0; row < history->rows().size(); ++row) {
      EXPECT_EQ(history->rows()[row].time_s, played.scene().history().rows()[row].time_s);
      for (std::size_t column = 0; column < history->columns(); ++column) {
        const float value = history->rows()[row].values.at(column);
        const float wanted = played.scene().history().rows()[row].values.at(column);
        EXPECT_TRUE(value == wanted || (std::isnan(value) && std::isnan(wanted))) << row << " " << column;
      }
    }
  }
}

TEST_F(ReplayLoopTest, Every_command_is_answered_with_the_tick_that_it_led_to) {
  order(LiveCommand::Kind::kSeek, 1.0);
  pass(10ms);
  const std::vector<LiveEvent> events = loop.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, LiveEvent::Kind::kAnswer);
  EXPECT_EQ(events[0].ticket, ticket);
  EXPECT_EQ(events[0].tick, 50U);
}

TEST(ReplaySceneTest, A_recording_of_another_swarm_is_refused) {
  const auto open = [] { return std::make_unique<KeptRecording>(kept_flight(3)); };
  Mission other = small_mission();
  other.drones.pop_back();
  EXPECT_THROW(ReplayScene(other, open), std::runtime_error);
  const auto open_empty = [] { return std::make_unique<KeptRecording>(kept_flight(0)); };
  EXPECT_THROW(ReplayScene(small_mission(), open_empty), std::runtime_error);
}

}  // namespace
}  // namespace vigil::runtime
