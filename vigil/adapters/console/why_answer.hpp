#pragma once

#include <atomic>
#include <cstdint>

#include "vigil/adapters/console/desk.hpp"

/// Why a drone flies as it does, as clients are told: runtime/velocity_reasons.hpp.
namespace vigil::console {

/// The message but for its id. Precondition: that of runtime::velocity_reasons_json().
[[nodiscard]] Json why_json(const swarm::SwarmState& state, swarm::DroneId drone, const runtime::Mission& mission,
                            std::uint32_t epoch);

/// `state`: of this flight, after a tick. PreviewNews, or why there is none. Any thread.
[[nodiscard]] DeskNews answer_from(const swarm::SwarmState& state, const WhyQuestion& question,
                                   const runtime::ShownFlight& flight);

/// The same of a flight that goes on: waits for its state, at most a second. Not the flight's own thread.
[[nodiscard]] DeskNews answer_of(const WhyQuestion& question, runtime::LiveMission& flight,
                                 const std::atomic<bool>& cancelled);

}  // namespace vigil::console
