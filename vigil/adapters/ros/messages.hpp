#pragma once

#include <string>
#include <vector>

#include <geometry_msgs/Point.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "vigil/adapters/ros/scene.hpp"

/// From what is shown to ROS messages in frame "world". Of the files that speak to roscpp only.
namespace vigil::ros_bridge {

inline constexpr const char* kWorld = "world";

[[nodiscard]] geometry_msgs::Point to_message(const Point& point);
/// One red point a cell, in a field "rgba" whose alpha is the cell's share of the highest; cells of no share at all are
/// left out.
[[nodiscard]] sensor_msgs::PointCloud2 cloud_of(const DensityPicture& density, const ros::Time& now);
/// 0 to 100: percent of the highest; -1 where nobody may look.
[[nodiscard]] nav_msgs::OccupancyGrid grid_of(const DensityPicture& density, const ros::Time& now);
[[nodiscard]] visualization_msgs::Marker to_message(const Mark& mark, const ros::Time& now);
[[nodiscard]] visualization_msgs::MarkerArray to_message(const std::vector<Mark>& marks, const ros::Time& now);
[[nodiscard]] nav_msgs::Path path_of(const std::vector<Point>& places, const ros::Time& now);

}  // namespace vigil::ros_bridge
