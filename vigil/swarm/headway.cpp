#include "vigil/swarm/headway.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vigil::swarm {
namespace {

constexpr double kFirst = 0.8;     // before anything was seen
constexpr double kMargin = 0.1;    // what is seen in a minute may be better than what comes
constexpr double kMemoryS = 60.0;  // of flights in one direction

}  // namespace

Headway::Headway() noexcept { mean_.fill(kFirst); }

std::size_t Headway::sector_of(const Vec2& direction) noexcept {
  const double turns = std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi);
  const double sector = std::floor((turns + 1.0) * static_cast<double>(kSectors) + 0.5);
  return static_cast<std::size_t>(sector) % kSectors;
}

void Headway::note(const Vec2& told_m_s, const Vec2& flown_m_s, double dt_s) noexcept {
  const double told = told_m_s.norm();
  const double seen = told_m_s.dot(flown_m_s) / (told * told);
  if (!std::isfinite(seen)) return;
  double& mean = mean_[sector_of(told_m_s)];
  mean += std::min(1.0, dt_s / kMemoryS) * (std::clamp(seen, 0.0, 1.0) - mean);
}

double Headway::least(const Vec2& direction) const noexcept {
  if (!direction.allFinite()) return kLeast;
  const std::size_t middle = sector_of(direction);
  double least = mean_[middle];
  for (const std::size_t beside : {middle + 1, middle + kSectors - 1})
    least = std::min(least, mean_[beside % kSectors]);
  return std::clamp(least - kMargin, kLeast, 1.0);
}

}  // namespace vigil::swarm
