#pragma once

#include <optional>
#include <string_view>

#include "vigil/core/dynamics/vec3.hpp"
#include "vigil/core/dynamics/velocity_loop.hpp"

namespace vigil::dynamics {

/// Whose behaviour a model has. The three autopilots are fitted to recorded step responses (docs/vehicle-models.md).
enum class VehicleKind { kIdeal, kFirstOrderLag, kCrazyflie, kArduCopter, kPx4 };

/// How a vehicle answers velocity commands: one loop for x and y together, whose limits bound the length of the plane's
/// vectors, and one for the vertical. Any two loops make a vehicle; the kinds' own are made by the functions below.
struct VehicleModel {
  VehicleKind kind = VehicleKind::kIdeal;
  VelocityLoop horizontal;
  VelocityLoop vertical;
};

/// p' = u: the paper's single integrator (3).
[[nodiscard]] VehicleModel ideal_vehicle() noexcept;

/// v' = (u - v) / lag. Precondition: lag_s > 0.
[[nodiscard]] VehicleModel first_order_lag_vehicle(double lag_s) noexcept;

/// The table of fitted parameters, recordings and residuals: vehicle_table.cpp.
[[nodiscard]] VehicleModel crazyflie_vehicle() noexcept;
[[nodiscard]] VehicleModel arducopter_vehicle() noexcept;
[[nodiscard]] VehicleModel px4_vehicle() noexcept;

/// `ideal`, `first_order_lag`, `crazyflie`, `arducopter`, `px4`: as mission files name them.
[[nodiscard]] std::string_view name_of(VehicleKind kind) noexcept;
[[nodiscard]] std::optional<VehicleKind> vehicle_kind_of(std::string_view name) noexcept;

/// Where a vehicle is and how it moves. Metres and seconds, field frame, z up.
struct VehicleState {
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 acceleration = Vec3::Zero();  ///< by thrust and drag, without the push
  Vec3 correction = Vec3::Zero();    ///< m/s^2: what the loops' integrals have learnt
};

/// Flying at `velocity` under `command` without accelerating: in_flight() of each axis.
[[nodiscard]] VehicleState in_flight(const VehicleModel& model, const Vec3& position, const Vec3& velocity,
                                     const Vec3& command) noexcept;

/// The state after dt_s under the constant command u (m/s) and a constant push (m/s^2, from outside: wind).
/// Precondition: finite input, dt_s >= 0. `response_delay_s` is not in it: the caller hands over the command of then.
///
/// `ideal` and `first_order_lag` are exact. The others take fourth-order Runge-Kutta substeps of at most a twelfth of
/// the actuator lag, so that for every dt_s between 0.1 ms and 0.1 s the position and velocity a few seconds on are the
/// same within 1e-6 m and m/s.
[[nodiscard]] VehicleState advance(const VehicleModel& model, const VehicleState& state, const Vec3& u, double dt_s,
                                   const Vec3& push = Vec3::Zero()) noexcept;

}  // namespace vigil::dynamics
