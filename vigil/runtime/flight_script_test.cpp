#include "vigil/runtime/flight_script.hpp"

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

using swarm::CommandKind;

/// Notes what happens to it.
class NotingFleet final : public VirtualFleet {
 public:
  [[nodiscard]] std::size_t size() const noexcept override { return 2; }
  void observe(MissionTime, std::span<swarm::DroneObservation>) noexcept override {}
  void order(MissionTime, std::span<const swarm::DroneOrder>) noexcept override {}
  void advance(double) noexcept override {}
  [[nodiscard]] std::span<const TruthSample> truth() const noexcept override { return {}; }
  void fail(swarm::DroneId drone) noexcept override { failed.push_back(drone.index()); }
  void take_over(swarm::DroneId, const Vec2& velocity) noexcept override { taken_velocity = velocity; }
  void give_back(swarm::DroneId) noexcept override { ++given_back; }
  void hide(swarm::DroneId, double for_s) noexcept override { hidden_s = for_s; }
  void cut_link(swarm::DroneId, double for_s) noexcept override { cut_s = for_s; }
  void befall(swarm::DroneId drone, const Mishap& mishap) noexcept override {
    befallen.push_back(drone.index());
    last_mishap = mishap;
  }

  std::vector<std::size_t> failed;
  std::vector<std::size_t> befallen;
  Mishap last_mishap;
  Vec2 taken_velocity = Vec2::Zero();
  int given_back = 0;
  double hidden_s = 0.0;
  double cut_s = 0.0;
};

EventEntry event(double at_s, EventKind what, const std::string& drone = "") {
  EventEntry entry;
  entry.at_s = at_s;
  entry.what = what;
  entry.drone = drone;
  return entry;
}

EventEntry edit(double at_s, EventKind what, const std::string& cluster, int target = 0, Vec2 point = Vec2::Zero()) {
  EventEntry entry = event(at_s, what);
  entry.cluster = cluster;
  entry.target = target;
  entry.point_m = point;
  return entry;
}

class FlightScriptTest : public ::testing::Test {
 protected:
  FlightScriptTest() {
    mission.field.size_m = Vec2(3.0, 3.0);
    mission.drones = {{"cf1", Vec2(1.0, 1.0)}, {"cf2", Vec2(2.0, 2.0)}};
    mission.targets.clusters = {{"a", {Vec2(1.0, 1.0), Vec2(1.1, 1.0)}, 1.0, {}}};
  }
  DueEvents play(std::vector<EventEntry> events, double until_s = 100.0) {
    mission.simulation.events = std::move(events);
    FlightScript script(mission, fleet);
    DueEvents due = script.play(until_s);
    for (const EventEntry& change : due.target_edits) apply_edit(mission.targets, change);
    return due;
  }

  Mission mission;
  NotingFleet fleet;
};

TEST_F(FlightScriptTest, An_event_is_due_at_its_tick_once_and_not_before) {
  mission.simulation.events = {event(23.0, EventKind::kLand, "cf2")};
  FlightScript script(mission, fleet);
  EXPECT_TRUE(script.play(22.98).commands.empty());
  const DueEvents due = script.play(1150 * 0.02);  // rounds to a little less than 23
  ASSERT_EQ(due.commands.size(), 1U);
  EXPECT_EQ(due.commands[0].kind, CommandKind::kLand);
  EXPECT_EQ(due.commands[0].drone->index(), 1U);
  EXPECT_TRUE(script.play(23.02).commands.empty());
}

TEST_F(FlightScriptTest, What_was_due_before_a_restart_is_passed_over) {
  mission.simulation.events = {event(1.0, EventKind::kHold, "cf1"), event(23.0, EventKind::kLand, "cf2")};
  FlightScript script(mission, fleet);
  script.skip_to(10.0);
  EXPECT_TRUE(script.play(22.0).commands.empty());
  EXPECT_EQ(script.play(23.0).commands.size(), 1U);
}

TEST_F(FlightScriptTest, All_means_every_drone) {
  EXPECT_EQ(play({event(1.0, EventKind::kLand, "all")}).commands.size(), 2U);
}

