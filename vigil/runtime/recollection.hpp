#pragma once

#include <cstdint>
#include <vector>

#include "vigil/runtime/flight_recording.hpp"

namespace vigil::runtime {

/// Fills in what a recording leaves out because it follows from observations: what the controller knew of each drone.
class Recollection {
 public:
  explicit Recollection(const RecordingHead& head);

  /// Completes tick.snapshot. Ticks in their order; what lies in a gap between two of them is not known.
  void complete(RecordedTick& tick) noexcept;

 private:
  double dt_s_;
  double reserve_;
  bool is_thinned_;
  std::vector<swarm::DroneMemory> drones_;
};

}  // namespace vigil::runtime
