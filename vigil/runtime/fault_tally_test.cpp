#include "vigil/runtime/fault_tally.hpp"

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::DroneId;
using swarm::Fault;

Mission drifting_mission() {
  Mission mission;
  mission.drones = {{"a", Vec2(1.0, 1.0)}, {"b", Vec2(2.0, 2.0)}};
  EventEntry drift;
  drift.at_s = 20.0;
  drift.what = EventKind::kDrift;
  drift.drone = "a";
  drift.for_s = 10.0;
  EventEntry land = drift;
  land.at_s = 25.0;
  land.what = EventKind::kLand;  // that is somebody's wish
  mission.simulation.events = {drift, land};
  return mission;
}

void alarm(FaultTally& tally, double time_s, std::size_t drone, Activity after, Fault fault) {
  swarm::Snapshot snapshot(2);
  snapshot.time_s = time_s;
  swarm::Event event;
  event.drone = DroneId(drone);
  event.after = after;
  event.fault = fault;
  snapshot.events = {event};
  tally.add(snapshot);
}

TEST(FaultTally, What_befell_a_drone_is_noticed_by_the_first_alarm_about_it) {
  FaultTally tally(drifting_mission());
  alarm(tally, 10.0, 0, Activity::kLinkLost, Fault::kNone);  // true as it is, and nothing to do with the drift
  EXPECT_TRUE(tally.detections().empty());
  alarm(tally, 20.5, 1, Activity::kLinkLost, Fault::kNone);
  ASSERT_EQ(tally.detections().size(), 1U);
  EXPECT_FALSE(tally.detections()[0].noticed_s);
  alarm(tally, 21.25, 0, Activity::kNotFollowing, Fault::kNotFollowing);
  alarm(tally, 24.0, 0, Activity::kTrackingLost, Fault::kJumped);
  ASSERT_EQ(tally.detections().size(), 1U);
  EXPECT_EQ(tally.detections()[0].noticed_s, 1.25);
  EXPECT_EQ(tally.detections()[0].noticed_as, "not_following");
  EXPECT_EQ(tally.false_alarms(), 0U);
  EXPECT_EQ(tally.alarms().size(), 3U);
}

TEST(FaultTally, An_accusation_of_a_drone_that_nothing_befell_is_a_false_alarm) {
  FaultTally tally(drifting_mission());
  alarm(tally, 19.0, 0, Activity::kNotFollowing, Fault::kNotFollowing);
  alarm(tally, 21.0, 1, Activity::kNotFollowing, Fault::kNotFollowing);
  EXPECT_EQ(tally.false_alarms(), 2U);
  alarm(tally, 30.0 + FaultTally::kAfterwardsS - 1.0, 0, Activity::kNotFollowing, Fault::kNotFollowing);
  EXPECT_EQ(tally.false_alarms(), 2U);
  alarm(tally, 30.0 + FaultTally::kAfterwardsS + 1.0, 0, Activity::kNotFollowing, Fault::kNotFollowing);
  EXPECT_EQ(tally.false_alarms(), 3U);
}

TEST(FaultTally, Where_the_tracker_exchanges_drones_by_itself_what_looks_like_it_is_not_counted) {
  Mission mission = drifting_mission();
  mission.simulation.tracker.swaps_per_h = 1.0;
  FaultTally tally(mission);
  alarm(tally, 21.0, 1, Activity::kTrackingLost, Fault::kSwapped);
  EXPECT_EQ(tally.false_alarms(), 0U);
  alarm(tally, 22.0, 1, Activity::kNotFollowing, Fault::kNotFollowing);
  EXPECT_EQ(tally.false_alarms(), 1U);
}

TEST(FaultTally, A_station_that_fails_is_noticed_by_what_the_swarm_says_of_it_and_explains_no_accusation) {
  Mission mission = drifting_mission();
  mission.stations.resize(2);
  mission.stations[0].name = "west";
  mission.stations[1].name = "east";
  EventEntry fails;
  fails.at_s = 5.0;
  fails.what = EventKind::kFailStation;
  fails.station = "east";
  mission.simulation.events = {fails};
  FaultTally tally(mission);
  alarm(tally, 10.0, 0, Activity::kNotFollowing, Fault::kNotFollowing);
  EXPECT_EQ(tally.false_alarms(), 1U);
  ASSERT_EQ(tally.detections().size(), 1U);
  EXPECT_FALSE(tally.detections()[0].noticed_s);
  for (const std::uint32_t station : {0U, 1U}) {
    swarm::Snapshot snapshot(2);
    snapshot.time_s = 20.0 + station;
    snapshot.events = {{.kind = swarm::EventKind::kStationFailed, .station = station}};
    tally.add(snapshot);
  }
  const Detection found = tally.detections()[0];
  EXPECT_EQ(found.station, "east");
  EXPECT_EQ(found.noticed_as, "station_failed");
  EXPECT_EQ(found.noticed_s, 16.0);
}

TEST(FaultTally, What_befell_before_the_part_that_is_looked_at_is_left_out) {
  FaultTally tally(drifting_mission());
  tally.begin_at(22.0);
  alarm(tally, 23.0, 0, Activity::kActive, Fault::kNone);
  EXPECT_TRUE(tally.detections().empty());
}

}  // namespace
}  // namespace vigil::runtime
