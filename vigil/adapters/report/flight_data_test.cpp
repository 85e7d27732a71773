#include "vigil/adapters/report/flight_data.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "vigil/adapters/report/distances.hpp"
#include "vigil/adapters/report/report_error.hpp"
#include "vigil/adapters/report/sample_flight.hpp"

namespace vigil::report {
namespace {

TEST(FlightData, Places_are_measured_from_the_fields_corner) {
  const runtime::RecordedFlight flight = sample_flight();
  const runtime::Mission mission = sample_mission();
  const FlightData data = prepare(flight, mission);
  EXPECT_LT((data.positions[0] - flight.rows.true_position_m[0] - Vec2(1.5, 1.5)).norm(), 1e-12);
}

TEST(FlightData, Without_ground_truth_the_believed_places_are_used) {
  runtime::RecordedFlight flight = sample_flight();
  const Vec2 unknown = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  std::fill(flight.rows.true_position_m.begin(), flight.rows.true_position_m.end(), unknown);
  flight.rows.position_m[0] = {0.25, 0.5};
  const runtime::Mission mission = sample_mission();
  const FlightData data = prepare(flight, mission);
  EXPECT_FALSE(data.has_truth);
  EXPECT_LT((data.positions[0] - Vec2(1.75, 2.0)).norm(), 1e-12);
}

TEST(FlightData, A_drone_that_lands_is_the_first_loss) {
  const runtime::RecordedFlight flight = sample_flight();
  const runtime::Mission mission = sample_mission();
  const FlightData data = prepare(flight, mission);
  ASSERT_EQ(data.changes.size(), 1U);
  ASSERT_NE(data.first_loss(), nullptr);
  EXPECT_EQ(data.time_s(data.first_loss()->tick), 23.0);
  EXPECT_EQ(data.describe(*data.first_loss()), "cf2 landing");
}

TEST(FlightData, A_recording_of_other_drones_is_refused) {
  const runtime::RecordedFlight flight = sample_flight();
  runtime::Mission mission = sample_mission();
  mission.drones[1].id = "other";
  EXPECT_THROW((void)prepare(flight, mission), ReportError);
}

TEST(Distances, The_least_to_a_nearest_neighbour_is_the_least_of_all_pairs) {
  const SampleOptions options{.drones = 7};
  const runtime::RecordedFlight flight = sample_flight(options);
  const runtime::Mission mission = sample_mission(options);
  const FlightData data = prepare(flight, mission);
  for (const NearestDistances& d : nearest_distances(data)) {
    EXPECT_NEAR(d.least_m, sample_nearest(flight, d.tick), 1e-9);
    EXPECT_LE(d.least_m, d.low_m);
    EXPECT_LE(d.low_m, d.median_m);
    EXPECT_LE(d.median_m, d.high_m);
  }
}

TEST(Distances, Neighbours_that_are_looked_for_in_a_grid_are_the_nearest_of_all) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1.6, 1.6);  // also beyond the border
  SampleOptions options{.drones = 60, .duration_s = 1.0};
  runtime::RecordedFlight flight = sample_flight(options);
  for (Vec2& place : flight.rows.true_position_m) place = {anywhere(random), anywhere(random)};
  for (std::size_t i = 0; i < options.drones; i += 5) {
    flight.rows.activity[flight.row(6, i)] = swarm::Activity::kGrounded;
    flight.rows.mode[flight.row(6, i)] = swarm::VehicleMode::kGrounded;
  }
  const runtime::Mission mission = sample_mission(options);
  const FlightData data = prepare(flight, mission);

  for (const NearestDistances& d : nearest_distances(data))
    EXPECT_NEAR(d.least_m, sample_nearest(flight, d.tick), 1e-12);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < options.drones; i += 5)
    for (std::size_t j = 0; j < options.drones; ++j)
      if (flight.is_active(6, j)) least = std::min(least, distance_m(data, 6, i, j));
  const ClosestToLost closest = closest_to_lost(data);
  EXPECT_EQ(closest.distance_m, least);
  EXPECT_EQ(closest.tick, 6U);
  EXPECT_EQ(distance_m(data, 6, closest.active, closest.lost), least);
}

}  // namespace
}  // namespace vigil::report
