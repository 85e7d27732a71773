#include "vigil/runtime/goal_script.hpp"

#include <algorithm>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

/// What a drone's random stream is for.
constexpr std::uint64_t kGoalPurpose = 7;
/// Places of kPlaces are so many times the barrier's radius apart: who waits at one must not be in the way of another.
constexpr double kApart = 1.3;
constexpr int kMostDarts = 2000;

/// Goals keep clear of what the barrier keeps clear of, and of a little more.
FreePlaces reachable_places(const Mission& mission) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const double reserve_m = safety::wall_reserve(barrier, {});
  const double more_m = 0.1 * safety::barrier_radius(barrier);
  return {mission, barrier.wall_distance_m + reserve_m + more_m, safety::no_fly_radius(barrier, reserve_m) + more_m};
}

/// Whether nobody else has said what it is to do: an operator who holds it, or lands it, is obeyed.
bool may_be_sent(swarm::Activity activity) {
  using swarm::Activity;
  return activity == Activity::kActive || activity == Activity::kTravelling || activity == Activity::kRecovering;
}

}  // namespace

GoalScript::GoalScript(const Mission& mission)
    : pattern_(mission.simulation.goals->pattern),
      places_(reachable_places(mission)),
      radius_m_(goal_radius_m(mission)),
      goals_(starts_in_field(mission)),
      is_pending_(goals_.size(), 1),
      has_reached_(goals_.size(), 0) {
  random_.reserve(goals_.size());
  for (std::size_t i = 0; i < goals_.size(); ++i) random_.emplace_back(mission.simulation.seed, i, kGoalPurpose);
  switch (pattern_) {
    case GoalPattern::kErrands:
      for (std::size_t i = 0; i < goals_.size(); ++i) goals_[i] = draw(i);
      break;
    case GoalPattern::kPlaces:
      draw_apart(mission);
      break;
    case GoalPattern::kSwap:
      for (Vec2& goal : goals_) goal = mission.field.size_m - goal;
      break;
  }
}

Vec2 GoalScript::draw(std::size_t drone) {
  Vec2 place = places_.dart(random_[drone]);
  for (int i = 0; i < kMostDarts && !places_.is_free(place); ++i) place = places_.dart(random_[drone]);
  return place;
}

void GoalScript::draw_apart(const Mission& mission) {
  const double apart = kApart * safety::barrier_radius(barrier_parameters(mission));
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const auto is_apart = [&](const Vec2& place) {
      return std::all_of(goals_.begin(), goals_.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const Vec2& other) { return (other - place).norm() >= apart; });
    };
    int darts = 0;
    do goals_[i] = draw(i);
    while (!is_apart(goals_[i]) && ++darts < kMostDarts);
    if (darts == kMostDarts)
      throw MissionError({.place = "",
                          .key = "simulation.goals",
                          .value = "",
                          .problem = "finds no room for a place for each drone",
                          .valid = "must leave room for places 1.3 times the barrier's radius apart",
                          .advice = "take a larger field or fewer drones"});
  }
}

void GoalScript::play(const swarm::Snapshot& last, std::vector<swarm::Command>& commands) const {
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    if (is_pending_[i] != 0 && may_be_sent(last.drones[i].activity))
      commands.push_back(
          {.kind = swarm::CommandKind::kGoTo, .drone = swarm::DroneId(i), .place = goals_[i], .target = {}});
  }
}

void GoalScript::watch(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot, double time_s) {
  for (const swarm::Event& event : snapshot.events)
    if (event.kind == swarm::EventKind::kWishAccepted && event.wish == swarm::CommandKind::kGoTo)
      is_pending_[event.drone.index()] = 0;
  bool are_all_there = true;
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const bool is_there = (truth[i].position - goals_[i]).norm() < radius_m_;
    are_all_there = are_all_there && is_there;
    if (!is_there || has_reached_[i] != 0) continue;
    ++tally_.reached;
    has_reached_[i] = 1;
    if (pattern_ != GoalPattern::kErrands) continue;
    goals_[i] = draw(i);
    has_reached_[i] = 0;
    is_pending_[i] = 1;
  }
  if (are_all_there && pattern_ != GoalPattern::kErrands && !tally_.all_there_s) tally_.all_there_s = time_s;
}

}  // namespace vigil::runtime
