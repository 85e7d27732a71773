#include "vigil/core/dynamics/adversary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vigil::dynamics {
namespace {

constexpr double kPeriod = 0.05;  // seconds that a command lasts
constexpr std::array kCommands = {-1.0, -0.5, 0.0, 0.5, 1.0};
constexpr int kVNodes = 121;  // odd: one is at rest
constexpr int kANodes = 61;
constexpr double kForgotten = 1e-4;  // the weight below which the past no longer counts

constexpr std::size_t kNodes = std::size_t{kVNodes} * kANodes;

constexpr std::size_t node(int v_node, int a_node) {
  return static_cast<std::size_t>(v_node) * kANodes + static_cast<std::size_t>(a_node);
}

double at(int index, int nodes, double greatest) { return greatest * (2.0 * index / (nodes - 1) - 1.0); }

/// Where a value lies on an axis of the grid, in cells from its lower end, at most at its upper end.
double cells(double value, int nodes, double greatest) {
  const double last = nodes - 1;
  return std::clamp(0.5 * (value / greatest + 1.0) * last, 0.0, last);
}

/// No state under |u| <= u_max leaves |a| <= a_max, |v| <= v_max by much: u_max may be exceeded while an acceleration
/// is taken back, by lag and by jerk. Beyond the grid its edge counts.
double greatest_acceleration(const VelocityLoop& loop, double u_max) {
  return std::min(loop.acceleration_limit_m_s2, 2.0 * loop.proportional_per_s * loop.gain * u_max);
}

double greatest_velocity(const VelocityLoop& loop, double u_max) {
  const double a = greatest_acceleration(loop, u_max);
  return loop.gain * u_max + std::min(loop.gain * u_max, a * (loop.actuator_lag_s + 0.5 * a / loop.jerk_limit_m_s3));
}

}  // namespace

Adversary::Adversary(const VelocityLoop& loop, double u_max_m_s)
    : loop_(loop),
      u_max_m_s_(u_max_m_s),
      greatest_v_(greatest_velocity(loop, u_max_m_s)),
      greatest_a_(greatest_acceleration(loop, u_max_m_s)) {
  moves_.reserve(kNodes * kCommands.size());
  for (int v_node = 0; v_node < kVNodes; ++v_node)
    for (int a_node = 0; a_node < kANodes; ++a_node)
      for (const double command : kCommands) moves_.push_back(move_from(v_node, a_node, command * u_max_m_s));
}

Adversary::Move Adversary::move_from(int v_node, int a_node, double command_m_s) const {
  const AxisState before{.velocity_m_s = at(v_node, kVNodes, greatest_v_),
                         .acceleration_m_s2 = at(a_node, kANodes, greatest_a_)};
  const AxisState next = advance(loop_, before, command_m_s, kPeriod);
  const double v = cells(next.velocity_m_s, kVNodes, greatest_v_);
  const double a = cells(next.acceleration_m_s2, kANodes, greatest_a_);
  const int v_below = std::min(static_cast<int>(v), kVNodes - 2);
  const int a_below = std::min(static_cast<int>(a), kANodes - 2);
  return {node(v_below, a_below), static_cast<float>(v - v_below), static_cast<float>(a - a_below), next.position_m,
          next.velocity_m_s - before.velocity_m_s};
}

double Adversary::after(const Move& move, const std::vector<double>& values) const {
  const auto value = [&](std::size_t offset) { return values[move.corner + offset]; };
  const double v = static_cast<double>(move.along_v);
  const double a = static_cast<double>(move.along_a);
  return (1.0 - v) * ((1.0 - a) * value(0) + a * value(1)) + v * ((1.0 - a) * value(kANodes) + a * value(kANodes + 1));
}

/// values(x) = max over u of payoff(x, u) + values(next(x, u)).
template <typename Payoff>
void Adversary::step_back(std::vector<double>& values, Payoff payoff) const {
  std::vector<double> earlier(values.size());
  auto move = moves_.begin();
  for (double& best : earlier) {
    best = -1e300;
    for (const double command : kCommands) {
      best = std::max(best, payoff(*move, command * u_max_m_s_) + after(*move, values));
      ++move;
    }
  }
  values.swap(earlier);
}

double Adversary::greatest_deviation(double tau_s, double leak_per_s) const {
  // D(t) = integral of exp(-leak (t - T - s)) (v + tau a) ds up to t - T, less that of exp(-leak (t - s)) u up to t.
  // In the last T, the dead time, only u counts, and the worst is the constant -u_max.
  const double seen = std::exp(-leak_per_s * loop_.response_delay_s);
  std::vector<double> values(kNodes, u_max_m_s_ * (1.0 - seen) / leak_per_s);
  const double share = (1.0 - std::exp(-leak_per_s * kPeriod)) / (leak_per_s * kPeriod);
  for (double weight = 1.0; weight > kForgotten; weight *= std::exp(-leak_per_s * kPeriod))
    step_back(values, [&](const Move& move, double u) {
      return weight * share * (move.distance_m + tau_s * move.gained_m_s - seen * u * kPeriod);
    });
  // Started from any steady flight.
  double greatest = 0.0;
  for (int v_node = 0; v_node < kVNodes; ++v_node)
    if (std::abs(at(v_node, kVNodes, greatest_v_)) <= u_max_m_s_)
      greatest = std::max(greatest, values[node(v_node, kANodes / 2)]);
  return greatest;
}

double Adversary::greatest_speed() const {
  constexpr int kPeriods = 100;
  std::vector<double> values(kNodes);
  for (int v_node = 0; v_node < kVNodes; ++v_node)
    for (int a_node = 0; a_node < kANodes; ++a_node) values[node(v_node, a_node)] = at(v_node, kVNodes, greatest_v_);
  double greatest = steady_gain(loop_) * u_max_m_s_;
  for (int period = 0; period < kPeriods; ++period) {
    step_back(values, [](const Move&, double) { return 0.0; });
    greatest = std::max(greatest, values[node(kVNodes / 2, kANodes / 2)]);
  }
  return greatest;
}

}  // namespace vigil::dynamics
