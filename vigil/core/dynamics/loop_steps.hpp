#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "vigil/core/dynamics/velocity_loop.hpp"

/// The equations of velocity_loop.hpp in N dimensions at once: what advance() of an axis and of a vehicle share.
namespace vigil::dynamics::loop_steps {

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;

/// Position, velocity, acceleration, correction; or their rates.
template <int N>
struct State {
  Vector<N> p, v, a, i;
};

template <int N>
State<N> moved(const State<N>& from, const State<N>& rate, double dt) {
  return {from.p + dt * rate.p, from.v + dt * rate.v, from.a + dt * rate.a, from.i + dt * rate.i};
}

/// sat(x; L). Only multiplications, divisions and square roots, so that every machine gets the same bits.
template <int N>
Vector<N> saturated(const Vector<N>& x, double limit) {
  if (std::isinf(limit)) return x;
  const double squared = x.squaredNorm() * (1.0 / (limit * limit));  // the quotient is the same for all substeps
  return x / std::sqrt(std::sqrt(1.0 + squared * squared));
}

template <int N>
State<N> rate(const VelocityLoop& loop, const State<N>& x, const Vector<N>& u, const Vector<N>& push) {
  const Vector<N> error = loop.gain * u - x.v;
  const Vector<N> wanted = saturated<N>(loop.proportional_per_s * error + x.i, loop.acceleration_limit_m_s2);
  const Vector<N> change = (wanted - loop.drag_per_s * x.v - x.a) / loop.actuator_lag_s;
  return {x.v, x.a + push, saturated<N>(change, loop.jerk_limit_m_s3), loop.integral_per_s2 * error};
}

/// One step of the classical fourth-order Runge-Kutta method.
template <int N>
State<N> runge_kutta(const VelocityLoop& loop, const State<N>& x, const Vector<N>& u, const Vector<N>& push, double h) {
  const State<N> k1 = rate<N>(loop, x, u, push);
  const State<N> k2 = rate<N>(loop, moved<N>(x, k1, 0.5 * h), u, push);
  const State<N> k3 = rate<N>(loop, moved<N>(x, k2, 0.5 * h), u, push);
  const State<N> k4 = rate<N>(loop, moved<N>(x, k3, h), u, push);
  const State<N> outer = moved<N>(moved<N>(x, k1, h / 6.0), k4, h / 6.0);
  return moved<N>(moved<N>(outer, k2, h / 3.0), k3, h / 3.0);
}

/// Ta = 0: v' = kp (K u - v) + push, whose velocity tends to w = K u + push / kp.
template <int N>
State<N> without_actuator_lag(const VelocityLoop& loop, const State<N>& x, const Vector<N>& u, const Vector<N>& push,
                              double dt) {
  const double kp = loop.proportional_per_s;
  const Vector<N> steady = loop.gain * u + push / kp;
  const Vector<N> error = steady - x.v;
  const double covered = -std::expm1(-kp * dt);
  const Vector<N> v = x.v + covered * error;
  return {x.p + dt * steady - (covered / kp) * error, v, kp * (loop.gain * u - v), x.i};
}

/// Short beside the fastest thing in the loop, its actuator lag.
inline double longest_substep(const VelocityLoop& loop) { return std::min(0.01, loop.actuator_lag_s / 12.0); }

/// The state after dt, by whichever of the three the loop needs.
template <int N>
State<N> advanced(const VelocityLoop& loop, State<N> x, const Vector<N>& u, const Vector<N>& push, double dt) {
  if (is_immediate(loop)) return {x.p + (dt * loop.gain) * u, loop.gain * u, Vector<N>::Zero(), Vector<N>::Zero()};
  if (loop.actuator_lag_s == 0.0) return without_actuator_lag<N>(loop, x, u, push, dt);
  const double substeps = std::max(1.0, std::ceil(dt / longest_substep(loop) - 1e-9));
  for (double n = 0.0; n < substeps; n += 1.0) x = runge_kutta<N>(loop, x, u, push, dt / substeps);
  return x;
}

}  // namespace vigil::dynamics::loop_steps
