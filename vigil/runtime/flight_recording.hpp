#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vigil/runtime/flight_start.hpp"
#include "vigil/runtime/recorded_flight.hpp"
#include "vigil/runtime/recorded_tick.hpp"
#include "vigil/swarm/parameters.hpp"

namespace vigil::runtime {

/// What a recording says of its flight as a whole.
struct RecordingHead {
  std::string mission_text;           ///< the effective mission file
  swarm::SwarmParameters parameters;  ///< of the controller, bit for bit
  FlightStart start;
  std::uint64_t keep_every = 1;  ///< only every so manieth tick was kept
  std::int64_t began_ns = 0;     ///< time of day at the first tick, since 1970; 0: a simulated flight
};

/// A recorded flight, for reading. What cannot be read throws std::runtime_error with place and advice. One thread at a
/// time.
class FlightRecording {
 public:
  virtual ~FlightRecording() = default;

  [[nodiscard]] virtual const RecordingHead& head() const = 0;
  /// How many ticks are kept, from the first on.
  [[nodiscard]] virtual std::uint64_t tick_count() const = 0;
  /// The kept tick `number`, counted from 0, whatever the controller called it. One after the other is fastest.
  /// Precondition: number < tick_count(); `into` is of as many drones as head().parameters.
  virtual void read(std::uint64_t number, RecordedTick& into) = 0;
  [[nodiscard]] virtual std::span<const RecordedTargets> targets() const = 0;  ///< in the order of time
  [[nodiscard]] virtual std::span<const LoggedEvent> events() const = 0;       ///< in the order of time
  /// How many ticks it kept, as it says itself at its end, that are not there any more. 0 where it was not finished.
  [[nodiscard]] virtual std::uint64_t missing_ticks() const { return 0; }
  /// Why it is not whole, for people; empty where it was finished, and all that it kept is there.
  [[nodiscard]] virtual const std::string& incomplete_reason() const = 0;
};

}  // namespace vigil::runtime
