#pragma once

#include "vigil/core/guidance/goal_seeker.hpp"
#include "vigil/core/guidance/step_aside.hpp"
#include "vigil/core/guidance/way_map.hpp"
#include "vigil/core/safety/barrier.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/parameters.hpp"

/// How drones that have a place to go to are led, by the swarm's parameters.
namespace vigil::swarm {

/// The scales of a crowd.
inline guidance::SeekerParameters seeker_parameters(const SwarmParameters& parameters) {
  return {.u_max_m_s = parameters.barrier.u_max_m_s,
          .spacing_m = safety::barrier_radius(parameters.barrier),
          .lag_s = parameters.barrier.lag_s,
          .dt_s = parameters.dt_s};
}

/// What ways keep clear of: what the safety filter does.
inline guidance::WayParameters way_parameters(const SwarmParameters& parameters) {
  const safety::BarrierParameters& barrier = parameters.barrier;
  const double reserve_m = safety::wall_reserve(barrier, {});
  return {.field = parameters.field,
          .wall_distance_m = barrier.wall_distance_m + reserve_m,
          .clearance_m = safety::no_fly_radius(barrier, reserve_m),
          .most_edges = kMaxNoFlyEdges};
}

/// Beside what flies as it likes: what the barrier keeps, and a little, so that it need not push.
inline guidance::AsideParameters aside_parameters(const SwarmParameters& parameters) {
  const safety::BarrierParameters& barrier = parameters.barrier;
  constexpr double kRoom = 1.25;
  return {.field = parameters.field,
          .wall_distance_m = barrier.wall_distance_m + safety::wall_reserve(barrier, {}),
          .room_m = kRoom * safety::barrier_radius(barrier),
          .u_max_m_s = barrier.u_max_m_s,
          .answer_s = barrier.lag_s + parameters.command_delay_s + parameters.observation_delay_s};
}

}  // namespace vigil::swarm
