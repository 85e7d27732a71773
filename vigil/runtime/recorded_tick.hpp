#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vigil/runtime/recorder.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// What of a recorded tick is not as it was written.
struct Damage {
  std::optional<std::size_t> drone;  ///< whose; none: what concerns the whole tick
  const char* what = "";             ///< for people: what of it
};

/// One tick as a recording holds it. Field frame.
struct RecordedTick {
  explicit RecordedTick(std::size_t drones) : observations(drones), snapshot(drones) {}

  /// What the tick was given. Where only every nth tick was kept, what was known of each drone.
  std::vector<swarm::DroneObservation> observations;
  std::vector<swarm::Command> commands;
  /// What it decided, without its events. Positions and all else that follows from `observations` are filled in by
  /// Recollection.
  swarm::Snapshot snapshot;
  std::vector<TruthSample> truth;  ///< empty where nobody knew it
  Clearances clearances;
  std::optional<Damage> damage;  ///< the first that was found
};

}  // namespace vigil::runtime
