#pragma once

#include <cstddef>
#include <cstdint>

#include "vigil/adapters/ros/scene.hpp"

namespace vigil::ros_bridge {

/// A position as the tracker sent it: world frame, seconds of the clock of CrazyswarmPort::now_s().
struct Sighting {
  Point place;
  double measured_s = 0.0;  ///< by the tracker's stamp, which may be nonsense: measured_at()
  double received_s = 0.0;
  std::uint64_t number = 0;  ///< of this drone's, counted from 1; 0: none yet
};

/// When a position was measured, by the steady clock: as long before it arrived as its stamp lay behind the wall clock
/// then. A wall clock that is set moves the one message that it is set under way, and none after it.
[[nodiscard]] inline double measured_at(double arrived_s, double wall_at_arrival_s, double stamp_s) {
  return arrived_s - (wall_at_arrival_s - stamp_s);
}

/// What is streamed to one drone.
struct Setpoint {
  bool is_streamed = false;
  Point velocity_m_s;
};

enum class VehicleCall : std::uint8_t { kTakeOff, kLand, kEmergency };

/// What has become of the last service that was asked for.
enum class Answer : std::uint8_t { kWaiting, kYes, kNo };

/// Drones behind vicon_bridge (or tf) and Crazyswarm, as the control thread meets them: nothing here waits.
class CrazyswarmPort {
 public:
  virtual ~CrazyswarmPort() = default;

  /// Of a steady clock: ages and timeouts do not depend on a wall clock, which may be set.
  [[nodiscard]] virtual double now_s() const noexcept = 0;
  /// The newest that arrived; number 0 where nothing has.
  [[nodiscard]] virtual Sighting newest(std::size_t drone) noexcept = 0;
  /// Whether Crazyswarm listens to this drone's setpoints.
  [[nodiscard]] virtual bool is_connected(std::size_t drone) noexcept = 0;
  /// From the next flush() on. A setpoint stands, and is sent again and again, until the next; where flush() is not
  /// called for kStandsForS it becomes a hover.
  virtual void set(std::size_t drone, const Setpoint& setpoint) noexcept = 0;
  virtual void flush() noexcept = 0;
  /// Asks for a service of the drone; false where it could not be asked now. The drone's setpoints go on until a
  /// landing is answered by kYes; none is sent from then on until the next call, whatever is set.
  [[nodiscard]] virtual bool call(std::size_t drone, VehicleCall call) noexcept = 0;
  /// Of its last take-off or landing.
  [[nodiscard]] virtual Answer answer(std::size_t drone) noexcept = 0;

  /// Tells operators that the tracker takes one of two drones for the other; false where it could not be passed on now.
  [[nodiscard]] virtual bool tell_mistaken(std::size_t drone, std::size_t other) noexcept = 0;

  /// Tells operators why a drone's positions are not used, or (null) that they are again; false where it could not be
  /// passed on now. `why` lives for ever.
  [[nodiscard]] virtual bool tell_refused(std::size_t drone, const char* why) noexcept = 0;

  static constexpr double kStandsForS = 0.25;
};

}  // namespace vigil::ros_bridge
