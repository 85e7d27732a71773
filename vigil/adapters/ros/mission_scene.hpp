#pragma once

#include <cstddef>
#include <vector>

#include "vigil/adapters/ros/scene.hpp"
#include "vigil/runtime/mission.hpp"

/// A mission's places as they are drawn over ROS. Precondition of all: a mission that mission checks accepted.
namespace vigil::ros_bridge {

/// What RViz still draws smoothly without a graphics card.
inline constexpr int kDensityCells = 128;  ///< of a picture's longer side

/// A place of the field frame in the world frame, at this height.
[[nodiscard]] Point in_world(const runtime::Mission& mission, const Vec2& place, double z_m);

/// The importance map (2); all zero where there is nothing to look at.
[[nodiscard]] DensityPicture density_picture(const runtime::Mission& mission);

/// The ground (so that a click anywhere on it is one on something), the field's border, target points, each cluster's
/// ellipse of two standard deviations, areas, and no-fly polygons.
[[nodiscard]] std::vector<Mark> target_marks(const runtime::Mission& mission);

/// Drone number `drone` of `drones`: each its own green, as in the paper's Fig. 2.
[[nodiscard]] Colour green_of(std::size_t drone, std::size_t drones);

}  // namespace vigil::ros_bridge
