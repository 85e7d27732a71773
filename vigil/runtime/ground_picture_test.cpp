#include "vigil/runtime/ground_picture.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

class GroundPictureTest : public ::testing::Test {
 protected:
  GroundPictureTest() { picture.retarget(mission, *target, 0.0); }

  /// Drone `a` is at a place of the field at time_s, active or not; the others are on the ground.
  std::vector<DeadlineChange> look(double time_s, const Vec2& place, bool is_active = true) {
    frame.snapshot.time_s = time_s;
    for (swarm::DroneSnapshot& drone : frame.snapshot.drones) drone.activity = swarm::Activity::kGrounded;
    frame.snapshot.drones[0].position = place;
    if (is_active) frame.snapshot.drones[0].activity = swarm::Activity::kActive;
    return picture.look(frame.snapshot);
  }
  AreaState state(std::size_t n) const { return picture.areas(frame).at(n); }

  Mission mission = small_mission("sensor: {footprint_radius_m: 0.8}\n");
  GroundPicture picture{mission};
  std::shared_ptr<const swarm::CoverageTarget> target = coverage_target(mission, picture.basis());
  LiveFrame frame{3};
  const Vec2 east{2.3, 1.1};  // of the field, as the next two
  const Vec2 west{0.5, 0.6};
};

TEST_F(GroundPictureTest, An_area_ages_until_an_active_drone_comes_by) {
  (void)look(10.0, east, false);
  EXPECT_EQ(state(0).what.name, "east");
  EXPECT_EQ(state(0).age_s, 10.0);
  (void)look(12.0, east);
  EXPECT_EQ(state(0).age_s, 0.0);
  EXPECT_EQ(state(0).worst_s, 12.0);
  EXPECT_EQ(state(1).age_s, 12.0);
}

TEST_F(GroundPictureTest, What_a_drone_passes_between_two_looks_is_seen) {
  (void)look(5.0, {0.1, 0.9});
  (void)look(6.0, {2.9, 0.9});
  EXPECT_EQ(state(0).age_s, 0.0);
  EXPECT_EQ(state(1).age_s, 0.0);
  const auto seen = picture.seen().seen_s();
  EXPECT_GT(std::count(seen.begin(), seen.end(), 6.0), std::count(seen.begin(), seen.end(), field::SeenMap::kNever));
}

TEST_F(GroundPictureTest, A_deadline_alarms_once_when_it_is_missed_and_once_when_it_is_kept_again) {
  EXPECT_TRUE(look(20.0, west).empty());
  const auto missed = look(20.5, west);
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_TRUE(missed[0].is_overdue);
  EXPECT_EQ(missed[0].what.name, "east");
  EXPECT_EQ(missed[0].deadline_s, 20.0);
  EXPECT_TRUE(look(21.0, west).empty());
  const auto kept = look(22.0, east);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_FALSE(kept[0].is_overdue);
}

TEST_F(GroundPictureTest, Where_coverage_is_what_was_asked_for_achieved_equals_asked) {
  frame.c_k = target->phi_k;
  frame.past.coverage.has_samples = true;
  const std::vector<AreaState> states = picture.areas(frame);
  for (const AreaState& one : states) {
    EXPECT_GT(one.asked, 0.1);
    EXPECT_DOUBLE_EQ(one.achieved, one.asked);
  }
  EXPECT_LE(states[0].asked + states[1].asked, 1.0);
}

TEST_F(GroundPictureTest, A_target_that_stays_keeps_its_age_when_others_change) {
  (void)look(10.0, west);
  Mission changed = mission;
  changed.targets.areas[0].name = "renamed";
  picture.retarget(changed, *target, 10.0);
  EXPECT_EQ(state(0).age_s, 10.0);
  EXPECT_EQ(state(1).age_s, 0.0);  // for all that is known, a new one
}

TEST_F(GroundPictureTest,
       An_area_that_only_changes_its_weight_keeps_what_was_seen_and_its_share_is_of_the_new_density) {
  (void)look(10.0, east);
  const double asked = state(0).asked;
  mission.targets.clusters[0].weight = 5.0;
  const auto heavier = coverage_target(mission, picture.basis());
  picture.retarget(mission, *heavier, 11.0);
  frame.snapshot.time_s = 12.0;
  EXPECT_EQ(state(0).age_s, 2.0);
  EXPECT_GT(state(0).asked, asked);
  GroundPicture anew(mission);
  anew.retarget(mission, *heavier, 11.0);
  EXPECT_EQ(state(0).asked, anew.areas(frame)[0].asked);
}

TEST_F(GroundPictureTest, Another_outline_or_no_fly_polygon_is_another_region) {
  const auto asked_anew = [&] {
    GroundPicture anew(mission);
    anew.retarget(mission, *target, 0.0);
    return anew.areas(frame)[1].asked;
  };
  const double before = state(1).asked;
  mission.targets.areas[0].outline_m[2].x() += 0.3;
  picture.retarget(mission, *target, 1.0);
  EXPECT_EQ(state(1).asked, asked_anew());
  EXPECT_GT(state(1).asked, before);
  mission.no_fly.push_back({"pond", mission.targets.areas[0].outline_m});
  picture.retarget(mission, *target, 2.0);
  EXPECT_EQ(state(1).asked, asked_anew());
  EXPECT_LT(state(1).asked, before);
}

}  // namespace
}  // namespace vigil::runtime
