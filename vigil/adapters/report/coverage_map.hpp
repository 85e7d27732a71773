#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/core/field/importance.hpp"

namespace vigil::report {

/// How much of the swarm's time one cluster or area should have, and had. Shares of 1.
struct AttentionShare {
  std::string name;
  double asked = 0.0;
  double achieved = 0.0;
  double area = 0.0;  ///< of the field: what drones that fly anywhere would give it
};

/// Where the swarm should have been and where it was, on one grid of cell midpoints: (ix, iy) as in field::DensityGrid.
struct CoverageMap {
  Eigen::ArrayXXd wanted;  ///< the importance map at the end, 1/m^2; empty where there are no targets
  Eigen::ArrayXXd flown;   ///< the active drones' time, smoothed, 1/m^2; zero where no drone was ever active
  Eigen::ArrayXXd wanted_smoothed;
  double smoothing_m = 0.0;  ///< sigma of the smoothing, at most the field's longer side
  double cell_x_m = 0.0;
  double cell_y_m = 0.0;
  std::vector<AttentionShare> shares;  ///< of the targets' regions; the last one is all the rest of the field

  [[nodiscard]] bool has_targets() const { return wanted.size() > 0; }
  /// How much of two densities coincides, in [0, 1]: the integral of the lesser.
  [[nodiscard]] double overlap(const Eigen::ArrayXXd& a, const Eigen::ArrayXXd& b) const;
  /// A density that is everywhere the same.
  [[nodiscard]] Eigen::ArrayXXd uniform() const;
};

/// A cell belongs to the cluster or area that contributes most to the map there, or to the rest where the map is below
/// a twentieth of its peak. `importance` in the field frame. Time counts as the mission says: fading with memory_s, and
/// from the last "start afresh" on.
[[nodiscard]] CoverageMap coverage_map(const FlightData& data, const field::Importance& importance);

/// The importance map of another time on the same grid; empty where there are no targets.
[[nodiscard]] Eigen::ArrayXXd wanted_on_grid(const FlightData& data, const CoverageMap& map,
                                             const field::Importance& importance);

/// The active drones' time from one kept tick up to another (not included), smoothed like CoverageMap::flown.
[[nodiscard]] Eigen::ArrayXXd flown_between(const FlightData& data, const CoverageMap& map, std::size_t from,
                                            std::size_t to);

}  // namespace vigil::report
