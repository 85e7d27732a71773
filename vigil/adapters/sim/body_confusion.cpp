#include "vigil/adapters/sim/body_confusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vigil::sim {

BodyConfusion::BodyConfusion(const ConfusionParameters& parameters, std::size_t bodies, dynamics::RandomStream random)
    : parameters_(parameters), random_(random), body_of_(bodies), left_s_(bodies, 0.0) {
  std::iota(body_of_.begin(), body_of_.end(), std::size_t{0});
}

void BodyConfusion::end_those_over(double dt_s) noexcept {
  for (std::size_t drone = 0; drone < body_of_.size(); ++drone) {
    if (!is_confused(drone)) continue;
    left_s_[drone] -= dt_s;
    if (left_s_[drone] <= 0.5 * dt_s) body_of_[drone] = drone;  // its partner's time is over, too
  }
}

void BodyConfusion::begin(std::span<const runtime::TruthSample> truth, std::size_t drone) noexcept {
  std::size_t nearest = drone;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < truth.size(); ++other) {
    const double distance = (truth[other].position - truth[drone].position).squaredNorm();
    if (other == drone || distance >= least) continue;
    nearest = other;
    least = distance;
  }
  swap(drone, nearest, parameters_.swap_s);
}

void BodyConfusion::swap(std::size_t drone, std::size_t other, double for_s) noexcept {
  if (other == drone || is_confused(drone) || is_confused(other)) return;
  std::swap(body_of_[drone], body_of_[other]);
  left_s_[drone] = left_s_[other] = for_s;
}

/// A Poisson process of beginnings.
void BodyConfusion::advance(std::span<const runtime::TruthSample> truth, double dt_s) noexcept {
  end_those_over(dt_s);
  if (parameters_.swaps_per_h <= 0.0) return;
  const bool begins = random_.uniform() < -std::expm1(-parameters_.swaps_per_h / 3600.0 * dt_s);
  const auto count = static_cast<double>(truth.size());
  const auto drawn = static_cast<std::size_t>(random_.uniform() * count);  // drawn always: the stream keeps its step
  if (begins) begin(truth, std::min(drawn, truth.size() - 1));
}

}  // namespace vigil::sim
