#pragma once

#include <string>
#include <vector>

namespace vigil::ros_bridge {

/// The id with whatever ROS does not allow in a name replaced by _, behind a letter.
[[nodiscard]] std::string ros_name(const std::string& id);

/// Of two ids that become the same ROS name, and would be taken for each other, what to do; empty where there are none.
[[nodiscard]] std::string complaint_of_names(const std::vector<std::string>& ids);

/// Of a position that came on the drone's own topic, where it is in another frame than the world's or of another body:
/// what is wrong; empty where nothing is. The last parts of the frames' names count: "vicon/cf1/cf1" is "cf1".
[[nodiscard]] std::string complaint_of_frames(const std::string& id, const std::string& frame,
                                              const std::string& child);

/// Where vicon_bridge tells of a subject of one segment: "/vicon/cf1/cf1".
[[nodiscard]] std::string vicon_topic(const std::string& id);

}  // namespace vigil::ros_bridge
