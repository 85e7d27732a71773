#include "vigil/core/dynamics/response_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "vigil/core/dynamics/adversary.hpp"

namespace vigil::dynamics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSample = 0.002;    // seconds between the samples of a response
constexpr double kLongest = 300.0;   // seconds: thirty times the slowest recorded time constant
constexpr double kStill = 1e-7;      // a response whose acceleration stays below this share of its speed has ended
constexpr double kLongestLag = 4.0;  // seconds
constexpr double kLagStep = 1e-3;    // seconds: how exactly the best lag is looked for

/// The states every kSample under a constant command, until nothing moves any more.
std::vector<AxisState> response(const VelocityLoop& loop, AxisState state, double command) {
  const double still = kStill * std::max(std::abs(command), std::abs(state.velocity_m_s));
  std::vector<AxisState> states{state};
  double moving_at = 0.0;
  for (double now = kSample; now < kLongest && now < moving_at + 1.0; now += kSample) {
    const AxisState next = advance(loop, state, command, kSample);
    if (std::abs(next.velocity_m_s - state.velocity_m_s) > still * kSample) moving_at = now;
    state = next;
    states.push_back(state);
  }
  return states;
}

/// The integral of exp(-leak (t - s)) ds over the last `span` before t.
double leaky_span(double leak, double span) { return leak > 0.0 ? -std::expm1(-leak * span) / leak : span; }

/// The L1 norm of an impulse response is the total variation of the step response. Here that of D, which answers a unit
/// step of u with D' = v + tau a - 1 - leak D, v and a being 0 during the dead time.
double variation_of_deviation(const std::vector<AxisState>& unit_step, const VelocityLoop& loop, double tau,
                              double leak) {
  const double keep = std::exp(-leak * kSample);
  const double share = leaky_span(leak, kSample) / kSample;
  double d = -leaky_span(leak, loop.response_delay_s);
  double variation = std::abs(d);
  for (std::size_t i = 1; i < unit_step.size(); ++i) {
    const double distance = unit_step[i].position_m - unit_step[i - 1].position_m;
    const double gained = unit_step[i].velocity_m_s - unit_step[i - 1].velocity_m_s;
    const double next = keep * d + share * (distance + tau * gained - kSample);
    variation += std::abs(next - d);
    d = next;
  }
  const double left = leak > 0.0 ? (steady_gain(loop) - 1.0) / leak - d : 0.0;
  return variation + std::abs(left);
}

/// command_deviation() as a function of tau, after what does not depend on tau has been computed once.
class Deviation {
 public:
  Deviation(const VelocityLoop& loop, double leak, double u_max) : loop_(loop), leak_(leak), u_max_(u_max) {
    if (is_linear(loop))
      unit_step_ = response(loop, {}, 1.0);
    else
      adversary_.emplace(loop, u_max);
  }

  [[nodiscard]] bool is_finite() const {
    return leak_ > 0.0 || (is_linear(loop_) && std::abs(steady_gain(loop_) - 1.0) < 1e-12);
  }

  double operator()(double tau) const {
    if (!is_finite()) return kInfinity;
    if (adversary_) return adversary_->greatest_deviation(tau, leak_);
    return u_max_ * variation_of_deviation(unit_step_, loop_, tau, leak_);
  }

 private:
  VelocityLoop loop_;
  double leak_;
  double u_max_;
  std::vector<AxisState> unit_step_;
  std::optional<Adversary> adversary_;
};

}  // namespace

double command_deviation(const VelocityLoop& loop, double tau_s, double leak_per_s, double u_max_m_s) {
  return Deviation(loop, leak_per_s, u_max_m_s)(tau_s);
}

EffectiveLag effective_lag(const VelocityLoop& loop, double leak_per_s, double u_max_m_s) {
  const Deviation deviation(loop, leak_per_s, u_max_m_s);
  if (!deviation.is_finite()) return {0.0, kInfinity};
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0;
  double high = kLongestLag;
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = deviation(left);
  double at_right = deviation(right);
  while (high - low > kLagStep) {
    if (at_left <= at_right) {
      high = std::exchange(right, left);
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = deviation(left);
    } else {
      low = std::exchange(left, right);
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = deviation(right);
    }
  }
  const double at_zero = deviation(0.0);
  if (at_zero <= std::min(at_left, at_right)) return {0.0, at_zero};
  return at_left <= at_right ? EffectiveLag{left, at_left} : EffectiveLag{right, at_right};
}

double greatest_speed(const VelocityLoop& loop, double u_max_m_s) {
  if (!is_linear(loop)) return Adversary(loop, u_max_m_s).greatest_speed();
  const std::vector<AxisState> unit_step = response(loop, {}, 1.0);
  double variation = 0.0;
  for (std::size_t i = 1; i < unit_step.size(); ++i)
    variation += std::abs(unit_step[i].velocity_m_s - unit_step[i - 1].velocity_m_s);
  return u_max_m_s * variation;
}

double overshoot(const VelocityLoop& loop, double u_m_s) {
  double greatest = 0.0;
  for (const AxisState& state : response(loop, {}, u_m_s)) greatest = std::max(greatest, state.velocity_m_s);
  return std::max(0.0, greatest / u_m_s - 1.0);
}

Stop stop_from(const VelocityLoop& loop, double speed_m_s) {
  return stop_from(loop, in_flight(loop, speed_m_s, speed_m_s / steady_gain(loop)));
}

Stop stop_from(const VelocityLoop& loop, const AxisState& flying) {
  const std::vector<AxisState> states = response(loop, flying, 0.0);
  const double slow = 0.05 * flying.velocity_m_s;
  double distance = 0.0;
  std::size_t last_fast = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    distance = std::max(distance, states[i].position_m - flying.position_m);
    if (std::abs(states[i].velocity_m_s) >= slow) last_fast = i;
  }
  const double moving = is_immediate(loop) ? 0.0 : static_cast<double>(last_fast + 1) * kSample;
  return {distance + loop.response_delay_s * flying.velocity_m_s, moving + loop.response_delay_s};
}

}  // namespace vigil::dynamics
