#include "vigil/adapters/console/trail_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil::console {
namespace {

constexpr double kKeptS = 120.0;
constexpr std::size_t kMostPoints = 480;     // of one drone
constexpr std::size_t kMostOfAll = 400'000;  // of all drones together
constexpr std::size_t kLeastPoints = 8;

std::size_t points_for(std::size_t drones) {
  return std::clamp(kMostOfAll / std::max<std::size_t>(drones, 1), kLeastPoints, kMostPoints);
}

}  // namespace

TrailRing::TrailRing(std::size_t drones)
    : drones_(drones),
      points_(points_for(drones)),
      spacing_s_(kKeptS / static_cast<double>(points_)),
      xy_(2 * drones * points_) {}

void TrailRing::add(const swarm::Snapshot& snapshot) {
  constexpr double kRounding = 1e-9;
  if (rows_ > 0 && snapshot.time_s < newest_s_ + spacing_s_ - kRounding) return;
  auto to = xy_.begin() + static_cast<std::ptrdiff_t>(2 * drones_ * (rows_ % points_));
  for (const swarm::DroneSnapshot& drone : snapshot.drones) {
    const bool is_known = std::isfinite(drone.age_s);
    *to++ = is_known ? static_cast<float>(drone.position.x()) : std::numeric_limits<float>::quiet_NaN();
    *to++ = is_known ? static_cast<float>(drone.position.y()) : std::numeric_limits<float>::quiet_NaN();
  }
  ++rows_;
  newest_s_ = snapshot.time_s;
}

Trails TrailRing::trails() const {
  const std::size_t kept = std::min(rows_, points_);
  Trails trails{drones_, kept, spacing_s_, newest_s_, {}};
  trails.xy.reserve(2 * drones_ * kept);
  for (std::size_t drone = 0; drone < drones_; ++drone) {
    for (std::size_t n = rows_ - kept; n < rows_; ++n) {
      const auto* const from = xy_.data() + 2 * (drones_ * (n % points_) + drone);
      trails.xy.insert(trails.xy.end(), from, from + 2);
    }
  }
  return trails;
}

}  // namespace vigil::console
