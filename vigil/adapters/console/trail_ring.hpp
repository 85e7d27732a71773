#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vigil/adapters/console/frames.hpp"
#include "vigil/adapters/console/shown_drones.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::console {

/// Where every drone that is shown has been lately, for whoever comes later. Bounded, whatever the number of drones.
/// One thread.
class TrailRing {
 public:
  static constexpr double kKeptS = 120.0;  ///< about so much mission time is kept

  /// Keeps up to about two minutes of mission time, and fewer points a drone the more drones there are.
  /// `drones`: how many there are in all.
  explicit TrailRing(std::size_t drones);

  /// Takes in where everybody is now. A point is kept of every spacing_s: where the clock runs so fast that several are
  /// due since the last snapshot, they lie on the curve that has the places and velocities of both (cubic Hermite).
  void add(const swarm::Snapshot& snapshot);
  [[nodiscard]] Trails trails() const;
  [[nodiscard]] std::size_t points() const { return points_; }  ///< the most that are kept of a drone

 private:
  /// A moment of all drones: x, y by turns; places are NaN where they are not known.
  struct Moment {
    double time_s = 0.0;
    std::vector<double> places;
    std::vector<double> velocities;
  };
  [[nodiscard]] Moment moment_of(const swarm::Snapshot& snapshot) const;
  void add_row(const Moment& from, const Moment& to, double time_s);

  ShownDrones shown_;
  std::size_t drones_;  ///< that are shown
  std::size_t points_;
  double spacing_s_;
  std::vector<float> xy_;  ///< a ring of rows, one a moment, with all drones
  std::size_t rows_ = 0;   ///< ever written
  double newest_s_ = 0.0;
  std::optional<Moment> last_;
};

}  // namespace vigil::console