TEST_F(FlightScriptTest, What_the_world_does_reaches_the_fleet_and_not_the_controller) {
  EventEntry lose = event(2.0, EventKind::kLoseTracking, "cf1");
  lose.for_s = 3.0;
  EventEntry out_of_reach = event(3.0, EventKind::kLoseLink, "cf1");
  out_of_reach.for_s = 4.0;
  const DueEvents due = play({event(1.0, EventKind::kFail, "cf2"), lose, out_of_reach});
  EXPECT_TRUE(due.commands.empty());
  EXPECT_EQ(fleet.failed, std::vector<std::size_t>{1});
  EXPECT_EQ(fleet.hidden_s, 3.0);
  EXPECT_EQ(fleet.cut_s, 4.0);
}

TEST_F(FlightScriptTest, A_mishap_befalls_its_drone_in_the_field_s_frame_and_nobody_is_told) {
  mission.field.yaw_rad = 1.5707963267948966;  // the field's x axis is the world's y axis
  EventEntry shift = event(1.0, EventKind::kShiftTracking, "cf2");
  shift.shift_m = Vec2(0.0, 0.4);
  shift.for_s = 5.0;
  EXPECT_TRUE(play({shift}).commands.empty());
  EXPECT_EQ(fleet.befallen, std::vector<std::size_t>{1});
  EXPECT_EQ(fleet.last_mishap.kind, MishapKind::kShiftTracking);
  EXPECT_LT((fleet.last_mishap.value - Vec2(0.4, 0.0)).norm(), 1e-12);
  EXPECT_EQ(fleet.last_mishap.for_s, 5.0);
}

TEST_F(FlightScriptTest, An_exchange_names_both_drones) {
  EventEntry exchange = event(1.0, EventKind::kSwapTracking, "cf1");
  exchange.other = "cf2";
  exchange.for_s = 5.0;
  static_cast<void>(play({exchange}));
  EXPECT_EQ(fleet.befallen, std::vector<std::size_t>{0});
  EXPECT_EQ(fleet.last_mishap.kind, MishapKind::kSwapTracking);
  EXPECT_EQ(fleet.last_mishap.other.index(), 1U);
}

TEST_F(FlightScriptTest, A_pilot_takes_the_vehicle_and_the_controller_is_told) {
  mission.field.yaw_rad = 1.5707963267948966;  // the field's x axis is the world's y axis
  EventEntry take = event(1.0, EventKind::kOverride, "cf1");
  take.velocity_m_s = Vec2(0.0, 0.2);
  const DueEvents due = play({take, event(2.0, EventKind::kGiveBack, "cf1")});
  ASSERT_EQ(due.commands.size(), 2U);
  EXPECT_EQ(due.commands[0].kind, CommandKind::kOverride);
  EXPECT_EQ(due.commands[1].kind, CommandKind::kGiveBack);
  EXPECT_LT((fleet.taken_velocity - Vec2(0.2, 0.0)).norm(), 1e-12);
  EXPECT_EQ(fleet.given_back, 1);
}

TEST_F(FlightScriptTest, Targets_are_added_moved_and_removed) {
  const DueEvents due =
      play({edit(1.0, EventKind::kAddTarget, "new", 0, {2.0, 2.0}),
            edit(2.0, EventKind::kMoveTarget, "a", 2, {0.5, 0.5}), edit(3.0, EventKind::kRemoveTarget, "a", 1)});
  EXPECT_EQ(due.target_edits.size(), 3U);
  ASSERT_EQ(mission.targets.clusters.size(), 2U);
  EXPECT_EQ(mission.targets.clusters[0].points_m, std::vector<Vec2>{Vec2(0.5, 0.5)});
  EXPECT_EQ(mission.targets.clusters[1].name, "new");
}

TEST_F(FlightScriptTest, A_cluster_goes_with_its_last_target) {
  (void)play({edit(1.0, EventKind::kRemoveTarget, "a", 2), edit(1.0, EventKind::kRemoveTarget, "a", 1)});
  EXPECT_TRUE(mission.targets.clusters.empty());
}

TEST_F(FlightScriptTest, A_weight_changes_and_the_log_says_so) {
  EventEntry weight = edit(1.0, EventKind::kSetWeight, "a");
  weight.weight = 2.5;
  const DueEvents due = play({weight});
  EXPECT_EQ(mission.targets.clusters[0].weight, 2.5);
  ASSERT_EQ(due.log.size(), 1U);
  EXPECT_EQ(due.log[0].what, "set_weight");
  EXPECT_EQ(due.log[0].detail, "a: weight 2.5");
}

}  // namespace
}  // namespace vigil::runtime
