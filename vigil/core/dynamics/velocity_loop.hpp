#pragma once

#include <limits>

#include "vigil/core/field/vec2.hpp"

namespace vigil::dynamics {

/// How a vehicle's velocity v follows the commanded velocity u along one axis, or in the plane (u, v, a, i then are
/// vectors and |.| the length):
///
///   e  = K u - v
///   c  = sat(kp e + i; A) - d v              what the controller and the drag make of the error
///   a' = sat((c - a) / Ta; J),  i' = ki e,  v' = a + push,  p' = v
///   sat(x; L) = x / (1 + (|x| / L)^4)^(1/4)  a smooth limit: |sat| < L, and sat = x for |x| << L
///
/// Linear where both limits are infinite. Two limiting cases have a closed form instead: kp infinite is p' = K u (the
/// single integrator), Ta = 0 is v' = kp (K u - v) + push.
struct VelocityLoop {
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

  double gain = 1.0;                            ///< K > 0: steady speed over commanded speed where ki = 0 and d = 0
  double proportional_per_s = kUnlimited;       ///< kp > 0
  double integral_per_s2 = 0.0;                 ///< ki >= 0
  double drag_per_s = 0.0;                      ///< d >= 0
  double actuator_lag_s = 0.0;                  ///< Ta >= 0; 0 needs ki = d = 0 and no limit
  double acceleration_limit_m_s2 = kUnlimited;  ///< A > 0
  double jerk_limit_m_s3 = kUnlimited;          ///< J > 0
  double response_delay_s = 0.0;                ///< dead time before a command acts: the caller delays the command
  friend bool operator==(const VelocityLoop&, const VelocityLoop&) = default;
};

/// Whether the velocity follows the command at once.
[[nodiscard]] bool is_immediate(const VelocityLoop& loop) noexcept;

/// Whether the response to a sum of commands is the sum of the responses.
[[nodiscard]] bool is_linear(const VelocityLoop& loop) noexcept;

/// v / u once a constant command has been held for ever: K; K kp / (kp + d) with drag and no integral.
[[nodiscard]] double steady_gain(const VelocityLoop& loop) noexcept;

/// A loop's state along one axis.
struct AxisState {
  double position_m = 0.0;
  double velocity_m_s = 0.0;
  double acceleration_m_s2 = 0.0;  ///< a
  double correction_m_s2 = 0.0;    ///< i, what the integral has learnt
};

/// Flying at a steady velocity under a command that need not be the one for it: a = 0; the integral, where there is
/// one, holds what balances error and drag at this moment.
[[nodiscard]] AxisState in_flight(const VelocityLoop& loop, double velocity_m_s, double command_m_s) noexcept;

/// The state after dt_s under constant command and push (m/s^2, from outside: wind). Precondition: finite input,
/// dt_s >= 0. An immediate loop ignores the push. See advance(VehicleModel) for the accuracy.
[[nodiscard]] AxisState advance(const VelocityLoop& loop, const AxisState& state, double command_m_s, double dt_s,
                                double push_m_s2 = 0.0) noexcept;

/// A loop's state in the plane; its limits bound the lengths of the vectors.
struct PlanarLoopState {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  Vec2 acceleration = Vec2::Zero();
  Vec2 correction = Vec2::Zero();
};

/// The same for x and y together: what advance(VehicleModel) does in the plane.
[[nodiscard]] PlanarLoopState advance(const VelocityLoop& loop, const PlanarLoopState& state, const Vec2& command_m_s,
                                      double dt_s, const Vec2& push_m_s2 = Vec2::Zero()) noexcept;

}  // namespace vigil::dynamics
