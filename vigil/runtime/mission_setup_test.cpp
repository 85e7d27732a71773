#include "vigil/runtime/mission_setup.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

constexpr double kRounding = 1e-12;

Mission right() { return parse_mission(right_mission(), "right"); }

TEST(MissionSetup, Points_of_the_world_become_points_of_the_field) {
  // The field's corner lies at (-2, -1.5) in the world.
  EXPECT_TRUE(starts_in_field(right())[0].isApprox(Vec2(1.0, 0.5), kRounding));
  EXPECT_TRUE(importance(right()).clusters[0].targets[0].isApprox(Vec2(2.0, 2.5), kRounding));
  EXPECT_TRUE(importance(right()).no_fly[0].vertices[0].isApprox(Vec2(0.6, 1.9), kRounding));
}

TEST(MissionSetup, A_turned_field_turns_its_points_back) {
  Mission mission = right();
  mission.field.yaw_rad = 0.5 * std::numbers::pi;
  mission.field.origin_m = Vec2(10.0, 20.0);
  // The field's x axis points along the world's y axis.
  EXPECT_TRUE(target_in_field(mission, Vec2(9.0, 22.0)).isApprox(Vec2(2.0, 1.0), kRounding));
}

TEST(MissionSetup, A_target_outside_is_moved_to_the_border) {
  EXPECT_TRUE(target_in_field(right(), Vec2(0.0, 7.0)).isApprox(Vec2(2.0, 3.0), kRounding));
}

TEST(MissionSetup, The_past_fades_in_twenty_times_the_time_to_cross_the_field) {
  Mission mission = right();
  mission.control.memory_s.reset();
  mission.control.speed_limit_m_s = 0.5;
  EXPECT_DOUBLE_EQ(memory_s(mission).value(), 20.0 * mission.field.size_m.maxCoeff() / 0.5);
  mission.control.memory_s = 70.0;
  EXPECT_EQ(memory_s(mission), 70.0);
}

TEST(MissionSetup, An_endless_memory_is_a_plain_average) {
  Mission mission = right();
  mission.control.memory = Memory::kEndless;
  EXPECT_FALSE(memory_s(mission));
}

TEST(MissionSetup, What_a_mission_leaves_open_follows_from_the_field_and_the_separation) {
  const Mission mission = parse_mission(right_mission_but("sensor: {footprint_radius_m: 0.3}\n", ""), "right");
  EXPECT_DOUBLE_EQ(sigma_min_m(mission), 0.05 * 3.0);
  EXPECT_DOUBLE_EQ(footprint_radius_m(mission), 0.1 * 3.0);
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  EXPECT_DOUBLE_EQ(barrier.contact_distance_m, 0.1);
  EXPECT_DOUBLE_EQ(barrier.no_fly_buffer_m, 0.1);
  EXPECT_DOUBLE_EQ(barrier.dt_s, 0.02);
  EXPECT_DOUBLE_EQ(barrier.pair_gain, 5.0);
  EXPECT_FALSE(barrier.sensing_range_m);
}

TEST(MissionSetup, The_papers_barrier_has_the_papers_gains) {
  Mission mission = right();
  mission.safety.barrier = safety::BarrierKind::kPaper;
  EXPECT_DOUBLE_EQ(barrier_parameters(mission).pair_gain, 10.0);
  EXPECT_DOUBLE_EQ(barrier_parameters(mission).wall_gain, 10.0);
}

TEST(MissionSetup, What_a_mission_says_is_taken_as_it_is) {
  Mission mission = right();
  mission.safety.contact_distance_m = 0.07;
  mission.safety.no_fly_buffer_m = 0.0;
  mission.safety.wall_gain = 3.0;
  mission.safety.sensing_range_m = 0.9;
  mission.targets.sigma_min_m = 0.4;
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  EXPECT_EQ(barrier.contact_distance_m, 0.07);
  EXPECT_EQ(barrier.no_fly_buffer_m, 0.0);
  EXPECT_EQ(barrier.wall_gain, 3.0);
  EXPECT_EQ(barrier.sensing_range_m, 0.9);
  EXPECT_EQ(importance(mission).sigma_min_m, 0.4);
}

TEST(MissionSetup, Every_no_fly_polygon_contributes_its_edges) {
  const std::vector<field::Segment> edges = no_fly_edges(right());
  ASSERT_EQ(edges.size(), 4U);
  for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges[i].b, edges[(i + 1) % 4].a);
}

}  // namespace
}  // namespace vigil::runtime
