#include "vigil/runtime/recorded_targets.hpp"

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

const std::vector<Vec2> kTriangle{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};

Mission before_take_off() {
  Mission mission;
  mission.targets.clusters.push_back({"camp", {{0.5, 0.5}}, 1.0, 60.0});
  mission.targets.sigma_min_m = 0.125;
  mission.no_fly.push_back({"road", kTriangle});
  return mission;
}

TEST(RecordedTargets, The_list_of_that_time_holds_whole_with_deadlines_soft_edges_and_no_fly_polygons) {
  const Mission mission = before_take_off();
  const std::vector<RecordedTargets> lists{
      {.time_s = 30.0, .areas = {{"pond", kTriangle, 5.0, 0.25, 90.0}}, .no_fly = {}, .uniform_floor = 0.5},
      {.time_s = 40.0, .clusters = mission.targets.clusters, .no_fly = {{"mast", kTriangle}}}};
  EXPECT_EQ(targets_of(mission_at(mission, lists, 29.9)), targets_of(mission));
  const Mission later = mission_at(mission, lists, 30.0);
  EXPECT_TRUE(later.targets.clusters.empty());
  EXPECT_EQ(later.targets.areas, lists[0].areas);
  EXPECT_EQ(later.targets.uniform_floor, 0.5);
  EXPECT_TRUE(later.no_fly.empty());
  const Mission at_end = mission_at(mission, lists, 1e9);
  EXPECT_EQ(at_end.no_fly.front().name, "mast");
  EXPECT_EQ(at_end.targets.clusters.front().revisit_s, 60.0);
}

TEST(RecordedTargets, What_nobody_changes_in_flight_is_the_missions) {
  const std::vector<RecordedTargets> lists{{.time_s = 0.0}};
  EXPECT_EQ(mission_at(before_take_off(), lists, 1.0).targets.sigma_min_m, 0.125);
}

}  // namespace
}  // namespace vigil::runtime
