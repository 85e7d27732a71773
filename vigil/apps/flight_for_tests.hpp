#pragma once

#include <chrono>

#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::apps {

/// For flights whose ticks nobody times.
inline std::chrono::nanoseconds no_clock() { return {}; }

/// The mission from its first tick to its last, without a recording.
inline runtime::FlightSummary fly(const runtime::Mission& mission) {
  const auto fleet = simulated_fleet(mission);
  runtime::VirtualFlight flight(mission, *fleet, nullptr, no_clock);
  while (!flight.is_over()) flight.step();
  return flight.summary();
}

}  // namespace vigil::apps
