#include "vigil/adapters/console/trail_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vigil::console {
namespace {

constexpr std::size_t kMostPoints = 480;     // of one drone
constexpr std::size_t kMostOfAll = 400'000;  // of all drones together
constexpr std::size_t kLeastPoints = 8;

std::size_t points_for(std::size_t drones) {
  return std::clamp(kMostOfAll / std::max<std::size_t>(drones, 1), kLeastPoints, kMostPoints);
}

}  // namespace

TrailRing::TrailRing(std::size_t drones)
    : shown_(drones),
      drones_(shown_.size()),
      points_(points_for(drones_)),
      spacing_s_(kKeptS / static_cast<double>(points_)),
      xy_(2 * drones_ * points_) {}

TrailRing::Moment TrailRing::moment_of(const swarm::Snapshot& snapshot) const {
  Moment moment{snapshot.time_s, {}, {}};
  for (const std::size_t i : shown_.drones()) {
    const swarm::DroneSnapshot& drone = snapshot.drones[i];
    const bool is_known = std::isfinite(drone.age_s);
    for (const double place : {drone.position.x(), drone.position.y()})
      moment.places.push_back(is_known ? place : std::numeric_limits<double>::quiet_NaN());
    moment.velocities.insert(moment.velocities.end(), {drone.velocity.x(), drone.velocity.y()});
  }
  return moment;
}

void TrailRing::add_row(const Moment& from, const Moment& to, double time_s) {
  const double passed_s = to.time_s - from.time_s;
  const double s = passed_s > 0.0 ? (time_s - from.time_s) / passed_s : 1.0;
  const double place0 = (2.0 * s - 3.0) * s * s + 1.0;
  const double velocity0 = passed_s * ((s - 2.0) * s + 1.0) * s;
  const double velocity1 = passed_s * (s - 1.0) * s * s;
  auto to_row = xy_.begin() + static_cast<std::ptrdiff_t>(2 * drones_ * (rows_ % points_));
  for (std::size_t i = 0; i < 2 * drones_; ++i)
    *to_row++ = static_cast<float>(s >= 1.0 ? to.places[i]
                                            : place0 * from.places[i] + (1.0 - place0) * to.places[i] +
                                                  velocity0 * from.velocities[i] + velocity1 * to.velocities[i]);
  ++rows_;
  newest_s_ = time_s;
}

void TrailRing::add(const swarm::Snapshot& snapshot) {
  constexpr double kRounding = 1e-9;
  const bool is_first = !last_ || snapshot.time_s > newest_s_ + kKeptS || snapshot.time_s < newest_s_;
  if (!is_first && snapshot.time_s < newest_s_ + spacing_s_ - kRounding) return;
  Moment now = moment_of(snapshot);
  if (is_first) {
    rows_ = 0;
    add_row(now, now, now.time_s);
  } else {
    while (newest_s_ + spacing_s_ <= now.time_s + kRounding) add_row(*last_, now, newest_s_ + spacing_s_);
  }
  last_ = std::move(now);
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
