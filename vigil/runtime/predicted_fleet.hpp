#pragma once

#include <span>
#include <vector>

#include "vigil/core/dynamics/planar_vehicle.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/snapshot.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// How a mission's vehicles behave on average.
struct PredictedVehicle {
  dynamics::PlanarVehicle motion;
  double gain = 1.0;  ///< steady speed over ordered speed
  double altitude_m = 1.0;
  double take_off_s = 0.0;
  double landing_s = 0.0;
  double emergency_s = 0.0;
};

/// Of a recorded autopilot: its steady gain, and the lag that the safety filter is set up with, which is the one that
/// comes closest to it. lag_s: that lag. Precondition: a mission that mission checks accepted.
[[nodiscard]] PredictedVehicle predicted_vehicle(const Mission& mission, double lag_s);

/// Drones as they will most likely fly: without noise, gusts, losses or faults, under orders that act at once. What is
/// wrong with a drone stays wrong; where there are stations its battery is emptied as it has been, and charged on their
/// pads, else it stays as it is; whoever has it (a pilot, nobody) lets it hover. One
/// thread at a time.
class PredictedFleet {
 public:
  /// From next_motion() of the state on.
  PredictedFleet(const swarm::SwarmState& now, const PredictedVehicle& vehicle);

  /// The drones as they are now.
  [[nodiscard]] std::span<const swarm::DroneObservation> observations() const noexcept { return drones_; }
  /// Lets dt_s pass under the orders of a tick. Precondition: as many as drones.
  void advance(std::span<const swarm::DroneSnapshot> ordered, double dt_s) noexcept;

 private:
  void obey(swarm::DroneObservation& drone, swarm::Action action) const noexcept;
  void move(swarm::DroneObservation& drone, const swarm::DroneOrder& order, double dt_s) const noexcept;
  void climb(swarm::DroneObservation& drone, double dt_s) const noexcept;
  void wear(swarm::DroneObservation& drone, double rate_per_s, double dt_s) const noexcept;

  PredictedVehicle vehicle_;
  double seen_within_s_;
  double heard_within_s_;
  std::vector<swarm::DroneObservation> drones_;
  std::vector<swarm::ChargingPad> pads_;
  std::vector<double> rates_per_s_;  ///< of each drone's battery in the air
};

}  // namespace vigil::runtime
