#pragma once

#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::runtime {

/// Gives a recorded flight to `recorder` as it was given to the first one: begin() to finish(). Throws what either
/// throws. `mission`: the recording's.
void play(FlightRecording& recording, const Mission& mission, Recorder& recorder);

/// All of a recorded flight at once. Throws what the recording throws, and std::runtime_error where it has no tick.
[[nodiscard]] RecordedFlight collect(FlightRecording& recording, const Mission& mission);

}  // namespace vigil::runtime
