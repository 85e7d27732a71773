#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "vigil/adapters/console/server.hpp"
#include "vigil/adapters/ros/live_view.hpp"
#include "vigil/adapters/ros/operator_topics.hpp"
#include "vigil/adapters/ros/session.hpp"

namespace vigil::apps {

/// Throws Failure where two of the mission's drones would have the same ROS name.
void check_ros_names(const runtime::Mission& mission);

/// The flight that the console serves, seen and steered over ROS as well. Wishes from there take the console's own way:
/// the same checks, roles, queue and log, under the name "ROS".
class RosSide {
 public:
  /// Throws ros_bridge::RosError where there is no ROS.
  explicit RosSide(console::Role role);

  /// To be told of everything that the desk tells. Any thread.
  void overhear(const console::DeskNews& news);
  /// From now on wishes are taken, until the server's run() is over; then release().
  void attach(console::Server& server);
  void release();
  /// Something that operators should know of: in the console, and on the program's output. Any thread.
  void warn(const std::string& text);

 private:
  using Answer = ros_bridge::OperatorWishes::Answer;

  [[nodiscard]] ros_bridge::OperatorWishes wishes();
  void ask(console::MessageBody body, const char* type, Answer answer);
  void add_target(const Vec2& place_W, Answer answer);
  [[nodiscard]] std::string begin_cluster();
  void clear_targets(Answer answer);
  void wish(swarm::CommandKind kind, const std::string& drone, Answer answer);

  console::Role role_;
  std::mutex mutex_;
  console::Server* server_ = nullptr;
  std::optional<runtime::Mission> mission_;  ///< with the present targets
  std::uint64_t revision_ = 0;
  std::string cluster_;  ///< that a click adds to
  ros_bridge::Session session_;
  ros_bridge::LiveView view_;
  std::optional<ros_bridge::OperatorTopics> topics_;
};

}  // namespace vigil::apps
