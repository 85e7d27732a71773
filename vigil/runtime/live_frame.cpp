#include "vigil/runtime/live_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vigil/core/safety/neighbour_grid.hpp"

namespace vigil::runtime {

bool is_airborne(const swarm::DroneSnapshot& drone) noexcept {
  return drone.activity != swarm::Activity::kNeverSeen && drone.mode != swarm::VehicleMode::kUnknown &&
         drone.mode != swarm::VehicleMode::kGrounded;
}

double least_airborne_pair_m(const swarm::Snapshot& snapshot) {
  std::vector<Vec2> places;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const swarm::DroneSnapshot& drone : snapshot.drones) {
    if (!is_airborne(drone) || !drone.position.allFinite()) continue;
    places.push_back(drone.position);
    low = low.cwiseMin(drone.position);
    high = high.cwiseMax(drone.position);
  }
  double least = std::numeric_limits<double>::infinity();
  if (places.size() < 2) return least;
  // In a grid of about a cell a drone, and no further than the least so far: as quick in a crowd as in a row.
  constexpr double kLeastSide = 1e-6;
  const Vec2 size = (high - low).cwiseMax(kLeastSide);
  const double cell = std::sqrt(size.x() * size.y() / static_cast<double>(places.size()));
  safety::NeighbourGrid grid({size.x(), size.y()}, std::max(cell, kLeastSide), places.size());
  grid.sort(places.size(), [&](std::size_t i) -> Vec2 { return places[i] - low; });
  const auto sorted = grid.sorted();
  for (std::size_t own = 0; own < places.size(); ++own) {
    const Vec2& place = places[sorted[own]];
    grid.visit_parts(place - low, least, [&](std::size_t first, std::size_t last) {
      for (first = std::max(first, own + 1); first < last; ++first)
        least = std::min(least, (places[sorted[first]] - place).norm());
    });
  }
  return least;
}

}  // namespace vigil::runtime
