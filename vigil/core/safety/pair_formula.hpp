#pragma once

#include "vigil/core/safety/barrier.hpp"

/// The row of a pair as plain arithmetic on numbers: what pair_row() computes for one pair, and pair_rows.cpp for many
/// at once. Without branches, so that a loop over pairs becomes vector instructions; each operation is rounded by
/// itself, so that both give the same bits on every instruction set.
namespace vigil::safety::pair_formula {

/// Closer to a barrier's boundary than this is on it. Rounding of one tick must not look like a violation.
inline constexpr double kOnBoundary = 1e-9;
/// Points closer than this have no direction from one to the other.
inline constexpr double kCoincident = 1e-9;
/// What the escape from h < 0 speeds up with: a drone that is R - d too close asks for 5/s (R - d).
inline constexpr double kEscapeRate = 5.0;

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }
[[gnu::always_inline]] inline double greatest(double a, double b) { return a < b ? b : a; }
[[gnu::always_inline]] inline double length(double x, double y) { return __builtin_sqrt(x * x + y * y); }

/// What a tick does to h of a pair with a lag: h(t + dt) >= h + (relief + 2 half_slope . u_ij) dt for every u_ij that
/// is held, [5]. All 0 without a lag.
struct Sampling {
  double lag_squared = 0.0;
  double slope_s = 0.0;  ///< half_slope = z_ij - slope_s v_ij
  double relief = 0.0;   ///< relief_per_s = lag^2 |v_ij|^2 relief / dt
  double dt_s = 0.0;
};

/// The barrier of one kind of pair.
struct Rule {
  bool is_paper = false;  ///< gamma(h) = gain h^3
  double u_max_m_s = 0.0;
  double gain = 0.0;
  double hold_s = 0.0;
  double closing_speed_m_s = 0.0;
  Sampling sampling;
};

[[nodiscard]] Rule rule_of(const BarrierParameters& parameters, const PairBarrier& barrier);

struct Row {
  double half_slope_x, half_slope_y;  ///< the normal, times lever
  double lever;                       ///< no more than kCoincident: the points coincide and the normal is free
  double offset;
};

/// How fast to leave a barrier that is broken by `depth` metres. Not faster than u_max / 2: at u_max the row would
/// touch the disk of speeds in one point, and any second row would make the problem infeasible just when it matters
/// most. Together with what an uncooperative body asks for not faster than u_max, for the same reason.
[[gnu::always_inline]] inline double escape_speed(double u_max, double depth, double closing_speed) {
  const double room = greatest(0.0, u_max - closing_speed);
  return least(least(kEscapeRate * depth, 0.5 * u_max), room);
}

/// With zero-order hold |z_ij(t + dt)|^2 >= |z_ij|^2 + 2 z_ij.(u_i - u_j) dt, so h stays >= 0 where the drones that
/// give way use up no more than h within the tick: gamma_d(h) = min(gamma(h), h / hold).
[[gnu::always_inline]] inline double gamma_d(bool is_paper, double gain, double h, double hold_s) {
  return least(is_paper ? gain * h * h * h : gain * h, h / hold_s);
}

/// n.u >= -gamma_d(d^2 - R^2) / (2 lever) + closing_speed: a barrier h = d^2 - R^2 with the gradient 2 lever n.
[[gnu::always_inline]] inline double squared_offset(const Rule& rule, double radius, double distance, double lever) {
  const double closing_speed = rule.closing_speed_m_s;
  const double escape = closing_speed + escape_speed(rule.u_max_m_s, radius - distance, closing_speed);
  const double h = greatest(0.0, (distance - radius) * (distance + radius));
  const double held = closing_speed - gamma_d(rule.is_paper, rule.gain, h, rule.hold_s) / (2.0 * lever);
  const double outside = lever <= kCoincident ? closing_speed : held;  // coincident only where the radius is 0
  return distance < radius - kOnBoundary ? escape : outside;
}

/// The row of a pair with barrier radius `radius`; z_ij, v_ij: see pair_row().
[[gnu::always_inline]] inline Row row(const Rule& rule, double radius, double z_x, double z_y, double v_x, double v_y) {
  const Sampling& sampling = rule.sampling;
  const double swing = sampling.lag_squared * (v_x * v_x + v_y * v_y);
  const double distance = __builtin_sqrt(greatest(0.0, z_x * z_x + z_y * z_y - swing));  // sqrt(h + R^2)
  const double half_slope_x = z_x - sampling.slope_s * v_x;
  const double half_slope_y = z_y - sampling.slope_s * v_y;
  const double lever = length(half_slope_x, half_slope_y);
  const double offset = squared_offset(rule, radius, distance, lever);
  const double relief_per_s = swing * sampling.relief / sampling.dt_s;
  const double relieved = offset - 0.25 * relief_per_s / lever;
  return {half_slope_x, half_slope_y, lever, lever <= kCoincident ? offset : relieved};
}

}  // namespace vigil::safety::pair_formula
