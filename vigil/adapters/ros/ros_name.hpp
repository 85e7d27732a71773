#pragma once

#include <string>
#include <vector>

namespace vigil::ros_bridge {

/// The id with whatever ROS does not allow in a name replaced by _, behind a letter.
[[nodiscard]] std::string ros_name(const std::string& id);

/// Of two ids that become the same ROS name, and would be taken for each other, what to do; empty where there are none.
[[nodiscard]] std::string complaint_of_names(const std::vector<std::string>& ids);

/// Where vicon_bridge tells of a subject of one segment: "/vicon/cf1/cf1".
[[nodiscard]] std::string vicon_topic(const std::string& id);

}  // namespace vigil::ros_bridge
