#include "vigil/core/field/field.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace vigil::field {

bool Field::contains(const Vec2& p) const {
  return p.x() >= 0.0 && p.x() <= length_x && p.y() >= 0.0 && p.y() <= length_y;
}

Vec2 Field::clamp(const Vec2& p) const { return {std::clamp(p.x(), 0.0, length_x), std::clamp(p.y(), 0.0, length_y)}; }

Vec2 WorldFrame::point_to_field(const Vec2& p_W) const { return vector_to_field(p_W - origin_W); }

Vec2 WorldFrame::point_to_world(const Vec2& p_F) const { return origin_W + vector_to_world(p_F); }

Vec2 WorldFrame::vector_to_field(const Vec2& v_W) const { return Eigen::Rotation2Dd(-yaw_rad) * v_W; }

Vec2 WorldFrame::vector_to_world(const Vec2& v_F) const { return Eigen::Rotation2Dd(yaw_rad) * v_F; }

}  // namespace vigil::field
