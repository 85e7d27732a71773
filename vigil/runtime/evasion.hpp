#pragma once

#include <span>

#include "vigil/core/field/field.hpp"

/// Whether anybody could have kept away from a drone that follows nobody. For judging what safety is worth.
namespace vigil::runtime {

/// A drone that is to keep away, as it was at the first of the moments.
struct Evader {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double speed_m_s = 0.0;  ///< that it can fly
  double lag_s = 0.0;      ///< with which it follows its orders
  double delay_s = 0.0;    ///< until orders begin to act; it goes on as it flew
};

/// What it is to keep: field frame.
struct Keep {
  field::Field field;
  double wall_distance_m = 0.0;
  double distance_m = 0.0;  ///< from the other one
};

/// Whether some straight flight at full speed, along walls where it comes to them, or hovering, would have kept the
/// evader away from `places`, where the other one was every dt_s from the first moment on: known beforehand, with
/// nobody else in the way. What cannot be evaded here no controller could have evaded, but for one that turns on its
/// way.
[[nodiscard]] bool could_evade(const Evader& evader, std::span<const Vec2> places, double dt_s, const Keep& keep);

}  // namespace vigil::runtime
