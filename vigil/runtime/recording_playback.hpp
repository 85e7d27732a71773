#pragma once

#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::runtime {

/// Gives a recorded flight to `recorder` as it was given to the first one: begin() to finish(). Throws what either
/// throws. `mission`: the recording's.
void play(FlightRecording& recording, const Mission& mission, Recorder& recorder);

/// What collect() holds in memory at most by itself: some 200 bytes each.
inline constexpr std::size_t kMostRows = 5'000'000;

/// A recorded flight at once: all its ticks, or, of a flight with more than `most_rows` ticks x drones, every so
/// manieth and the last, with the least clearances and any fallback of those left out. Throws what the recording
/// throws, and std::runtime_error where it has no tick.
[[nodiscard]] RecordedFlight collect(FlightRecording& recording, const Mission& mission,
                                     std::size_t most_rows = kMostRows);

}  // namespace vigil::runtime
