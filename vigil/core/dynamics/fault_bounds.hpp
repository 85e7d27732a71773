#pragma once

#include <limits>

#include "vigil/core/dynamics/velocity_loop.hpp"

/// What a healthy vehicle and its tracker can look like at worst: everything beyond is a fault. The derivations:
/// docs/derivations/faults.md. Setup functions; they take microseconds.
namespace vigil::dynamics {

/// A false alarm must not come from noise once in 10 000 h of 100 drones that are seen 50 times a second: a vector in
/// the plane with independent normal components of deviation sigma is longer than k sigma with the probability
/// exp(-k^2 / 2), and exp(-7.2^2 / 2) is one in 1.8e11.
inline constexpr double kFaultSigmas = 7.2;

/// A vehicle and the world around it, as far as they are known. SI.
struct FaultProblem {
  VelocityLoop loop;                ///< the plane's
  double u_max_m_s = 0.0;           ///< > 0
  double dt_s = 0.02;               ///< > 0, the tick
  double period_s = 0.02;           ///< > 0, between two measurements
  double jitter_s = 0.0;            ///< news of one may be late by so much more than news of another
  double noise_m = 0.0;             ///< of positions: standard deviation per axis, white
  double velocity_noise_m_s = 0.0;  ///< of reported velocities
  double bias_m = 0.0;              ///< of positions: standard deviation per axis, wandering
  double bias_time_s = 60.0;        ///< > 0, its correlation time
  double push_m_s2 = 0.0;           ///< of gusts: standard deviation per axis of the acceleration
  double push_time_s = 1.0;         ///< > 0, its correlation time
  double held_s = 0.0;              ///< an order may be flown for so long after there were newer ones
  double lost_share = 0.0;          ///< of the orders
  double packet_period_s = 0.02;    ///< > 0, between two packets of the link
  double hovers_after_s =           ///< > 0, without orders: the vehicle's own failsafe
      std::numeric_limits<double>::infinity();
  double misfit_share = 0.0;  ///< of the model: the greatest recorded residual over its step
};

struct FaultBounds {
  double longest_span_s = 0.07;  ///< between two that are seen one after the other while few are lost
  double held_s = 0.0;           ///< of orders
  double lost_share = 0.0;       ///< of orders
  double reach_m_s = 0.0;        ///< no drone is seen to move faster, not even one that follows nobody
  double jump_m = 0.0;           ///< nor errs its tracker more from one position to the next
  double confirm_s = 0.0;        ///< what is out of reach for so long is a fault, not a stray measurement
  double frozen_s = 0.0;         ///< the same bits for so long are a tracker that repeats itself
  bool never_repeats = false;    ///< no two measurements are the same bits, not even of a body at rest
  double residual_leak_per_s = 1.0;
  double residual_m = 0.0;  ///< beside what orders that got lost explain
  double disagreement_leak_per_s = 1.0;
  double disagreement_m = 0.0;
  double drift_m_s = 0.0;  ///< so fast a drone that is told to hover gets away from where it is expected, at most
  double outside_m = 0.0;  ///< beyond the field's border
  double silent_s = 0.0;   ///< who is not heard for longer may move by itself: it is not judged by its motion
  double blind_s = 0.0;    ///< how long a vehicle that flies nothing of an order for u_max goes unnoticed, at most
};

[[nodiscard]] FaultBounds fault_bounds(const FaultProblem& problem);

}  // namespace vigil::dynamics
