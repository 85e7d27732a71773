#pragma once

#include <cstddef>
#include <vector>

#include "vigil/adapters/console/frames.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::console {

/// Where every drone has been lately, for whoever comes later. Bounded, whatever the number of drones. One thread.
class TrailRing {
 public:
  /// Keeps up to about two minutes of mission time, and fewer points a drone the more drones there are.
  explicit TrailRing(std::size_t drones);

  /// Keeps the places where a point is due.
  void add(const swarm::Snapshot& snapshot);
  [[nodiscard]] Trails trails() const;

 private:
  std::size_t drones_;
  std::size_t points_;
  double spacing_s_;
  std::vector<float> xy_;  ///< a ring of rows, one a moment, with all drones
  std::size_t rows_ = 0;   ///< ever written
  double newest_s_ = 0.0;
};

}  // namespace vigil::console
