#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vigil/adapters/report/flight_data.hpp"

namespace vigil::report {

/// Between the active drones at one tick: each one's distance to its nearest active neighbour.
struct NearestDistances {
  std::size_t tick = 0;
  double least_m = 0.0;
  double low_m = 0.0;  ///< a tenth of the drones have a nearer neighbour
  double median_m = 0.0;
  double high_m = 0.0;  ///< a tenth of the drones have none so near
};

/// The distributions at a few hundred ticks, fewer for very many drones; ticks with less than two active drones are
/// left out.
[[nodiscard]] std::vector<NearestDistances> nearest_distances(const FlightData& data);

/// Whether a drone is on the ground at a tick: it says so, or it is lower than what counts as landed. Ground truth
/// where there is any, else what was known.
[[nodiscard]] bool is_down(const FlightData& data, std::size_t tick, std::size_t drone);

/// The closest that an active drone came to one that had been active and now lies on the ground. One that is still in
/// the air is none of these: whoever comes close to it is in danger.
struct ClosestToLost {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t tick = 0;
  std::size_t active = 0;
  std::size_t lost = 0;
};

/// Over every kept tick. Infinite where there was no such pair.
[[nodiscard]] ClosestToLost closest_to_lost(const FlightData& data);

/// Distance between two drones at one tick; NaN where a place is unknown.
[[nodiscard]] double distance_m(const FlightData& data, std::size_t tick, std::size_t a, std::size_t b);

}  // namespace vigil::report
