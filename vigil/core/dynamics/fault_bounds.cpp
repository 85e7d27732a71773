#include "vigil/core/dynamics/fault_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vigil::dynamics {
namespace {

constexpr double kLeastFrozenS = 0.25;
constexpr double kLeastConfirmS = 0.1;
constexpr double kSamplesFrozen = 5.0;   // one repetition may be a tracker's own; so many in a row are none
constexpr double kSamplesConfirm = 2.0;  // a single stray measurement is screened, and no fault
constexpr double kPacketsSilent = 5.0;
constexpr double kTypicalDisobedience = 0.5;  // of u_max
constexpr double kSlowestLeak = 0.1;          // 1/s
constexpr double kFastestLeak = 4.0;          // 1/s
constexpr double kLeakStep = 1.25;
constexpr double kSteadyPeriods = 2.5;     // positions farther apart say nothing of the velocity between them
constexpr double kDisagreementLeak = 1.0;  // 1/s: an estimator's own time constants are shorter

/// How quickly a vehicle gives in to a push, and by how much per m/s^2: one over its stiffness.
double give_s(const VelocityLoop& loop) {
  return is_immediate(loop) ? 0.0 : 1.0 / (loop.proportional_per_s + loop.drag_per_s);
}

/// Standard deviation of the leaky integral of a first-order Gauss-Markov process.
double integrated(double sigma, double time_s, double leak) {
  return sigma * std::sqrt(time_s / (leak * (1.0 + leak * time_s)));
}

/// And of the leaky integral of its derivative.
double changed(double sigma, double time_s, double leak) { return sigma / std::sqrt(1.0 + leak * time_s); }

double gust_speed(const FaultProblem& problem) { return give_s(problem.loop) * problem.push_m_s2; }

/// What the residual of a healthy vehicle stays below.
double residual_bound(const FaultProblem& problem, double leak) {
  const double noise = std::numbers::sqrt2 * problem.noise_m;
  const double bias = changed(problem.bias_m, problem.bias_time_s, leak);
  const double gusts = integrated(gust_speed(problem), problem.push_time_s + give_s(problem.loop), leak);
  const double random = kFaultSigmas * std::hypot(noise, bias, gusts);
  const double misfit = problem.misfit_share * problem.u_max_m_s / leak;
  return random + misfit + problem.u_max_m_s * problem.dt_s;
}

/// A vehicle flies nothing of an order that differs from what it does by `off`. Its residual fills up, and lost orders
/// explain off held for held_s and fade then:
///     off (1 - exp(-leak t)) / leak = bound + off held exp(-leak (t - held))
double unnoticed_s(const FaultProblem& problem, double leak, double off) {
  const double share = leak * residual_bound(problem, leak) / off;
  const double explained = leak * problem.held_s * std::exp(leak * problem.held_s);
  return share < 1.0 ? (std::log1p(explained) - std::log1p(-share)) / leak : std::numeric_limits<double>::infinity();
}

/// With a short memory less is forgiven and more is forgotten. The one in which a vehicle that disobeys by half of what
/// it can is noticed soonest.
double best_leak(const FaultProblem& problem) {
  const double off = kTypicalDisobedience * problem.u_max_m_s;
  double best = kSlowestLeak;
  for (double leak = kSlowestLeak; leak <= kFastestLeak; leak *= kLeakStep)
    if (unnoticed_s(problem, leak, off) < unnoticed_s(problem, best, off)) best = leak;
  return best;
}

/// Longer than packets stay away while nothing is wrong, or than the vehicle waits before it hovers by itself.
double silent_after_s(const FaultProblem& problem) {
  const double few_s = kPacketsSilent * std::max(problem.period_s, problem.packet_period_s);
  return std::max(few_s, std::min(problem.held_s, problem.hovers_after_s));
}

/// Where news overtakes other news, what is overtaken is never seen: the next measurement is as much later.
double span_s(const FaultProblem& problem) { return problem.period_s + problem.jitter_s; }

/// A velocity that is reported but for noise, against the way from one position to the next: between two measurements
/// it is the mean of both but for what the vehicle changes it by, whose sum telescopes.
double disagreement_bound(const FaultProblem& problem) {
  constexpr double kLeak = kDisagreementLeak;
  const double position = std::numbers::sqrt2 * problem.noise_m;
  const double velocity = problem.velocity_noise_m_s * std::sqrt(span_s(problem) / (2.0 * kLeak));
  const double bias = changed(problem.bias_m, problem.bias_time_s, kLeak);
  const double give = give_s(problem.loop);
  const double change = 2.0 * problem.u_max_m_s * (give > 0.0 ? std::min(1.0, span_s(problem) / give) : 1.0);
  return kFaultSigmas * std::hypot(position, velocity, bias) + change * span_s(problem);
}

/// A wandering bias moves by so much in one period: the variance of its increments is 2 sigma^2 (1 - exp(-t/T)).
double bias_step(const FaultProblem& problem) {
  return problem.bias_m * std::sqrt(-2.0 * std::expm1(-problem.period_s / problem.bias_time_s));
}

}  // namespace

FaultBounds fault_bounds(const FaultProblem& problem) {
  FaultBounds bounds;
  bounds.longest_span_s = kSteadyPeriods * problem.period_s + problem.jitter_s + problem.dt_s;
  bounds.held_s = problem.held_s;
  bounds.lost_share = problem.lost_share;
  bounds.reach_m_s = 2.0 * problem.u_max_m_s + kFaultSigmas * gust_speed(problem);
  bounds.jump_m = kFaultSigmas * std::hypot(std::numbers::sqrt2 * problem.noise_m, bias_step(problem)) +
                  problem.u_max_m_s * problem.dt_s;
  bounds.confirm_s = std::max(kLeastConfirmS, kSamplesConfirm * problem.period_s);
  bounds.frozen_s = std::max(kLeastFrozenS, kSamplesFrozen * problem.period_s);
  bounds.never_repeats = problem.noise_m > 0.0;
  bounds.residual_leak_per_s = best_leak(problem);
  bounds.residual_m = residual_bound(problem, bounds.residual_leak_per_s);
  bounds.disagreement_leak_per_s = kDisagreementLeak;
  bounds.disagreement_m = disagreement_bound(problem);
  bounds.drift_m_s = kFaultSigmas * gust_speed(problem) + problem.misfit_share * problem.u_max_m_s;
  bounds.outside_m = kFaultSigmas * std::hypot(problem.noise_m, problem.bias_m) + problem.u_max_m_s * problem.dt_s;
  bounds.silent_s = silent_after_s(problem);
  bounds.blind_s = unnoticed_s(problem, bounds.residual_leak_per_s, problem.u_max_m_s);
  return bounds;
}

}  // namespace vigil::dynamics
