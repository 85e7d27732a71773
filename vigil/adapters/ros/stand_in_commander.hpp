#pragma once

#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::ros_bridge {

/// What one Crazyflie makes of what it is told, as its firmware's commander does: setpoints come before high-level
/// commands until they are let go of, and who followed them and gets none levels after kLevelsAfterS and stops its
/// motors after kStopsAfterS. Height is integrated here; a planar vehicle does the rest. A value.
class StandInCommander {
 public:
  explicit StandInCommander(double altitude_m) : altitude_m_(altitude_m) {}

  /// One step: the order for the vehicle, in the world frame, which is in `mode` at `vehicle_height_m`.
  [[nodiscard]] swarm::DroneOrder step(const StandInCrazyswarm::Told& told, swarm::VehicleMode mode,
                                       double vehicle_height_m, double dt_s);

  /// Where the body is, by the vertical velocities that it was told.
  [[nodiscard]] double height_m() const { return height_m_; }
  /// How often the motors have stopped in the air because no setpoint came.
  [[nodiscard]] int falls() const { return falls_; }
  /// How many steps it was told setpoints while it stood on the ground: they start the motors of a Crazyflie.
  [[nodiscard]] int starts_by_setpoints() const { return starts_by_setpoints_; }

  static constexpr double kLevelsAfterS = 0.5;
  static constexpr double kStopsAfterS = 2.0;

 private:
  void listen(const StandInCrazyswarm::Told& told, swarm::VehicleMode mode);
  void move(const StandInCrazyswarm::Told& told, swarm::VehicleMode mode, double vehicle_height_m, double dt_s);

  double altitude_m_;
  swarm::Action wanted_ = swarm::Action::kNone;
  double height_m_ = 0.0;
  double scale_ = 1.0;  ///< of the vehicle's height: it comes down from its altitude, the body from where it was
  std::uint64_t setpoints_ = 0;
  int falls_ = 0;
  int starts_by_setpoints_ = 0;
};

}  // namespace vigil::ros_bridge
