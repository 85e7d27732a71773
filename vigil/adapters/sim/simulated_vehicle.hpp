#pragma once

#include <optional>

#include "vigil/adapters/sim/planar_motion.hpp"
#include "vigil/adapters/sim/position_hold.hpp"
#include "vigil/adapters/sim/simulated_battery.hpp"
#include "vigil/core/dynamics/failsafe.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

/// How the simulated vehicles behave.
struct VehicleParameters {
  MotionModel motion;
  dynamics::Failsafe failsafe;               ///< by default it follows the last velocity for ever
  std::optional<BatteryParameters> battery;  ///< none: it is never empty, and says nothing of it
  double position_hold_per_s = 0.0;          ///< see PositionHold; 0: none
  double command_delay_s = 0.0;              ///< beside a loop's own dead time
  double altitude_m = 1.0;
  double take_off_s = 2.0;   ///< from the ground to the altitude
  double landing_s = 2.0;    ///< from the altitude to the ground
  double emergency_s = 0.5;  ///< from the altitude to the ground with the motors stopped
};

/// The dead time between a command's arrival and the vehicle's answer.
[[nodiscard]] double response_delay_s(const MotionModel& motion) noexcept;

/// One vehicle with its own autopilot, exactly as it is.
///
///     Grounded --take off--> TakingOff --at altitude--> Flying --land--> Landing --down--> Grounded
///        ^                       |  (land: Landing)        |                                  ^
///        +------- stop motors in the air: Falling ---------+----------------------------------+
///     Flying <--take_over / give_back--> Manual;   any in the air --fail--> Failed (hovers, obeys nothing but a
///     stop of its motors);   any in the air but Falling --battery empty--> Landing
///
/// Flying without orders it acts by its failsafe: it follows its last velocity, then hovers. What comes after: Landing,
/// Falling where the failsafe cuts the motors, Failed where it latches hovering. Climbing and descending take the times
/// above whatever the model: up and down, and the stop of a vehicle that fails or falls, are its motion under zero
/// velocity, and, with a position hold, staying where that has led.
class SimulatedVehicle {
 public:
  /// `dead_ticks`: response_delay_s() in steps.
  SimulatedVehicle(const VehicleParameters& parameters, const Vec2& position, bool starts_flying,
                   std::size_t dead_ticks = 0);

  /// An order as it arrives at the vehicle.
  void obey(const swarm::DroneOrder& order) noexcept;
  /// One step; `push` (m/s^2) comes from outside.
  void advance(double dt_s, const Vec2& push = Vec2::Zero()) noexcept;

  void fail() noexcept;
  void take_over(const Vec2& velocity) noexcept;
  void give_back() noexcept;
  /// For so long it hears velocities, and flies on by the last one that it followed.
  void ignore_orders(double for_s) noexcept { deaf_s_ = for_s; }
  /// For so long its own estimate of its velocity is wrong by so much: it flies beside what it is told.
  void drift(const Vec2& by_m_s, double for_s) noexcept {
    drift_ = by_m_s;
    drifts_s_ = for_s;
  }
  void land_by_itself() noexcept;
  /// On the ground, a share of what its battery can hold is put into it.
  void charge(double share) noexcept {
    if (battery_ && !is_airborne()) battery_->charge(share);
  }

  [[nodiscard]] const runtime::TruthSample& truth() const noexcept { return truth_; }
  [[nodiscard]] bool is_airborne() const noexcept { return truth_.mode != swarm::VehicleMode::kGrounded; }
  /// The share of charge that it reports; NaN without a battery.
  [[nodiscard]] double reported_battery() const noexcept;

 private:
  void climb(double rate_m_s, double dt_s) noexcept;
  void climb_or_descend(double dt_s) noexcept;
  [[nodiscard]] bool stays_by_itself() const noexcept;
  void move(double dt_s, const Vec2& push) noexcept;
  void arrive() noexcept;
  void watch_battery(double dt_s) noexcept;
  void watch_orders(double dt_s) noexcept;
  void act_on_silence() noexcept;
  [[nodiscard]] bool has_empty_battery() const noexcept { return battery_ && battery_->is_empty(); }

  VehicleParameters parameters_;
  runtime::TruthSample truth_;
  PlanarMotion motion_;
  dynamics::FailsafeState failsafe_;
  std::optional<SimulatedBattery> battery_;
  PositionHold hold_;
  Vec2 command_ = Vec2::Zero();  ///< the velocity that it follows
  double deaf_s_ = 0.0;
  Vec2 drift_ = Vec2::Zero();
  double drifts_s_ = 0.0;
};

}  // namespace vigil::sim
