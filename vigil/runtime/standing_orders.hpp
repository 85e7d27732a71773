#pragma once

#include <span>
#include <vector>

#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// The orders that stood when an earlier run of the program ended, given anew as commands, so that a recording has
/// them: who was landing lands, who was marked failed, taken over or had its motors stopped stays so. All else holds,
/// and nothing takes off. An order waits for its drone to say what it is doing, because before that the swarm would
/// refuse it; a newer order of an operator takes its place. The control thread only.
class StandingOrders {
 public:
  /// `standing`: one per drone, or none at all. Allocates.
  explicit StandingOrders(const std::vector<swarm::Intent>& standing);

  /// Adds those that can be given now to `commands`, within its capacity: each is given once. `observations`: of the
  /// tick before. Allocates nothing.
  void give(std::span<const swarm::DroneObservation> observations, std::vector<swarm::Command>& commands) noexcept;
  /// An operator orders something else.
  void replaced_by(const swarm::Command& command) noexcept;
  /// What stands for a drone: what has not been given yet, or what the swarm remembers.
  [[nodiscard]] swarm::Intent intent_of(std::size_t drone, const swarm::DroneMemory& memory) const noexcept;

 private:
  struct Order {
    std::size_t drone = 0;
    swarm::Intent intent = swarm::Intent::kHold;
  };
  std::vector<Order> waiting_;
};

/// The orders that stand once `orders`, which no tick has taken yet, are taken: an order that the swarm will refuse
/// changes nothing. `standing`: those after a tick, `drones`: how they were then, one per drone each.
void foresee(std::span<const swarm::Command> orders, std::span<const swarm::DroneSnapshot> drones,
             std::span<swarm::Intent> standing) noexcept;

}  // namespace vigil::runtime
