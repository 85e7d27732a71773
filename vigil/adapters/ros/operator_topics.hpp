#pragma once

#include <functional>
#include <memory>
#include <string>

namespace vigil::ros_bridge {

/// What people ask for over ROS. A wish is answered once, in words; empty: it was followed.
struct OperatorWishes {
  using Answer = std::function<void(const std::string& refusal)>;

  std::function<void(double x_m, double y_m, Answer)> add_target;  ///< world frame
  std::function<std::string()> begin_cluster;                      ///< its name
  std::function<void(Answer)> clear_targets;
  std::function<void(Answer)> start_afresh;
  std::function<void(Answer)> take_off_all;
  std::function<void(const std::string& drone, Answer)> land;  ///< empty: all
};

/// Topics and services by which people steer, beside the console:
///
///     /clicked_point       geometry_msgs/PointStamped  a target, added to the current cluster (frame "world")
///     /vigil/land          std_msgs/String             lands a drone, by its id
///     /vigil/new_cluster, /vigil/clear_targets, /vigil/start_afresh, /vigil/take_off_all, /vigil/land_all
///                          std_srvs/Trigger
///
/// Wishes are called on this object's thread. Services answer what became of the wish within two seconds.
class OperatorTopics {
 public:
  explicit OperatorTopics(OperatorWishes wishes);
  ~OperatorTopics();
  OperatorTopics(const OperatorTopics&) = delete;
  OperatorTopics& operator=(const OperatorTopics&) = delete;

 private:
  class Inputs;
  std::unique_ptr<Inputs> inputs_;
};

}  // namespace vigil::ros_bridge
