#include "vigil/runtime/replayed_flight.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/runtime/live_flight.hpp"
#include "vigil/runtime/memory_recording_for_tests.hpp"

namespace vigil::runtime {
namespace {

ReplayedFlight replay_of(KeptFlight kept) { return ReplayedFlight(std::make_unique<KeptRecording>(std::move(kept))); }

/// The first difference of the whole flight.
std::optional<TickDifference> difference_in(KeptFlight kept) {
  ReplayedFlight flight = replay_of(std::move(kept));
  while (flight.step())
    if (auto difference = flight.difference()) return difference;
  return std::nullopt;
}

TEST(ReplayedFlightTest, Every_tick_comes_out_as_it_was_recorded) {
  ReplayedFlight flight = replay_of(kept_flight(400));
  std::uint64_t ticks = 0;
  for (; flight.step(); ++ticks) {
    EXPECT_TRUE(flight.is_recomputed());
    EXPECT_FALSE(flight.difference().has_value());
  }
  EXPECT_EQ(ticks, 400U);
  EXPECT_EQ(flight.number(), 400U);
}

TEST(ReplayedFlightTest, Seeking_shows_what_stepping_shows) {
  ReplayedFlight stepped = replay_of(kept_flight(700));
  ReplayedFlight sought = replay_of(kept_flight(700));
  std::vector<double> metrics;
  while (stepped.step()) metrics.push_back(stepped.snapshot().metric);
  for (const std::uint64_t number : {500U, 1U, 257U, 256U, 255U, 700U, 513U, 512U, 300U, 301U}) {
    sought.seek(number);
    EXPECT_EQ(sought.number(), number);
    EXPECT_EQ(sought.snapshot().tick, number - 1);
    EXPECT_EQ(sought.snapshot().metric, metrics[number - 1]);
    EXPECT_EQ(sought.state().ticks(), number);
    EXPECT_FALSE(sought.difference().has_value());
  }
  sought.seek(0);
  EXPECT_EQ(sought.number(), 0U);
  EXPECT_TRUE(sought.step());
  EXPECT_EQ(sought.snapshot().metric, metrics[0]);
  sought.seek(9999);
  EXPECT_EQ(sought.number(), 700U);
}

TEST(ReplayedFlightTest, One_changed_bit_of_a_velocity_is_found_with_its_tick_and_drone) {
  KeptFlight kept = kept_flight(200);
  double& y = kept.ticks[123].snapshot.drones[2].order.velocity.y();
  y = std::nextafter(y, 10.0);
  const auto difference = difference_in(std::move(kept));
  ASSERT_TRUE(difference.has_value());
  EXPECT_EQ(difference->tick, 123U);
  EXPECT_EQ(difference->time_s, 123 * 0.02);
  EXPECT_EQ(difference->drone, 2U);
  EXPECT_EQ(difference->what, "velocity asked for, y");
  EXPECT_NE(difference->recorded, difference->recomputed);
}

TEST(ReplayedFlightTest, Another_input_leads_to_another_flight) {
  KeptFlight kept = kept_flight(200);
  kept.ticks[50].observations[0].position.x() += 1e-9;
  const auto difference = difference_in(std::move(kept));
  ASSERT_TRUE(difference.has_value());
  EXPECT_GE(difference->tick, 50U);
  EXPECT_LE(difference->tick, 52U);
}

TEST(ReplayedFlightTest, A_command_that_was_left_out_is_missed) {
  KeptFlight kept = kept_flight(200);
  kept.ticks[100].commands.clear();
  const auto difference = difference_in(std::move(kept));
  ASSERT_TRUE(difference.has_value());
  EXPECT_EQ(difference->tick, 100U);
}

TEST(ReplayedFlightTest, From_a_gap_on_it_shows_what_was_recorded) {
  KeptFlight kept = kept_flight(100);
  kept.ticks.erase(kept.ticks.begin() + 40, kept.ticks.begin() + 45);
  ReplayedFlight flight = replay_of(std::move(kept));
  flight.seek(40);
  EXPECT_TRUE(flight.is_recomputed());
  flight.seek(60);
  EXPECT_FALSE(flight.is_recomputed());
  EXPECT_FALSE(flight.difference().has_value());
  EXPECT_EQ(flight.snapshot().tick, 64U);
  flight.seek(40);
  EXPECT_TRUE(flight.is_recomputed());
}

TEST(ReplayedFlightTest, Where_only_every_nth_tick_was_kept_it_shows_what_was_recorded) {
  KeptFlight kept = kept_flight(20);
  kept.head.keep_every = 2;
  for (std::size_t n = 1; n < kept.ticks.size(); ++n) kept.ticks.erase(kept.ticks.begin() + static_cast<long>(n));
  ReplayedFlight flight = replay_of(std::move(kept));
  flight.seek(5);
  EXPECT_FALSE(flight.is_recomputed());
  EXPECT_EQ(flight.snapshot().tick, 8U);
  EXPECT_EQ(flight.snapshot().drones[0].position, flight.recorded().observations[0].position);
}

TEST(ReplayedFlightTest, A_flight_that_went_on_from_an_earlier_one_is_recomputed_from_there) {
  const Mission mission = small_mission();
  KeptFlight first = kept_flight(100);
  ReplayedFlight earlier = replay_of(first);
  earlier.seek(100);
  FlightStart start{swarm::Intent::kCover, swarm::SwarmPast{}};
  earlier.state().write_past(*start.past);
  ObedientFleet fleet(starts_in_field(mission));
  KeptFlight kept;
  kept.begin(mission, start);
  LiveFlight flight(mission, fleet, &fleet, &kept, start);
  LiveFrame frame(mission.drones.size());
  Outbox<LiveEvent> outbox(1000);
  for (int n = 0; n < 50; ++n) flight.step({}, frame, outbox);
  EXPECT_EQ(kept.ticks.front().snapshot.tick, 100U);
  EXPECT_FALSE(difference_in(std::move(kept)).has_value());
}

}  // namespace
}  // namespace vigil::runtime
