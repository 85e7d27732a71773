#include "vigil/runtime/recording_playback.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "vigil/runtime/memory_recording_for_tests.hpp"

namespace vigil::runtime {
namespace {

constexpr std::uint64_t kTicks = 100;

/// A flight of whose pairs one, at one tick, is far nearer than ever else.
KeptFlight flight_with_a_close_pair(std::uint64_t at) {
  KeptFlight kept = kept_flight(kTicks);
  kept.ticks[at].clearances.airborne_pair_m = 0.001;
  kept.ticks[at].snapshot.fallback = true;
  return kept;
}

RecordedFlight collected(KeptFlight kept, std::size_t most_ticks) {
  const Mission mission = small_mission();
  KeptRecording recording(std::move(kept));
  return collect(recording, mission, most_ticks * mission.drones.size());
}

TEST(Collect, A_flight_that_is_not_too_long_is_whole) {
  const RecordedFlight flight = collected(kept_flight(kTicks), kTicks);
  EXPECT_EQ(flight.every, 1U);
  EXPECT_EQ(flight.tick_count(), kTicks);
  EXPECT_EQ(flight.rows.position_m.size(), kTicks * flight.drones.size());
}

TEST(Collect, Of_one_that_is_too_long_every_so_manieth_tick_is_kept_and_the_last) {
  const RecordedFlight whole = collected(kept_flight(kTicks), kTicks);
  const RecordedFlight thinned = collected(kept_flight(kTicks), kTicks - 1);
  EXPECT_EQ(thinned.every, 2U);
  ASSERT_EQ(thinned.tick_count(), kTicks / 2 + 1);
  for (std::size_t tick = 0; tick + 1 < thinned.tick_count(); ++tick) {
    EXPECT_EQ(thinned.ticks.time_s[tick], whole.ticks.time_s[2 * tick]);
    EXPECT_EQ(thinned.rows.position_m[thinned.row(tick, 1)], whole.rows.position_m[whole.row(2 * tick, 1)]);
  }
  EXPECT_EQ(thinned.ticks.time_s.back(), whole.ticks.time_s.back());
}

TEST(Collect, What_a_tick_that_is_left_out_says_of_safety_is_kept_with_the_next) {
  for (const std::uint64_t at : {0U, 1U, 6U, 7U, 98U, 99U}) {
    const RecordedFlight flight = collected(flight_with_a_close_pair(at), 10);
    const auto is_close = [](const Clearances& clearances) { return clearances.airborne_pair_m == 0.001; };
    const auto& clearances = flight.ticks.clearances;
    EXPECT_EQ(std::count_if(clearances.begin(), clearances.end(), is_close), 1) << at;
    const auto found = std::find_if(clearances.begin(), clearances.end(), is_close) - clearances.begin();
    EXPECT_EQ(static_cast<std::uint64_t>(found), (at + 9) / 10) << at;
    EXPECT_EQ(flight.ticks.fallback[static_cast<std::size_t>(found)], 1) << at;
  }
}

TEST(Collect, However_little_may_be_kept_the_first_and_the_last_tick_are) {
  const RecordedFlight flight = collected(kept_flight(kTicks), 0);
  EXPECT_EQ(flight.tick_count(), 2U);
}

}  // namespace
}  // namespace vigil::runtime
