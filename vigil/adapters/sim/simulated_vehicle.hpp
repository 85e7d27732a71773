#pragma once

#include "vigil/core/dynamics/planar_vehicle.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

/// How the simulated vehicles behave.
struct VehicleParameters {
  dynamics::PlanarVehicle motion;
  double command_delay_s = 0.0;
  double altitude_m = 1.0;
  double take_off_s = 2.0;   ///< from the ground to the altitude
  double landing_s = 2.0;    ///< from the altitude to the ground
  double emergency_s = 0.5;  ///< from the altitude to the ground with the motors stopped
};

/// One vehicle with its own autopilot, exactly as it is.
///
///     Grounded --take off--> TakingOff --at altitude--> Flying --land--> Landing --down--> Grounded
///        ^                       |  (land: Landing)        |                                  ^
///        +------- stop motors in the air: Falling ---------+----------------------------------+
///     Flying <--take_over / give_back--> Manual;   any in the air --fail--> Failed (hovers, obeys nothing but a
///     stop of its motors)
class SimulatedVehicle {
 public:
  SimulatedVehicle(const VehicleParameters& parameters, const Vec2& position, bool starts_flying);

  /// An order as it arrives at the vehicle.
  void obey(const swarm::DroneOrder& order) noexcept;
  void advance(double dt_s) noexcept;

  void fail() noexcept;
  void take_over(const Vec2& velocity) noexcept;
  void give_back() noexcept;

  [[nodiscard]] const runtime::TruthSample& truth() const noexcept { return truth_; }

 private:
  [[nodiscard]] bool is_airborne() const noexcept { return truth_.mode != swarm::VehicleMode::kGrounded; }
  void climb(double rate_m_s, double dt_s) noexcept;

  VehicleParameters parameters_;
  runtime::TruthSample truth_;
  Vec2 command_ = Vec2::Zero();  ///< the velocity that it follows
};

}  // namespace vigil::sim
