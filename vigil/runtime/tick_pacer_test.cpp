#include "vigil/runtime/tick_pacer.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/lateness.hpp"

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;

TEST(TickPacerTest, Ticks_are_due_every_dt_however_many_there_were) {
  TickPacer pacer(0.02, 1s);
  for (int tick = 0; tick < 500; ++tick) {
    const auto due = 1s + tick * 20ms;
    EXPECT_EQ(pacer.next_due(), due);
    EXPECT_FALSE(pacer.is_due(due - 1ns));
    EXPECT_TRUE(pacer.is_due(due));
    EXPECT_EQ(pacer.begin_tick(due + 3us), 3us);  // lateness does not shift the schedule
  }
}

TEST(TickPacerTest, At_twenty_times_the_speed_ticks_come_twenty_times_as_often_from_now_on) {
  TickPacer pacer(0.02, 0s);
  pacer.begin_tick(0s);
  pacer.set_speed(20.0, 5ms);
  EXPECT_EQ(pacer.next_due(), 5ms);
  pacer.begin_tick(5ms);
  EXPECT_EQ(pacer.next_due(), 6ms);
}

TEST(TickPacerTest, Nothing_is_due_while_paused_and_the_pause_is_not_made_up_for) {
  TickPacer pacer(0.02, 0s);
  pacer.begin_tick(0s);
  pacer.pause();
  EXPECT_FALSE(pacer.is_due(10s));
  pacer.resume(10s);
  EXPECT_EQ(pacer.begin_tick(10s), 0s);
  EXPECT_EQ(pacer.next_due(), 10s + 20ms);
}

TEST(TickPacerTest, A_little_behind_catches_up_and_far_behind_begins_anew) {
  TickPacer pacer(0.02, 0s);
  EXPECT_EQ(pacer.begin_tick(TickPacer::kGiveUp), TickPacer::kGiveUp);
  EXPECT_EQ(pacer.next_due(), 20ms);
  EXPECT_EQ(pacer.gave_up(), 0U);
  pacer.begin_tick(20ms + TickPacer::kGiveUp + 1ns);
  EXPECT_EQ(pacer.next_due(), 40ms + TickPacer::kGiveUp + 1ns);
  EXPECT_EQ(pacer.gave_up(), 1U);
}

TEST(LatenessTest, Quantiles_are_known_to_a_bin_and_never_exceed_the_worst) {
  Lateness lateness;
  for (int us = 1; us <= 1000; ++us) lateness.add(us * 1us);
  const LatenessFigures figures = lateness.figures();
  EXPECT_EQ(figures.ticks, 1000U);
  EXPECT_GE(figures.p50_us, 500.0);
  EXPECT_LE(figures.p50_us, 500.0 * 1.0220);
  EXPECT_GE(figures.p99_us, 990.0);
  EXPECT_LE(figures.p999_us, 1000.0);
  EXPECT_EQ(figures.max_us, 1000.0);
}

TEST(LatenessTest, Two_periods_are_shown_together) {
  Lateness before;
  before.add(8ms);
  Lateness now;
  now.add(1us);
  now.add(before);
  EXPECT_EQ(now.figures().ticks, 2U);
  EXPECT_EQ(now.figures().max_us, 8000.0);
  now.clear();
  EXPECT_EQ(now.figures().ticks, 0U);
}

}  // namespace
}  // namespace vigil::runtime
