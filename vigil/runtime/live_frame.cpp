#include "vigil/runtime/live_frame.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace vigil::runtime {

bool is_airborne(const swarm::DroneSnapshot& drone) noexcept {
  return drone.activity != swarm::Activity::kNeverSeen && drone.mode != swarm::VehicleMode::kUnknown &&
         drone.mode != swarm::VehicleMode::kGrounded;
}

double least_airborne_pair_m(const swarm::Snapshot& snapshot) {
  std::vector<Vec2> places;
  for (const swarm::DroneSnapshot& drone : snapshot.drones)
    if (is_airborne(drone)) places.push_back(drone.position);
  std::sort(places.begin(), places.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i + 1; j < places.size() && places[j].x() - places[i].x() < least; ++j)
      least = std::min(least, (places[j] - places[i]).norm());
  return least;
}

}  // namespace vigil::runtime
