#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "vigil/adapters/ros/mission_scene.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/adapters/ros/swarm_scene.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::ros_bridge {
namespace {

runtime::Mission paper() { return runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml"); }

swarm::Snapshot flying(const runtime::Mission& mission) {
  swarm::Snapshot snapshot(mission.drones.size());
  const std::vector<Vec2> starts = runtime::starts_in_field(mission);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    snapshot.drones[i].position = starts[i];
    snapshot.drones[i].height_m = 0.5;
    snapshot.drones[i].mode = swarm::VehicleMode::kFlying;
    snapshot.drones[i].activity = swarm::Activity::kActive;
  }
  return snapshot;
}

TEST(Scene, The_density_is_drawn_from_nothing_to_its_highest) {
  const DensityPicture picture = density_picture(paper());
  EXPECT_EQ(picture.share_of_highest.size(), picture.columns * picture.rows);
  EXPECT_EQ(*std::ranges::max_element(picture.share_of_highest), 1.0F);
  EXPECT_LT(*std::ranges::min_element(picture.share_of_highest), 0.01F);
}

TEST(Scene, The_highest_density_lies_among_the_targets_of_a_cluster) {
  const runtime::Mission mission = paper();
  const DensityPicture picture = density_picture(mission);
  const auto at = static_cast<std::size_t>(
      std::distance(picture.share_of_highest.begin(), std::ranges::max_element(picture.share_of_highest)));
  const Vec2 place(picture.corner.x + (static_cast<double>(at % picture.columns) + 0.5) * picture.column_m,
                   picture.corner.y + (static_cast<double>(at / picture.columns) + 0.5) * picture.row_m);
  double nearest = 1e9;
  for (const runtime::ClusterEntry& cluster : mission.targets.clusters)
    for (const Vec2& point : cluster.points_m) nearest = std::min(nearest, (point - place).norm());
  EXPECT_LT(nearest, 0.2);
}

TEST(Scene, A_mission_without_targets_has_a_density_of_nothing) {
  runtime::Mission mission = paper();
  mission.targets.clusters.clear();
  const DensityPicture picture = density_picture(mission);
  EXPECT_TRUE(std::ranges::all_of(picture.share_of_highest, [](float share) { return share == 0.0F; }));
}

TEST(Scene, A_clusters_ellipse_lies_two_standard_deviations_from_its_mean) {
  const runtime::Mission mission = paper();
  const field::Gaussian gaussian =
      field::fit(runtime::cluster_in_field(mission, mission.targets.clusters.front()), runtime::sigma_min_m(mission));
  const std::vector<Mark> marks = target_marks(mission);
  const auto ellipse = std::ranges::find(marks, "clusters", &Mark::set);
  ASSERT_NE(ellipse, marks.end());
  for (const Point& point : ellipse->points) {
    const Vec2 away = runtime::world_frame(mission).point_to_field({point.x, point.y}) - gaussian.mean;
    EXPECT_NEAR(std::sqrt(away.dot(gaussian.covariance.inverse() * away)), 2.0, 1e-9);
  }
}

TEST(Scene, Every_drone_has_a_green_of_its_own) {
  constexpr std::size_t kDrones = 50;
  std::set<std::tuple<float, float, float>> greens;
  for (std::size_t i = 0; i < kDrones; ++i) {
    const Colour colour = green_of(i, kDrones);
    EXPECT_GT(colour.green, colour.red + colour.blue);
    greens.insert({colour.red, colour.green, colour.blue});
  }
  EXPECT_EQ(greens.size(), kDrones);
}

TEST(Scene, Two_drones_that_are_R_s_apart_have_circles_that_touch) {
  const runtime::Mission mission = paper();
  swarm::Snapshot snapshot = flying(mission);
  snapshot.drones[1].position = snapshot.drones[0].position + Vec2(mission.safety.separation_m, 0.0);
  double rightmost = -1e9;
  double leftmost = 1e9;
  for (const Mark& mark : drone_marks(mission, snapshot)) {
    if (mark.set != "safety" || mark.id > 1) continue;
    for (const Point& point : mark.points) {
      if (mark.id == 0) rightmost = std::max(rightmost, point.x);
      if (mark.id == 1) leftmost = std::min(leftmost, point.x);
    }
  }
  EXPECT_NEAR(rightmost, leftmost, 1e-6);
}

TEST(Scene, What_holds_a_drone_is_joined_to_it_by_a_line) {
  const runtime::Mission mission = paper();
  swarm::Snapshot snapshot = flying(mission);
  snapshot.drones[0].filter.holding_count = 2;
  snapshot.drones[0].filter.holding[0] = {.kind = safety::RowKind::kNeighbour, .index = 2, .distance_m = 2.0};
  snapshot.drones[0].filter.holding[1] = {.kind = safety::RowKind::kWall, .index = 1, .distance_m = 2.5};
  const std::vector<Mark> marks = drone_marks(mission, snapshot);
  const auto lines = std::ranges::find(marks, "constraints", &Mark::set);
  ASSERT_NE(lines, marks.end());
  ASSERT_EQ(lines->points.size(), 4U);
  EXPECT_DOUBLE_EQ(lines->points[1].x, 1.0);  // where cf3 starts
  EXPECT_DOUBLE_EQ(lines->points[1].y, -1.0);
  EXPECT_DOUBLE_EQ(lines->points[3].x, 1.5);  // the right wall
  EXPECT_DOUBLE_EQ(lines->points[3].y, lines->points[2].y);
}

TEST(Scene, A_landed_drones_trail_ends_where_it_landed) {
  const runtime::Mission mission = paper();
  Trails trails(mission);
  swarm::Snapshot snapshot = flying(mission);
  trails.add(snapshot);
  snapshot.drones[1].position += Vec2(0.1, 0.0);
  trails.add(snapshot);
  snapshot.drones[1].mode = swarm::VehicleMode::kGrounded;
  snapshot.drones[1].height_m = 0.0;
  snapshot.drones[1].position += Vec2(0.1, 0.0);
  trails.add(snapshot);
  ASSERT_EQ(trails.of(1).size(), 2U);
  EXPECT_NEAR(trails.of(1).back().x, mission.drones[1].start_m.x() + 0.1, 1e-9);
}

TEST(Scene, Trails_are_bounded) {
  const runtime::Mission mission = paper();
  Trails trails(mission);
  swarm::Snapshot snapshot = flying(mission);
  for (std::size_t i = 0; i < 3 * Trails::kMostPoints; ++i) {
    snapshot.drones[0].position.x() = i % 2 == 0 ? 0.5 : 1.5;
    trails.add(snapshot);
  }
  EXPECT_LE(trails.of(0).size(), Trails::kMostPoints);
  EXPECT_EQ(trails.of(1).size(), 1U);
}

TEST(Scene, A_drone_whose_tracker_lost_it_is_an_error_with_advice) {
  const runtime::Mission mission = paper();
  swarm::Snapshot snapshot = flying(mission);
  snapshot.drones[1].activity = swarm::Activity::kTrackingLost;
  const std::vector<Diagnosis> diagnoses = diagnoses_of(mission, snapshot);
  EXPECT_EQ(diagnoses[0].level, Diagnosis::Level::kOk);
  EXPECT_EQ(diagnoses[1].level, Diagnosis::Level::kError);
  EXPECT_NE(diagnoses[1].summary.find("look for it"), std::string::npos);
}

TEST(Scene, What_is_not_known_is_not_plotted) {
  const runtime::Mission mission = paper();
  const std::vector<Figure> figures = figures_of(mission, flying(mission));
  EXPECT_EQ(std::ranges::find(figures, "metric_percent", &Figure::name), figures.end());
  EXPECT_NE(std::ranges::find(figures, "smallest_distance_m", &Figure::name), figures.end());
}

TEST(RosName, Two_ids_of_one_ROS_name_are_complained_of_by_both_names) {
  EXPECT_EQ(complaint_of_names({"cf1", "cf_1", "1", "d2"}), "");
  const std::string complaint = complaint_of_names({"a", "cf-1", "cf_1"});
  EXPECT_NE(complaint.find("cf-1 and cf_1"), std::string::npos) << complaint;
  EXPECT_NE(complaint_of_names({"1", "d1"}), "");
}

TEST(RosName, Positions_are_of_the_drone_and_in_the_world_by_the_last_parts_of_their_frames) {
  for (const char* const child : {"cf-1", "cf_1", "/cf_1", "vicon/cf_1/cf_1"})
    EXPECT_EQ(complaint_of_frames("cf-1", "/world", child), "");
  EXPECT_NE(complaint_of_frames("cf-1", "map", "cf_1").find("\"map\" instead of \"world\""), std::string::npos);
  for (const char* const child : {"", "cf_2", "vicon/cf_1/cf_2"})
    EXPECT_NE(complaint_of_frames("cf-1", "world", child), "");
}

TEST(RosName, Is_one_that_ROS_accepts) {
  EXPECT_EQ(ros_name("cf1"), "cf1");
  EXPECT_EQ(ros_name("7 of 9"), "d7_of_9");
  EXPECT_EQ(ros_name(""), "d");
}

}  // namespace
}  // namespace vigil::ros_bridge
