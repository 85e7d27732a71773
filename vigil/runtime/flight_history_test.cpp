#include "vigil/runtime/flight_history.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

/// Drones in a row in the air, a metre apart, all asked for 0.1 m/s.
swarm::Snapshot in_a_row(std::size_t drones, double time_s) {
  swarm::Snapshot snapshot(drones);
  snapshot.time_s = time_s;
  snapshot.has_metric = true;
  snapshot.metric_percent = 100.0 - time_s;
  snapshot.active = drones;
  for (std::size_t i = 0; i < drones; ++i) {
    swarm::DroneSnapshot& drone = snapshot.drones[i];
    drone.activity = swarm::Activity::kActive;
    drone.mode = swarm::VehicleMode::kFlying;
    drone.position = {static_cast<double>(i), 0.0};
    drone.order = {swarm::Action::kVelocity, {0.1, 0.0}};
  }
  return snapshot;
}

float value_of(const FlightHistory& history, std::size_t row, std::size_t column) {
  return history.rows()[row].values.at(column);
}

TEST(FlightHistoryTest, A_row_has_what_the_plots_show_of_the_swarm_of_each_drone_and_of_each_pair) {
  FlightHistory history(3);
  swarm::Snapshot snapshot = in_a_row(3, 2.0);
  snapshot.drones[2].order.velocity = {0.0, 0.3};
  snapshot.drones[1].mode = swarm::VehicleMode::kGrounded;
  history.add(snapshot, 7.0);
  ASSERT_EQ(history.rows().size(), 1U);
  ASSERT_EQ(history.columns(), 11U);
  const std::vector<float> wanted{98.0F, 7.0F, 2.0F, 3.0F, 0.3F, 0.1F, 0.1F, 0.3F};
  for (std::size_t column = 0; column < wanted.size(); ++column)
    EXPECT_FLOAT_EQ(value_of(history, 0, column), wanted[column]) << column;
  EXPECT_TRUE(std::isnan(value_of(history, 0, 8)));  // of the pairs 1-2 and 2-3 one is on the ground
  EXPECT_FLOAT_EQ(value_of(history, 0, 9), 2.0F);
  EXPECT_TRUE(std::isnan(value_of(history, 0, 10)));
}

TEST(FlightHistoryTest, Swarms_that_are_too_large_for_that_are_shown_as_a_whole) {
  FlightHistory history(FlightHistory::kMostPlotted + 1);
  swarm::Snapshot snapshot = in_a_row(FlightHistory::kMostPlotted + 1, 0.0);
  snapshot.has_metric = false;
  history.add(snapshot, std::nan(""));
  EXPECT_EQ(history.plotted(), 0U);
  EXPECT_EQ(history.columns(), FlightHistory::kOfSwarm);
  EXPECT_TRUE(std::isnan(value_of(history, 0, 0)));
  EXPECT_TRUE(std::isnan(value_of(history, 0, 1)));
}

TEST(FlightHistoryTest, Moments_are_taken_in_ten_times_a_second_and_none_twice) {
  FlightHistory history(2);
  for (int tick = 0; tick < 100; ++tick) history.add(in_a_row(2, 0.02 * tick), 0.0);
  EXPECT_EQ(history.rows().size(), 20U);
  history.add(in_a_row(2, 1.0), 0.0);
  EXPECT_EQ(history.rows().size(), 20U);
}

TEST(FlightHistoryTest, However_long_a_flight_is_it_reaches_from_its_beginning_to_now_with_every_extreme) {
  constexpr int kMoments = 50'000;
  FlightHistory history(2);
  for (int n = 0; n < kMoments; ++n) {
    swarm::Snapshot snapshot = in_a_row(2, FlightHistory::kSpacingS * n);
    if (n == 12'345) snapshot.drones[1].position = {0.25, 0.0};
    if (n == 23'456) snapshot.drones[0].order.velocity = {0.0, 0.5};
    history.add(snapshot, n == 34'567 ? 60.0 : 5.0);
  }
  const auto rows = history.rows();
  EXPECT_LE(rows.size(), FlightHistory::kMostRows);
  EXPECT_GT(rows.size(), FlightHistory::kMostRows / 2);
  EXPECT_EQ(rows.front().begin_s, 0.0);
  EXPECT_DOUBLE_EQ(rows.back().time_s, FlightHistory::kSpacingS * (kMoments - 1));
  const auto row_at = [&](int moment) {
    const double time_s = FlightHistory::kSpacingS * moment;
    return std::ranges::find_if(rows, [&](const auto& row) { return time_s <= row.time_s + 1e-9; });
  };
  const std::size_t pair = FlightHistory::kOfSwarm + 2;
  EXPECT_FLOAT_EQ(row_at(12'345)->values.at(2), 0.25F);
  EXPECT_FLOAT_EQ(row_at(12'345)->values.at(pair), 0.25F);
  EXPECT_FLOAT_EQ(row_at(23'456)->values.at(4), 0.5F);
  EXPECT_FLOAT_EQ(row_at(34'567)->values.at(1), 60.0F);
  for (const FlightHistory::Row& row : rows) {
    EXPECT_LE(row.begin_s, row.time_s);
    EXPECT_FLOAT_EQ(row.values.at(0), static_cast<float>(100.0 - row.time_s));  // the metric is the newest
  }
}

TEST(FlightHistoryTest, What_was_until_a_moment_goes_on_from_there) {
  FlightHistory history(2);
  for (int n = 0; n < 100; ++n) history.add(in_a_row(2, 0.1 * n), 0.0);
  FlightHistory before = history.until(3.0);
  EXPECT_EQ(before.rows().size(), 31U);
  EXPECT_DOUBLE_EQ(before.rows().back().time_s, 3.0);
  before.add(in_a_row(2, 3.1), 0.0);
  EXPECT_EQ(before.rows().size(), 32U);
  EXPECT_EQ(history.until(-1.0).rows().size(), 0U);
  EXPECT_EQ(history.until(1e9).rows().size(), 100U);
}

}  // namespace
}  // namespace vigil::runtime
