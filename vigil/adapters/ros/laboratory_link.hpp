#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"
#include "vigil/adapters/ros/scene.hpp"

/// A laboratory that is not there: what stands in for Crazyswarm and for vicon_bridge where there are no drones. Needs
/// a Session.
namespace vigil::ros_bridge {

/// The node that flies the drones, in place of Crazyswarm. As /laboratory/fault says `hang DRONE`, that drone's
/// services do not answer until it says something else. One thread, but for the wire's own.
class StandInCrazyswarm {
 public:
  explicit StandInCrazyswarm(const std::vector<std::string>& drones);
  ~StandInCrazyswarm();
  StandInCrazyswarm(const StandInCrazyswarm&) = delete;
  StandInCrazyswarm& operator=(const StandInCrazyswarm&) = delete;

  /// What a drone has been told. Services once; `takeoff` and `land` only where it does not follow setpoints, which
  /// come first until notify_setpoints_stop lets go of them, or cmd_stop.
  struct Told {
    bool take_off = false;
    bool land = false;
    bool stop_motors = false;
    bool follows_setpoints = false;
    Point velocity_m_s;              ///< of the newest setpoint,
    double silence_s = 0.0;          ///< which came so long ago
    std::uint64_t setpoints = 0;     ///< how many ever came
    double longest_pause_s = 0.0;    ///< between the sending of two that follow each other, by their stamps
    double longest_silence_s = 0.0;  ///< for so long none came while it followed them
  };
  [[nodiscard]] Told take(std::size_t drone);

  /// Where the bodies really are, on /laboratory/bodies.
  void show(const std::vector<Point>& places);

 private:
  class Wire;
  std::unique_ptr<Wire> wire_;
};

/// The node that sees the bodies, in place of vicon_bridge: passes /laboratory/bodies on to /tf and
/// /vicon/<drone>/<drone> with a tenth of a millimetre of noise, and spoils it as /laboratory/fault (std_msgs/String)
/// says: `none`, `freeze`, `delay SECONDS` (up to 5), `swap DRONE DRONE`. Works on threads of its own until it is
/// destroyed.
class StandInVicon {
 public:
  explicit StandInVicon(const std::vector<std::string>& drones);
  ~StandInVicon();
  StandInVicon(const StandInVicon&) = delete;
  StandInVicon& operator=(const StandInVicon&) = delete;

 private:
  class Wire;
  std::unique_ptr<Wire> wire_;
};

}  // namespace vigil::ros_bridge
