#include "vigil/runtime/campaign_draws.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using dynamics::RandomStream;

constexpr std::uint64_t kSeeds = 50;

/// Twelve drones in a turned field, a quarter of which is a no-fly polygon.
Mission turned_mission() {
  return parse_mission(R"(
format: 1
name: turned
field: {size_m: [4, 3], origin_m: [100, -50], yaw_rad: 0.7}
targets:
  clusters:
    - {name: three, points_m: [[101, -48.5], [101.1, -48.4], [100.9, -48.6]]}
    - {name: one, points_m: [[100.2, -48.2]]}
no_fly: [{name: mast, outline_m: [[101.5, -48.5], [102.4, -47.6], [101.4, -46.7]]}]
drone_grid: {count: 12, spacing_m: 0.35}
control: {speed_limit_m_s: 0.3}
safety: {separation_m: 0.2, wall_distance_m: 0.1}
simulation: {duration_s: 60}
)",
                       "turned");
}

Mission without_no_fly(Mission mission) {
  mission.no_fly.clear();
  return mission;
}

double wall_distance(const field::Field& field, const Vec2& p) {
  return std::min({p.x(), p.y(), field.length_x - p.x(), field.length_y - p.y()});
}

class Draws : public testing::Test {
 protected:
  Mission mission_ = turned_mission();
  field::Polygon mast_ = polygon_in_field(mission_, mission_.no_fly.front().outline_m);
  field::Field field_ = monitored_field(mission_);
};

TEST_F(Draws, Starts_keep_every_distance_that_the_barrier_asks_for) {
  const safety::BarrierParameters barrier = barrier_parameters(mission_);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, 0, 0);
    const auto drawn = draw_starts(mission_, random);
    ASSERT_TRUE(drawn);
    for (std::size_t i = 0; i < drawn->size(); ++i) mission_.drones[i].start_m = (*drawn)[i];
    const std::vector<Vec2> starts = starts_in_field(mission_);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      EXPECT_GT(wall_distance(field_, starts[i]), barrier.wall_distance_m);
      EXPECT_GT(field::signed_distance(mast_, starts[i]), barrier.no_fly_buffer_m);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((starts[i] - starts[j]).norm(), safety::barrier_radius(barrier));
    }
  }
}

TEST_F(Draws, Starts_spread_over_the_whole_field) {
  mission_ = without_no_fly(mission_);
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RandomStream random(seed, 0, 0);
    const auto starts = draw_starts(mission_, random);
    ASSERT_TRUE(starts);
    for (const Vec2& start : *starts) {
      const Vec2 p = world_frame(mission_).point_to_field(start);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  EXPECT_LT(low.maxCoeff(), 0.2);
  EXPECT_GT(high.x(), 3.8);
  EXPECT_GT(high.y(), 2.8);
}

TEST_F(Draws, No_starts_are_drawn_where_there_is_no_room) {
  mission_.safety.separation_m = 1.5;
  RandomStream random(1, 0, 0);
  EXPECT_FALSE(draw_starts(mission_, random));
}

TEST_F(Draws, Targets_keep_their_numbers_and_lie_where_they_can_be_seen) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, 0, 0);
    const auto clusters = draw_targets(mission_, random);
    if (!clusters) continue;  // a centre in the mast: drawn again by whoever asked
    ASSERT_EQ(clusters->size(), 2U);
    EXPECT_EQ((*clusters)[0].size(), 3U);
    EXPECT_EQ((*clusters)[1].size(), 1U);
    for (const std::vector<Vec2>& points : *clusters) {
      for (const Vec2& point : points) {
        const Vec2 p = world_frame(mission_).point_to_field(point);
        EXPECT_GE(wall_distance(field_, p), 0.0);
        EXPECT_GE(field::signed_distance(mast_, p), 0.0);
      }
    }
  }
}

TEST_F(Draws, Incidents_are_in_order_within_the_mission_and_of_the_kinds_asked_for) {
  const std::vector<EventKind> kinds{EventKind::kOverride, EventKind::kHold, EventKind::kLoseTracking,
                                     EventKind::kLoseLink};
  const std::set<EventKind> expected{EventKind::kOverride, EventKind::kGiveBack,     EventKind::kHold,
                                     EventKind::kResume,   EventKind::kLoseTracking, EventKind::kLoseLink};
  std::set<EventKind> seen;
  RandomStream random(1, 0, 0);
  const std::vector<EventEntry> events = draw_incidents(mission_, 100, kinds, random);
  EXPECT_TRUE(std::ranges::is_sorted(events, {}, &EventEntry::at_s));
  for (const EventEntry& event : events) {
    seen.insert(event.what);
    EXPECT_GE(event.at_s, 0.0);
    EXPECT_LE(event.at_s, 60.0);
    EXPECT_LE(event.velocity_m_s.norm(), 0.301);
    EXPECT_EQ(event.for_s > 0.0, event.what == EventKind::kLoseTracking || event.what == EventKind::kLoseLink);
  }
  EXPECT_EQ(seen, expected);
}

TEST_F(Draws, What_passes_is_taken_back_from_the_same_drone_within_ten_seconds) {
  std::size_t taken_back = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    RandomStream random(seed, 0, 0);
    const std::vector<EventEntry> events = draw_incidents(mission_, 1, std::vector{EventKind::kHold}, random);
    EXPECT_EQ(events.at(0).what, EventKind::kHold);
    if (events.size() == 1) {
      EXPECT_GT(events[0].at_s, 50.0);  // too near to the end
      continue;
    }
    ++taken_back;
    EXPECT_EQ(events[1].what, EventKind::kResume);
    EXPECT_EQ(events[0].drone, events[1].drone);
    EXPECT_GT(events[1].at_s - events[0].at_s, 0.4);
    EXPECT_LT(events[1].at_s - events[0].at_s, 10.1);
  }
  EXPECT_GT(taken_back, kSeeds / 2);
}

}  // namespace
}  // namespace vigil::runtime
