#pragma once

#include <span>
#include <string>
#include <string_view>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/flight_start.hpp"
#include "vigil/runtime/mission_targets.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// Smallest distances between drones by ground truth (or, in a live flight, by what is known). Infinity where no such
/// pair, or drone, is there.
struct Clearances {
  double airborne_pair_m = swarm::DroneObservation::kNever;  ///< between drones that are both in the air
  double active_pair_m = swarm::DroneObservation::kNever;    ///< between drones that are both active
  double wall_m = swarm::DroneObservation::kNever;  ///< from an airborne drone to the field's border; negative outside
  double no_fly_m = swarm::DroneObservation::kNever;  ///< from an airborne drone to a no-fly outline; negative inside
};

/// One tick, as it is kept.
struct TickRecord {
  const swarm::Snapshot& snapshot;                        ///< what it decided
  std::span<const swarm::DroneObservation> observations;  ///< what it was given, one per drone
  std::span<const swarm::Command> commands;
  std::span<const TruthSample> truth;  ///< empty in a live flight
  Clearances clearances;
};

/// Something that happened, in words: who, what, to which drone.
struct LoggedEvent {
  double time_s = 0.0;
  std::string source;  ///< "operator", "mission", "world", "swarm"
  std::string what;    ///< a word of the event's kind, snake_case
  std::string drone;   ///< an id, "all", or empty
  std::string detail;  ///< for people
};

/// Where a flight is written. Errors surface as exceptions of std::runtime_error from begin(), and from finish(), which
/// says whether all of it was kept; record() and log() never throw, so that a full disk does not end a flight.
class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void begin(const Mission& mission, const FlightStart& start) = 0;
  virtual void record(const TickRecord& tick) noexcept = 0;
  virtual void log(const LoggedEvent& event) noexcept = 0;
  /// The targets and no-fly polygons that hold from time_s on.
  virtual void targets(double time_s, const MissionTargets& targets) noexcept = 0;
  /// What was given so far outlives this program from here on, however it ends.
  virtual void flush() noexcept {}
  /// Why nothing more, or not everything, is kept, for people; empty where all is well.
  [[nodiscard]] virtual std::string trouble() const { return {}; }
  virtual void finish() = 0;
};

}  // namespace vigil::runtime
