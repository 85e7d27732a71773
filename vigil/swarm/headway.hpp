#pragma once

#include <array>
#include <cstddef>

#include "vigil/core/field/vec2.hpp"

namespace vigil::swarm {

/// How fast drones get ahead over the ground, as a share of what they are told, by direction: what the wind, the
/// vehicle's answer and whatever else slows them leave of it. Learned from the whole swarm, since all fly in the same
/// wind; for ways home. A value, always finite.
class Headway {
 public:
  Headway() noexcept;

  /// A drone that has been told about the same for long enough to have answered flew like this for dt_s.
  void note(const Vec2& told_m_s, const Vec2& flown_m_s, double dt_s) noexcept;

  /// At least so much is to be counted on in that direction, within [kLeast, 1]: the mean of what was seen there and
  /// beside it, less a margin.
  [[nodiscard]] double least(const Vec2& direction) const noexcept;

  static constexpr double kLeast = 0.2;

 private:
  static constexpr std::size_t kSectors = 8;
  [[nodiscard]] static std::size_t sector_of(const Vec2& direction) noexcept;

  std::array<double, kSectors> mean_;
};

}  // namespace vigil::swarm
