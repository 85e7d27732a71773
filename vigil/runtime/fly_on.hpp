#pragma once

#include <functional>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/flight_summary.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorder.hpp"
#include "vigil/runtime/replayed_flight.hpp"

namespace vigil::runtime {

/// The same stretch of a flight twice.
struct TwoFlights {
  double from_s = 0.0;
  FlightSummary happened;    ///< as recorded
  FlightSummary would_have;  ///< with what was changed
};

/// What a mission with these targets is after the change.
using ChangedMission = std::function<Mission(const Mission& with_targets)>;

/// Flies on from a moment of a recorded flight by other rules, in the mission's own simulator, to where the recording
/// ends. Up to `from_s` the simulated vehicles are given the orders that were recorded, and must be seen as they were
/// seen then, bit for bit. From there the controller is another one that knows the coverage so far and what each drone
/// was about; operators and the world do what they did. `mission`: as it began; `fleet`: its vehicles, before anything
/// happened to them; `recorder`: of the flight that would have been, may be null; begun here, finished by the caller.
/// Throws, for people, std::invalid_argument where the recording ends before `from_s` or the change concerns what the
/// past depends on, and std::runtime_error where the recording cannot be recomputed up to there or the simulator does
/// not lead there. What the summaries say of the ticks' wall-clock time and of revisits was not measured.
[[nodiscard]] TwoFlights fly_on(ReplayedFlight& flight, const Mission& mission, const ChangedMission& changed,
                                double from_s, VirtualFleet& fleet, Recorder* recorder);

}  // namespace vigil::runtime
