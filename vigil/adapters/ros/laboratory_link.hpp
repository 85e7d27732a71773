#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"
#include "vigil/adapters/ros/scene.hpp"

/// A laboratory that is not there: what stands in for Crazyswarm and for vicon_bridge where there are no drones. Needs
/// a Session.
namespace vigil::ros_bridge {

/// The node that flies the drones, in place of Crazyswarm. One thread, but for the wire's own.
class StandInCrazyswarm {
 public:
  explicit StandInCrazyswarm(const std::vector<std::string>& drones);
  ~StandInCrazyswarm();
  StandInCrazyswarm(const StandInCrazyswarm&) = delete;
  StandInCrazyswarm& operator=(const StandInCrazyswarm&) = delete;

  /// What a drone has been told: services once, setpoints for as long as they are newer than half a second.
  struct Told {
    bool take_off = false;
    bool land = false;
    bool stop_motors = false;
    bool has_setpoint = false;
    Point velocity_m_s;
    std::uint64_t setpoints = 0;     ///< how many ever came
    double longest_pause_s = 0.0;    ///< between the sending of two of a stream, by their stamps
    double longest_silence_s = 0.0;  ///< between the coming of two of a stream
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
