#pragma once

#include "vigil/core/field/vec2.hpp"

namespace vigil::field {

/// The monitored rectangle F = [0, length_x] x [0, length_y] in metres (the paper's L1, L2).
struct Field {
  double length_x = 0.0;
  double length_y = 0.0;

  [[nodiscard]] double area() const { return length_x * length_y; }
  [[nodiscard]] double shorter_side() const { return length_x < length_y ? length_x : length_y; }
  [[nodiscard]] bool contains(const Vec2& p) const;
  /// The point of F closest to p. Precondition: p is finite.
  [[nodiscard]] Vec2 clamp(const Vec2& p) const;
};

/// The rigid transform between the world frame W (operators, trackers) and the field frame F:
/// p_W = origin_W + R(yaw) p_F, with the yaw counter-clockwise. The paper's "moved from negative space to
/// non-negative".
struct WorldFrame {
  Vec2 origin_W = Vec2::Zero();  ///< where F's corner (0, 0) lies in the world, metres
  double yaw_rad = 0.0;          ///< from the world's x axis to the field's

  [[nodiscard]] Vec2 point_to_field(const Vec2& p_W) const;
  [[nodiscard]] Vec2 point_to_world(const Vec2& p_F) const;
  [[nodiscard]] Vec2 vector_to_field(const Vec2& v_W) const;
  [[nodiscard]] Vec2 vector_to_world(const Vec2& v_F) const;
};

}  // namespace vigil::field
