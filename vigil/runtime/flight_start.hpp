#pragma once

#include <optional>

#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// How a flight begins.
struct FlightStart {
  swarm::Intent first_intent = swarm::Intent::kStayDown;
  std::optional<swarm::SwarmPast> past;  ///< of an earlier run of the program
};

}  // namespace vigil::runtime
