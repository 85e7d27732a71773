#include "vigil/runtime/goal_script.hpp"

#include <gtest/gtest.h>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

Mission with_goals(GoalPattern pattern) {
  Mission mission = load_mission(VIGIL_MISSIONS_DIR "/crowd.yaml", {});
  mission.simulation.goals = GoalsSection{.pattern = pattern, .radius_m = 0.15};
  return mission;
}

/// Drones that are wherever they are put.
struct Watched {
  explicit Watched(const Mission& mission)
      : script(mission), snapshot(mission.drones.size()), truth(mission.drones.size()) {
    for (swarm::DroneSnapshot& drone : snapshot.drones) drone.activity = swarm::Activity::kActive;
  }
  /// What a tick does with the commands that are due: it accepts them.
  std::size_t accept() {
    std::vector<swarm::Command> commands;
    script.play(snapshot, commands);
    snapshot.events.clear();
    for (const swarm::Command& command : commands) {
      swarm::Event event{.kind = swarm::EventKind::kWishAccepted, .drone = *command.drone};
      event.wish = command.kind;
      snapshot.note(event);
    }
    return commands.size();
  }
  GoalScript script;
  swarm::Snapshot snapshot;
  std::vector<TruthSample> truth;
};

TEST(GoalScript, Each_drone_is_sent_once_as_soon_as_it_has_been_seen) {
  const Mission mission = with_goals(GoalPattern::kPlaces);
  Watched flight(mission);
  flight.snapshot.drones[3].activity = swarm::Activity::kNeverSeen;
  EXPECT_EQ(flight.accept(), 49U);
  flight.script.watch(flight.truth, flight.snapshot, 0.0);
  flight.snapshot.drones[3].activity = swarm::Activity::kActive;
  EXPECT_EQ(flight.accept(), 1U);
  flight.script.watch(flight.truth, flight.snapshot, 0.02);
  EXPECT_EQ(flight.accept(), 0U);
}

TEST(GoalScript, A_drone_that_is_held_or_down_is_left_alone) {
  using swarm::Activity;
  Watched flight(with_goals(GoalPattern::kPlaces));
  const std::vector others{Activity::kHeld, Activity::kGrounded, Activity::kLanding, Activity::kEmergencyStop,
                           Activity::kMarkedFailed};
  for (std::size_t i = 0; i < others.size(); ++i) flight.snapshot.drones[i].activity = others[i];
  EXPECT_EQ(flight.accept(), 45U);
}

TEST(GoalScript, Errands_never_end_and_every_one_counts) {
  const Mission mission = with_goals(GoalPattern::kErrands);
  Watched flight(mission);
  for (int errand = 1; errand <= 5; ++errand) {
    EXPECT_EQ(flight.accept(), 50U) << errand;
    for (std::size_t i = 0; i < 50; ++i) flight.truth[i].position = flight.script.goals()[i];
    flight.script.watch(flight.truth, flight.snapshot, errand);
    EXPECT_EQ(flight.script.tally().reached, 50U * static_cast<unsigned>(errand));
  }
  EXPECT_FALSE(flight.script.tally().all_there_s);
}

TEST(GoalScript, All_are_there_when_everyone_is_at_once_and_each_goal_counts_once) {
  const Mission mission = with_goals(GoalPattern::kPlaces);
  Watched flight(mission);
  flight.accept();
  for (std::size_t i = 0; i < 50; ++i) flight.truth[i].position = flight.script.goals()[i];
  flight.truth[7].position += Vec2(0.16, 0.0);
  flight.script.watch(flight.truth, flight.snapshot, 1.0);
  flight.script.watch(flight.truth, flight.snapshot, 2.0);
  EXPECT_EQ(flight.script.tally().reached, 49U);
  EXPECT_FALSE(flight.script.tally().all_there_s);
  flight.truth[7].position = flight.script.goals()[7] + Vec2(0.14, 0.0);
  flight.truth[9].position += Vec2(0.2, 0.0);  // there before, but pushed away now
  flight.script.watch(flight.truth, flight.snapshot, 3.0);
  EXPECT_FALSE(flight.script.tally().all_there_s);
  flight.truth[9].position = flight.script.goals()[9];
  flight.script.watch(flight.truth, flight.snapshot, 4.0);
  EXPECT_EQ(flight.script.tally().all_there_s, 4.0);
  EXPECT_EQ(flight.script.tally().reached, 50U);
}

TEST(GoalScript, Places_are_apart_from_each_other_and_clear_of_walls_and_no_fly_areas) {
  Mission mission = with_goals(GoalPattern::kPlaces);
  mission.no_fly.push_back({.name = "mast", .outline_m = {{2.0, 2.0}, {2.4, 2.0}, {2.4, 2.4}, {2.0, 2.4}}});
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const field::Polygon mast = polygon_in_field(mission, mission.no_fly[0].outline_m);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    mission.simulation.seed = seed;
    const GoalScript script(mission);
    for (std::size_t i = 0; i < 50; ++i) {
      const Vec2& goal = script.goals()[i];
      for (int wall = 0; wall < 4; ++wall)
        EXPECT_GT(safety::wall_distance(monitored_field(mission), goal, wall), barrier.wall_distance_m);
      EXPECT_GT(field::signed_distance(mast, goal), barrier.no_fly_buffer_m);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((goal - script.goals()[j]).norm(), 1.3 * safety::barrier_radius(barrier));
    }
  }
}

TEST(GoalScript, A_swap_leads_through_the_centre) {
  const Mission mission = with_goals(GoalPattern::kSwap);
  const GoalScript script(mission);
  const std::vector<Vec2> starts = starts_in_field(mission);
  for (std::size_t i = 0; i < 50; ++i)
    EXPECT_LT((0.5 * (starts[i] + script.goals()[i]) - Vec2(2.25, 2.25)).norm(), 1e-12);
}

TEST(GoalScript, The_same_seed_sends_drones_to_the_same_places_and_another_one_elsewhere) {
  Mission mission = with_goals(GoalPattern::kErrands);
  const GoalScript first(mission);
  const GoalScript again(mission);
  EXPECT_TRUE(std::ranges::equal(first.goals(), again.goals()));
  mission.simulation.seed = 2;
  EXPECT_FALSE(std::ranges::equal(first.goals(), GoalScript(mission).goals()));
}

TEST(GoalScript, Without_room_for_everyone_it_says_so) {
  Mission mission = with_goals(GoalPattern::kPlaces);
  mission.safety.separation_m = 0.6;
  EXPECT_THROW(GoalScript{mission}, MissionError);
}

}  // namespace
}  // namespace vigil::runtime
