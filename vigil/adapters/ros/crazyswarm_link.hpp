#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"

namespace vigil::ros_bridge {

struct CrazyswarmSetup {
  std::vector<std::string> drones;  ///< ids: names of subjects, of tf frames, and of Crazyswarm's drones
  bool positions_by_tf = false;     ///< otherwise by vicon_bridge
  double altitude_m = 0.5;
  double take_off_s = 2.0;
  double landing_s = 2.0;
  /// Told in words what did not work, on a thread of this link.
  std::function<void(const std::string&)> tell;
};

/// Over ROS: /vicon/<drone>/<drone> (or /tf from world to <drone>) in; /<drone>/cmd_velocity_world out, again and again
/// at 50 Hz and at once when a new one is there; services /<drone>/takeoff, land, notify_setpoints_stop; motors are
/// stopped by the topic /<drone>/cmd_stop (the service `emergency` is Crazyswarm's own, and stops everybody's). Needs a
/// Session.
[[nodiscard]] std::unique_ptr<CrazyswarmPort> link_to_crazyswarm(const CrazyswarmSetup& setup);

}  // namespace vigil::ros_bridge
