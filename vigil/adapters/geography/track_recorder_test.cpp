#include "vigil/adapters/geography/track_recorder.hpp"

#include <gtest/gtest.h>

namespace vigil::geography {
namespace {

runtime::Mission mission_of(std::size_t drones) {
  runtime::Mission mission;
  mission.field.size_m = {100.0, 50.0};
  mission.field.origin_m = {10.0, -5.0};
  for (std::size_t i = 0; i < drones; ++i) mission.drones.push_back({"d" + std::to_string(i + 1), Vec2::Zero()});
  mission.targets.clusters.push_back({"first", {{20.0, 20.0}}, 1.0, {}});
  return mission;
}

/// Ticks of 0.1 s that begin at `from_s`; `age_s` tells the age of a drone's position at a time.
void fly(TrackRecorder& recorder, int ticks, double from_s, const auto& age_s) {
  swarm::Snapshot snapshot(1);
  for (int i = 0; i < ticks; ++i) {
    snapshot.time_s = from_s + 0.1 * i;
    snapshot.drones[0].position = {1.0 * i, 2.0};
    snapshot.drones[0].height_m = 3.0;
    snapshot.drones[0].age_s = age_s(snapshot.time_s);
    recorder.record({snapshot, {}, {}, {}, {}});
  }
}

TEST(TrackRecorder, Keeps_a_point_a_step_in_the_world_frame_from_time_zero_on) {
  TrackRecorder recorder(1.0);
  recorder.begin(mission_of(1), {});
  fly(recorder, 31, 60.0, [](double) { return 0.0; });
  recorder.finish();
  ASSERT_EQ(recorder.tracks().size(), 1U);
  EXPECT_EQ(recorder.tracks()[0].drone, "d1");
  ASSERT_EQ(recorder.tracks()[0].pieces.size(), 1U);
  const auto& piece = recorder.tracks()[0].pieces[0];
  ASSERT_EQ(piece.size(), 4U);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    EXPECT_NEAR(piece[i].time_s, static_cast<double>(i), 0.1001);
    EXPECT_EQ(piece[i].place_m.y(), -3.0);
    EXPECT_EQ(piece[i].height_m, 3.0);
  }
  EXPECT_EQ(piece[0].place_m.x(), 10.0);
}

TEST(TrackRecorder, A_track_is_broken_where_nobody_knew_the_place) {
  TrackRecorder recorder(0.1);
  recorder.begin(mission_of(1), {});
  fly(recorder, 50, 0.0, [](double t) { return t > 1.95 && t < 3.05 ? 0.6 : 0.1; });
  recorder.finish();
  const auto& pieces = recorder.tracks()[0].pieces;
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].back().time_s, 1.9, 0.1001);
  EXPECT_NEAR(pieces[1].front().time_s, 3.1, 0.1001);
}

TEST(TrackRecorder, A_drone_that_was_never_seen_has_no_piece) {
  TrackRecorder recorder(0.1);
  recorder.begin(mission_of(1), {});
  fly(recorder, 50, 0.0, [](double) { return swarm::DroneObservation::kNever; });
  recorder.finish();
  EXPECT_TRUE(recorder.tracks()[0].pieces.empty());
}

TEST(TrackRecorder, The_targets_are_those_of_the_end) {
  TrackRecorder recorder(1.0);
  const runtime::Mission mission = mission_of(1);
  recorder.begin(mission, {});
  runtime::MissionTargets later = runtime::targets_of(mission);
  later.targets.clusters[0].name = "second";
  later.no_fly.push_back({"mast", later.targets.clusters[0].points_m});
  recorder.targets(5.0, later);
  recorder.finish();
  EXPECT_EQ(recorder.last_targets(), later);
}

}  // namespace
}  // namespace vigil::geography
