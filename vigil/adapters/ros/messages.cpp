#include "vigil/adapters/ros/messages.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

#include <geometry_msgs/Pose.h>

namespace vigil::ros_bridge {
namespace {

/// Density lies on the ground, below whatever is drawn at z = 0.
constexpr double kGroundZ = -0.005;

geometry_msgs::Quaternion turned_by(double yaw_rad) {
  geometry_msgs::Quaternion turn;
  turn.z = std::sin(yaw_rad / 2.0);
  turn.w = std::cos(yaw_rad / 2.0);
  return turn;
}

sensor_msgs::PointField field_of(const char* name, std::uint32_t offset, std::uint8_t type) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = type;
  field.count = 1;
  return field;
}

/// A point as it lies in a cloud's bytes.
struct CloudPoint {
  float x;
  float y;
  float z;
  std::uint32_t rgba;
};

std::uint32_t red_of(float share) {
  constexpr std::uint32_t kRed = 0xFFU << 16U;
  return static_cast<std::uint32_t>(std::lround(255.0F * share)) << 24U | kRed;
}

CloudPoint point_of(const DensityPicture& density, std::size_t row, std::size_t column, float share) {
  const double along = (static_cast<double>(column) + 0.5) * density.column_m;
  const double across = (static_cast<double>(row) + 0.5) * density.row_m;
  const double c = std::cos(density.yaw_rad);
  const double s = std::sin(density.yaw_rad);
  return {static_cast<float>(density.corner.x + c * along - s * across),
          static_cast<float>(density.corner.y + s * along + c * across), static_cast<float>(kGroundZ), red_of(share)};
}

std::int32_t type_of(Mark::Kind kind) {
  using visualization_msgs::Marker;
  switch (kind) {
    case Mark::Kind::kLineStrip:
      return Marker::LINE_STRIP;
    case Mark::Kind::kLines:
      return Marker::LINE_LIST;
    case Mark::Kind::kPoints:
      return Marker::POINTS;
    case Mark::Kind::kCylinder:
      return Marker::CYLINDER;
    case Mark::Kind::kBox:
      return Marker::CUBE;
    case Mark::Kind::kText:
      break;
  }
  return Marker::TEXT_VIEW_FACING;
}

bool has_points(Mark::Kind kind) {
  return kind == Mark::Kind::kLineStrip || kind == Mark::Kind::kLines || kind == Mark::Kind::kPoints;
}

/// RViz complains of lines without two ends.
bool is_nothing(const Mark& mark) {
  const std::size_t least = mark.kind == Mark::Kind::kPoints ? 1 : 2;
  return has_points(mark.kind) && mark.points.size() < least;
}

}  // namespace

geometry_msgs::Point to_message(const Point& point) {
  geometry_msgs::Point message;
  message.x = point.x;
  message.y = point.y;
  message.z = point.z;
  return message;
}

sensor_msgs::PointCloud2 cloud_of(const DensityPicture& density, const ros::Time& now) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = kWorld;
  cloud.header.stamp = now;
  cloud.fields = {field_of("x", 0, PointField::FLOAT32), field_of("y", 4, PointField::FLOAT32),
                  field_of("z", 8, PointField::FLOAT32), field_of("rgba", 12, PointField::UINT32)};
  cloud.point_step = sizeof(CloudPoint);
  for (std::size_t i = 0; i < density.share_of_highest.size(); ++i) {
    const float share = density.share_of_highest[i];
    if (!(share > 0.002F)) continue;  // an alpha of 0
    const CloudPoint point = point_of(density, i / density.columns, i % density.columns, share);
    cloud.data.resize(cloud.data.size() + sizeof(point));
    std::memcpy(cloud.data.data() + cloud.data.size() - sizeof(point), &point, sizeof(point));
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(cloud.data.size() / sizeof(CloudPoint));
  cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
  cloud.is_dense = 1U;
  return cloud;
}

nav_msgs::OccupancyGrid grid_of(const DensityPicture& density, const ros::Time& now) {
  nav_msgs::OccupancyGrid grid;
  grid.header.frame_id = kWorld;
  grid.header.stamp = now;
  grid.info.map_load_time = now;
  grid.info.resolution = static_cast<float>(density.column_m);
  grid.info.width = static_cast<std::uint32_t>(density.columns);
  grid.info.height = static_cast<std::uint32_t>(density.rows);
  grid.info.origin.position = to_message(density.corner);
  grid.info.origin.orientation = turned_by(density.yaw_rad);
  for (const float share : density.share_of_highest)
    grid.data.push_back(static_cast<std::int8_t>(std::isnan(share) ? -1L : std::lround(100.0F * share)));
  return grid;
}

visualization_msgs::Marker to_message(const Mark& mark, const ros::Time& now) {
  visualization_msgs::Marker message;
  message.header.frame_id = kWorld;
  message.header.stamp = now;
  message.ns = mark.set;
  message.id = mark.id;
  message.type = type_of(mark.kind);
  message.action = is_nothing(mark) ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  message.pose.position = to_message(mark.place);
  message.pose.orientation = turned_by(mark.yaw_rad);
  message.scale.x = mark.size.x;
  message.scale.y = mark.size.y;
  message.scale.z = mark.size.z;
  message.color.r = mark.colour.red;
  message.color.g = mark.colour.green;
  message.color.b = mark.colour.blue;
  message.color.a = mark.colour.alpha;
  message.text = mark.text;
  for (const Point& point : mark.points) message.points.push_back(to_message(point));
  return message;
}

visualization_msgs::MarkerArray to_message(const std::vector<Mark>& marks, const ros::Time& now) {
  visualization_msgs::MarkerArray message;
  for (const Mark& mark : marks) message.markers.push_back(to_message(mark, now));
  return message;
}

nav_msgs::Path path_of(const std::vector<Point>& places, const ros::Time& now) {
  nav_msgs::Path path;
  path.header.frame_id = kWorld;
  path.header.stamp = now;
  for (const Point& place : places) {
    geometry_msgs::PoseStamped pose;
    pose.header = path.header;
    pose.pose.position = to_message(place);
    pose.pose.orientation.w = 1.0;
    path.poses.push_back(pose);
  }
  return path;
}

}  // namespace vigil::ros_bridge
