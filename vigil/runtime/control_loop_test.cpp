#include "vigil/runtime/control_loop.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;
using swarm::Activity;
using swarm::CommandKind;

LiveCommand wish(CommandKind kind, std::optional<std::size_t> drone, std::uint64_t ticket) {
  LiveCommand command;
  command.swarm.kind = kind;
  if (drone) command.swarm.drone = swarm::DroneId(*drone);
  command.ticket = ticket;
  return command;
}

LiveCommand clock(LiveCommand::Kind kind, std::uint64_t ticket, double speed = 1.0) {
  LiveCommand command;
  command.kind = kind;
  command.speed = speed;
  command.ticket = ticket;
  return command;
}

/// A live flight under a clock that only the test turns.
class ControlLoopTest : public ::testing::Test {
 protected:
  explicit ControlLoopTest(const std::string& more = "")
      : mission(small_mission(more)), fleet(starts_in_field(mission)) {
    LiveCommand target;
    target.swarm.kind = CommandKind::kSetTarget;
    target.swarm.target = coverage_target(mission, flight.state().basis());
    target.revision = 7;
    EXPECT_TRUE(loop.submit({target}));
    loop.begin(now);
  }

  /// Lets time pass up to `until`, calling the loop when it asks to be called.
  void run_until(ControlLoop::Time until) {
    while (now <= until) {
      const ControlLoop::Time next = loop.turn(now);
      for (const LiveEvent& event : loop.take_events()) events.push_back(event);
      EXPECT_GT(next, now - 1ns);
      now = std::max(next, now + 1us);
    }
    now = until;
  }
  LiveFrame frame() {
    LiveFrame newest(3);
    std::size_t version = 0;
    EXPECT_TRUE(loop.read(newest, version));
    return newest;
  }
  ClockState clock_state() {
    ClockState newest;
    std::size_t version = 0;
    EXPECT_TRUE(loop.read(newest, version));
    return newest;
  }
  std::vector<LiveEvent> answers() const {
    std::vector<LiveEvent> found;
    for (const LiveEvent& event : events)
      if (event.kind == LiveEvent::Kind::kAnswer) found.push_back(event);
    return found;
  }

  Mission mission;
  ObedientFleet fleet;
  LiveFlight flight{mission, fleet, &fleet, nullptr, {swarm::Intent::kCover, {}}};
  ControlLoop loop{flight, 3};
  ControlLoop::Time now = 5s;
  std::vector<LiveEvent> events;
};

TEST_F(ControlLoopTest, It_flies_in_real_time_and_shows_where_it_is) {
  run_until(7s);
  const LiveFrame newest = frame();
  EXPECT_EQ(newest.snapshot.tick, 100U);
  EXPECT_EQ(newest.snapshot.active, 3U);
  EXPECT_EQ(newest.revision, 7U);
  EXPECT_EQ(newest.computed_at, 7s);
  EXPECT_GT(newest.past.coverage.time_s, 0.0);
  EXPECT_LT(clock_state().lateness.max_us, 2.0);
}

TEST_F(ControlLoopTest, A_command_takes_effect_at_the_next_tick_and_is_answered) {
  run_until(5s + 30ms);
  ASSERT_TRUE(loop.submit({wish(CommandKind::kHold, 1, 11)}));
  run_until(5s + 40ms);
  EXPECT_EQ(frame().snapshot.drones[1].activity, Activity::kHeld);
  ASSERT_EQ(answers().size(), 1U);
  EXPECT_EQ(answers()[0].ticket, 11U);
  EXPECT_EQ(answers()[0].tick, 2U);
  EXPECT_EQ(answers()[0].accepted, 1U);
}

