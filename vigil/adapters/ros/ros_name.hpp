#pragma once

#include <string>

namespace vigil::ros_bridge {

/// The id with whatever ROS does not allow in a name replaced by _, behind a letter.
[[nodiscard]] std::string ros_name(const std::string& id);

/// Where vicon_bridge tells of a subject of one segment: "/vicon/cf1/cf1".
[[nodiscard]] std::string vicon_topic(const std::string& id);

}  // namespace vigil::ros_bridge
