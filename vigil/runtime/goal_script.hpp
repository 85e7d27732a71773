#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/free_places.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/command.hpp"

namespace vigil::runtime {

/// What came of goals, by ground truth.
struct GoalTally {
  std::uint64_t reached = 0;          ///< goals
  std::optional<double> all_there_s;  ///< first time at which every drone was at its goal at once; never for kErrands
};

/// Sends drones to places as simulation.goals says, and sees who gets there.
class GoalScript {
 public:
  /// Precondition: a mission that mission checks accepted and that has goals. Throws MissionError where no room for the
  /// goals of kPlaces is found.
  explicit GoalScript(const Mission& mission);

  /// The commands that are due, to drones that cover, travel or recover. `last`: of the tick before, empty before the
  /// first; a goal is given anew until the controller has accepted it. Adds to `commands`.
  void play(const swarm::Snapshot& last, std::vector<swarm::Command>& commands) const;

  /// Where the drones really are at time_s: counts who has reached its goal, and draws new ones for kErrands.
  void watch(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot, double time_s);

  [[nodiscard]] const GoalTally& tally() const noexcept { return tally_; }
  /// Of each drone, field frame.
  [[nodiscard]] std::span<const Vec2> goals() const noexcept { return goals_; }

 private:
  [[nodiscard]] Vec2 draw(std::size_t drone);
  void draw_apart(const Mission& mission);

  GoalPattern pattern_;
  FreePlaces places_;
  double radius_m_;
  std::vector<dynamics::RandomStream> random_;  ///< of each drone
  std::vector<Vec2> goals_;
  std::vector<char> is_pending_;  ///< not yet accepted by the controller
  std::vector<char> has_reached_;
  GoalTally tally_;
};

}  // namespace vigil::runtime