TEST_F(ControlLoopTest, Who_cannot_follow_is_told_by_drone_and_the_rest_follow) {
  run_until(5s + 30ms);
  ASSERT_TRUE(loop.submit({wish(CommandKind::kLand, 0, 1)}));
  run_until(5s + 90ms);
  events.clear();
  ASSERT_TRUE(loop.submit({wish(CommandKind::kLand, {}, 2)}));
  run_until(5s + 110ms);
  ASSERT_EQ(answers().size(), 1U);
  EXPECT_EQ(answers()[0].accepted, 2U);
  EXPECT_EQ(answers()[0].refused, 1U);
  const auto refusal = std::find_if(events.begin(), events.end(),
                                    [](const LiveEvent& event) { return event.kind == LiveEvent::Kind::kRefusal; });
  ASSERT_NE(refusal, events.end());
  EXPECT_EQ(refusal->ticket, 2U);
  EXPECT_EQ(refusal->event.drone.index(), 0U);
}

TEST_F(ControlLoopTest, Activity_changes_are_told_with_the_drone_that_they_are_about) {
  run_until(5s);
  std::size_t covering = 0;
  for (const LiveEvent& event : events)
    if (event.kind == LiveEvent::Kind::kSwarm && event.event.after == Activity::kActive) {
      EXPECT_EQ(event.drone.activity, Activity::kActive);
      EXPECT_EQ(event.active, 3U);
      ++covering;
    }
  EXPECT_EQ(covering, 3U);
}

