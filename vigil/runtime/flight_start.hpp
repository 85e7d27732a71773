#pragma once

#include <optional>
#include <vector>

#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// How a flight begins.
struct FlightStart {
  swarm::Intent first_intent = swarm::Intent::kStayDown;
  std::optional<swarm::SwarmPast> past;  ///< of an earlier run of the program
  /// The orders that stood when that ended, one per drone; empty: none. See StandingOrders.
  std::vector<swarm::Intent> standing{};
  bool has_real_drones = false;  ///< of which a mission says less than of those that it simulates
};

}  // namespace vigil::runtime
