#pragma once

#include "vigil/core/dynamics/velocity_loop.hpp"

/// What a safety margin needs to know of a vehicle, computed from its loop along one axis, its dead time included.
/// Setup functions: they simulate for milliseconds to a second, and may allocate.
namespace vigil::dynamics {

/// How far z = p + tau v strays from where the commands alone would have led it, in the worst case.
///
/// A filter that steers z takes z' = u for granted and is wrong by delta = z' - u. What accumulates of that is D, with
/// D' = delta - leak D, D = 0 at first. The result is the least known bound of |D|, in metres, over all |u| <= u_max
/// and all times. With leak = 0, D is how far z is from the integral of u. With leak = k it is how far a wall's barrier
/// d' >= -k d, enforced for z' = u, goes below zero: d(t) >= exp(-k t) d(0) + D(t).
///
/// Linear loops: u_max times the L1 norm of the impulse response of E(s) = ((1 + tau s) G(s) - 1) / (s + leak), reached
/// by a bang-bang command; infinite where leak = 0 and the steady gain is not 1. It holds for vectors in the plane too.
/// Loops with limits: the worst of commands that change every 50 ms between five values, by dynamic programming over
/// (v, a) on a grid, one axis; infinite where leak = 0, because alternating large and small steps pumps D up for ever.
/// Precondition: tau_s >= 0, leak_per_s >= 0, u_max_m_s > 0; a loop with limits has neither integral nor drag.
[[nodiscard]] double command_deviation(const VelocityLoop& loop, double tau_s, double leak_per_s, double u_max_m_s);

/// The tau >= 0 that makes command_deviation() least, and what is left of it then.
struct EffectiveLag {
  double tau_s = 0.0;
  double deviation_m = 0.0;
};

/// The deviation is convex in tau (a supremum of |affine functions|), so that a golden-section search in [0, 4 s] finds
/// it to 1 ms. Where nothing is finite, tau = 0 and an infinite deviation. Preconditions as above.
[[nodiscard]] EffectiveLag effective_lag(const VelocityLoop& loop, double leak_per_s, double u_max_m_s);

/// The greatest |v| that commands |u| <= u_max reach from rest. Preconditions as above.
[[nodiscard]] double greatest_speed(const VelocityLoop& loop, double u_max_m_s);

/// How far, as a share of u, the speed exceeds u on the way from rest under constant u > 0; 0 where it never does.
[[nodiscard]] double overshoot(const VelocityLoop& loop, double u_m_s);

/// A stop: the command for v has been held, now it is 0.
struct Stop {
  double distance_m = 0.0;  ///< the farthest the vehicle gets from where it was when the command changed
  double time_s = 0.0;      ///< until the speed is below a twentieth for good
};

/// From a flight at speed v > 0 whose command has been held for ever.
[[nodiscard]] Stop stop_from(const VelocityLoop& loop, double speed_m_s);

/// From any state with a velocity > 0, which lasts while the dead time does.
[[nodiscard]] Stop stop_from(const VelocityLoop& loop, const AxisState& flying);

}  // namespace vigil::dynamics