TEST_F(ControlLoopTest, A_pause_stops_the_world_and_what_was_wished_meanwhile_happens_afterwards) {
  run_until(6s);
  const std::uint64_t tick = frame().snapshot.tick;
  ASSERT_TRUE(loop.submit({clock(LiveCommand::Kind::kPause, 1)}));
  ASSERT_TRUE(loop.submit({wish(CommandKind::kHold, 0, 2)}));
  run_until(16s);
  EXPECT_EQ(frame().snapshot.tick, tick);
  EXPECT_TRUE(clock_state().is_paused);
  ASSERT_EQ(answers().size(), 1U);  // the clock's
  ASSERT_TRUE(loop.submit({clock(LiveCommand::Kind::kResumeClock, 3)}));
  run_until(16s + 10ms);
  EXPECT_EQ(frame().snapshot.tick, tick + 1);
  EXPECT_EQ(frame().snapshot.drones[0].activity, Activity::kHeld);
  EXPECT_EQ(answers().size(), 3U);
  EXPECT_LT(clock_state().lateness.max_us, 10'001.0);  // nobody was late during the pause
}

TEST_F(ControlLoopTest, Twenty_times_the_speed_is_twenty_times_the_ticks) {
  ASSERT_TRUE(loop.submit({clock(LiveCommand::Kind::kSetSpeed, 1, 20.0)}));
  run_until(6s);
  EXPECT_EQ(frame().snapshot.tick, 1000U);
  EXPECT_EQ(clock_state().speed, 20.0);
}

TEST_F(ControlLoopTest, Lateness_is_measured_and_a_long_stop_is_not_hurried_after) {
  run_until(6s);
  const std::uint64_t tick = frame().snapshot.tick;
  now += 30ms;  // somebody else had the processor
  run_until(now + 600ms);
  EXPECT_GT(clock_state().lateness.max_us, 9'000.0);
  const std::uint64_t later = frame().snapshot.tick;
  EXPECT_NEAR(static_cast<double>(later - tick), 31.5, 1.0);
  now += 10s;
  run_until(now + 100ms);
  EXPECT_LE(frame().snapshot.tick - later, 6U);
}

TEST_F(ControlLoopTest,
       A_late_tick_is_remembered_for_twenty_seconds_in_the_newest_figures_and_for_ever_in_the_flights) {
  run_until(6s);
  now += 30ms;
  run_until(now + 40s);
  const ClockState state = clock_state();
  EXPECT_LT(state.lateness.max_us, 2.0);
  EXPECT_GT(state.lateness_ever.max_us, 9'000.0);
  EXPECT_GE(state.lateness.ticks, 500U);
  EXPECT_LE(state.lateness.ticks, 1000U);
  EXPECT_NEAR(static_cast<double>(state.lateness_ever.ticks), 50.0 * 41.0, 40.0);
  EXPECT_LT(state.lateness_ever.p999_us, 2.0);
}

TEST_F(ControlLoopTest, More_commands_than_a_tick_can_answer_wait_for_the_next) {
  run_until(5s + 10ms);
  for (std::uint64_t ticket = 1; ticket <= 20; ++ticket)
    ASSERT_TRUE(loop.submit({wish(ticket % 2 == 0 ? CommandKind::kResume : CommandKind::kHold, {}, ticket)}));
  run_until(5s + 90ms);
  ASSERT_EQ(answers().size(), 20U);
  for (std::size_t n = 0; n < 20; ++n) {
    EXPECT_EQ(answers()[n].ticket, n + 1);
    EXPECT_EQ(answers()[n].accepted, 3U) << n;
  }
  EXPECT_GT(answers().back().tick, answers().front().tick);
  EXPECT_EQ(loop.lost_events(), 0U);
}

TEST_F(ControlLoopTest, The_state_is_handed_over_as_it_is_without_allocating) {
  run_until(now + 1s);
  EXPECT_FALSE(loop.take_state());
  for (const bool is_ticking : {true, false}) {
    if (!is_ticking) {
      EXPECT_TRUE(loop.submit({clock(LiveCommand::Kind::kPause, 0)}));
    }
    loop.ask_state();
    const testing::AllocationGuard guard;
    now = std::max(loop.turn(now), now + 1us);
    EXPECT_EQ(guard.allocations(), 0U);
    const std::optional<swarm::SwarmState> state = loop.take_state();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->ticks(), flight.state().ticks());
    EXPECT_EQ(state->next_motion(swarm::DroneId(1)).position, flight.state().next_motion(swarm::DroneId(1)).position);
  }
}

TEST_F(ControlLoopTest, A_flood_is_refused_and_not_queued_without_end) {
  std::size_t taken = 0;
  while (taken < 10'000 && loop.submit({wish(CommandKind::kHold, 0, taken + 1)})) ++taken;
  EXPECT_LT(taken, 1000U);
  run_until(6s);
  EXPECT_EQ(answers().size(), taken);
}

class ScriptedLoopTest : public ControlLoopTest {
 protected:
  ScriptedLoopTest()
      : ControlLoopTest(
            "simulation:\n  duration_s: 5\n  events:\n    - {at_s: 1, do: land, drone: b}\n"
            "    - {at_s: 2, do: add_target, cluster: east, point_m: [1.0, 11.0]}\n") {}
};

TEST_F(ScriptedLoopTest, The_missions_events_play_and_the_flight_does_not_end) {
  run_until(13s);
  EXPECT_EQ(frame().snapshot.tick, 400U);  // long after duration_s
  EXPECT_EQ(frame().snapshot.drones[1].activity, Activity::kGrounded);
  std::vector<std::size_t> played;
  for (const LiveEvent& event : events)
    if (event.kind == LiveEvent::Kind::kScript) played.push_back(event.index);
  EXPECT_EQ(played, (std::vector<std::size_t>{0, 1}));
}

TEST_F(ScriptedLoopTest, A_restarted_flight_goes_on_in_time_and_coverage_and_plays_no_event_twice) {
  run_until(5s + 1500ms);
  const LiveFrame before = frame();
  ObedientFleet again(starts_in_field(mission));
  LiveFlight second(mission, again, &again, nullptr, {swarm::Intent::kHold, before.past});
  Outbox<LiveEvent> outbox(100);
  LiveFrame after(3);
  second.step({}, after, outbox);
  outbox.send();
  EXPECT_EQ(after.snapshot.tick, before.snapshot.tick + 1);
  EXPECT_EQ(after.past.coverage.sum, before.past.coverage.sum);
  for (const swarm::DroneSnapshot& drone : after.snapshot.drones) EXPECT_EQ(drone.activity, Activity::kHeld);
  for (const LiveEvent& event : outbox.take()) EXPECT_NE(event.kind, LiveEvent::Kind::kScript);
}

}  // namespace
}  // namespace vigil::runtime
