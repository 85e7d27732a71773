#pragma once

#include <cmath>
#include <vector>

#include "vigil/swarm/tick.hpp"

/// A small swarm that is in the air, for tests.
namespace vigil::swarm {

inline constexpr double kDt = 0.02;

/// As many drones in 3 m x 3 m as you like, by the numbers of the paper's laboratory; they cover from the first tick.
inline SwarmParameters laboratory(std::size_t drones) {
  SwarmParameters parameters;
  parameters.field = {3.0, 3.0};
  parameters.drones = drones;
  parameters.dt_s = kDt;
  parameters.barrier.separation_m = 0.2;
  parameters.barrier.contact_distance_m = 0.1;
  parameters.barrier.wall_distance_m = 0.17;
  parameters.barrier.u_max_m_s = 0.3;
  parameters.barrier.dt_s = kDt;
  parameters.first_intent = Intent::kCover;
  return parameters;
}

/// A drone that flies, seen and heard just now.
inline DroneObservation flying_at(const Vec2& position) {
  DroneObservation seen;
  seen.position = position;
  seen.height_m = 1.0;
  seen.age_s = 0.0;
  seen.link_age_s = 0.0;
  seen.mode = VehicleMode::kFlying;
  return seen;
}

inline Command wish(CommandKind kind, std::size_t drone) {
  return {.kind = kind, .drone = DroneId(drone), .target = {}};
}

/// Ideal drones around a tick: what is asked for happens.
class IdealWorld {
 public:
  IdealWorld(const SwarmParameters& parameters, const std::vector<Vec2>& starts)
      : state(parameters), snapshot(parameters.drones) {
    for (const Vec2& start : starts) observations.push_back(flying_at(start));
  }

  void step(const std::vector<Command>& commands = {}) {
    tick(state, observations, commands, snapshot);
    for (std::size_t i = 0; i < observations.size(); ++i)
      observations[i].position += snapshot.drones[i].order.velocity * kDt;
  }
  void run(double seconds) {
    for (double t = 0.0; t < seconds; t += kDt) step();
  }
  void land(std::size_t drone) {
    observations[drone].mode = VehicleMode::kGrounded;
    observations[drone].height_m = 0.0;
  }
  [[nodiscard]] double distance(std::size_t a, std::size_t b) const {
    return (observations[a].position - observations[b].position).norm();
  }
  /// The least distance of two drones in so many seconds from now.
  [[nodiscard]] double least_distance(std::size_t a, std::size_t b, double seconds) {
    double least = HUGE_VAL;
    for (double t = 0.0; t < seconds; t += kDt) {
      step();
      least = std::min(least, distance(a, b));
    }
    return least;
  }
  [[nodiscard]] Activity activity(std::size_t drone) const { return snapshot.drones[drone].activity; }

  SwarmState state;
  Snapshot snapshot;
  std::vector<DroneObservation> observations;
};

}  // namespace vigil::swarm
