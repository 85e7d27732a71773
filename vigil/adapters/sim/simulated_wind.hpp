#pragma once

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/core/dynamics/wind.hpp"

namespace vigil::sim {

/// The wind at one vehicle. Gusts are each vehicle's own: the worse case for keeping apart. A vehicle in the air leans
/// against the wind as it has learnt to; one on the ground learns nothing, so that the mean wind pushes it at take-off.
class SimulatedWind {
 public:
  SimulatedWind(const dynamics::Wind& wind, bool starts_flying, dynamics::RandomStream random);

  /// One step; gives the push that a vehicle in the air feels in it, m/s^2, field frame.
  [[nodiscard]] Vec2 advance(bool is_airborne, double dt_s) noexcept;

 private:
  [[nodiscard]] Vec3 draw() noexcept;
  [[nodiscard]] bool is_calm() const noexcept;

  dynamics::Wind wind_;
  dynamics::RandomStream random_;
  dynamics::WindState state_;
};

}  // namespace vigil::sim
