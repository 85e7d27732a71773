#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace vigil::ros_bridge {

/// This program was built without ROS, no ROS master answers, or it knows another node of this name that is alive.
class RosError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// This process as a ROS node. One at a time, and before anything else of this room; it outlives all of it.
///
/// Connections between nodes live on when the master dies. A master that starts anew knows nobody: the session looks
/// for it once a second, registers everything again, and learns who else is there, while all connections stay.
class Session {
 public:
  /// `tell`: told in words when the master goes and when it is back, and when somebody shuts this node down; on the
  /// session's thread. Throws RosError where no master answers, or a node of this name is alive.
  Session(const std::string& node, std::function<void(const std::string&)> tell);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  class Watch;
  std::unique_ptr<Watch> watch_;
};

}  // namespace vigil::ros_bridge
