#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vigil/adapters/ros/scene.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/mission.hpp"

/// What a tick decided as it is drawn over ROS. Precondition of all: a mission that mission checks accepted, and a
/// frame of its drones.
namespace vigil::ros_bridge {

/// Each drone with its name, a circle of half of R_s (where two of them touch, the drones are R_s apart), and lines to
/// what holds it back: another drone, a wall, a no-fly outline.
[[nodiscard]] std::vector<Mark> drone_marks(const runtime::Mission& mission, const swarm::Snapshot& snapshot);

/// metric_percent, smallest_distance_m, active_drones, oldest_position_s, oldest_link_s; and of each drone
/// <drone>/age_s. What is not known is not in it.
[[nodiscard]] std::vector<Figure> figures_of(const runtime::Mission& mission, const swarm::Snapshot& snapshot);

/// One line a drone: what it does, or what is wrong with it and what to do.
[[nodiscard]] std::vector<Diagnosis> diagnoses_of(const runtime::Mission& mission, const swarm::Snapshot& snapshot);

/// Where the drones have been while they were in the air. One thread.
class Trails {
 public:
  /// Of each drone; when they are full, the oldest are left out.
  static constexpr std::size_t kMostPoints = 4000;

  explicit Trails(const runtime::Mission& mission);

  void add(const swarm::Snapshot& snapshot);
  [[nodiscard]] const std::vector<Point>& of(std::size_t drone) const { return places_.at(drone); }
  /// One line a drone, in its own green.
  [[nodiscard]] std::vector<Mark> marks() const;

 private:
  const runtime::Mission& mission_;
  double spacing_m_;
  std::vector<std::vector<Point>> places_;
};

}  // namespace vigil::ros_bridge
