#include "vigil/adapters/report/flight_data.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace
}  // namespace vigil::report
