#pragma once

#include <optional>

#include "vigil/core/dynamics/velocity_loop.hpp"

/// How far a lag-aware filter must keep vehicles from boundaries, given what they are like and what they meet. The
/// reasons: docs/vehicle-models.md, "What margins need".
namespace vigil::runtime {

/// A vehicle and the world around it, as far as they are known. SI.
struct MarginProblem {
  dynamics::VelocityLoop loop;                    ///< the plane's, dead time included
  std::optional<double> acceleration_limit_m_s2;  ///< of a first-order lag, hard
  double u_max_m_s = 0.0;                         ///< > 0
  double dt_s = 0.02;                             ///< > 0, the tick
  double separation_m = 0.0;                      ///< R_s > 0
  std::optional<double> given_lag_s;              ///< instead of the one that suits the vehicle best
  std::optional<double> given_pair_gain;          ///< instead of the best
  std::optional<double> given_wall_gain;
  double observation_delay_s = 0.0;  ///< the greatest age that observations usually have: made up for
  double command_delay_s = 0.0;      ///< from a tick to the vehicle's answer, on average: made up for
  double unsteady_delay_s = 0.0;     ///< how far that delay is from its average, at most
  double noise_m = 0.0;              ///< of positions: standard deviation per axis, white
  double velocity_noise_m_s = 0.0;
  double measurement_period_s = 0.0;  ///< between two of those; at least a tick
  double bias_m = 0.0;                ///< of positions: standard deviation per axis, wandering, each vehicle its own
  double push_m_s2 = 0.0;    ///< of gusts: standard deviation per axis of the acceleration, each vehicle its own
  double push_time_s = 1.0;  ///< its correlation time, > 0
  double silence_s = 0.0;    ///< for so long a vehicle flies on by an old order, and must not hit anything
  double swap_s = 0.0;       ///< for so long a tracker may take two bodies for each other
  friend bool operator==(const MarginProblem&, const MarginProblem&) = default;
};

/// A margin, part by part; metres.
struct MarginParts {
  double model_m =
      0.0;  ///< what the vehicle does unlike v' = (u - v)/lag, limits and the error of predictions included
  double delay_m = 0.0;  ///< what delays vary by
  double noise_m = 0.0;
  double bias_m = 0.0;
  double gusts_m = 0.0;
  double swaps_m = 0.0;
  [[nodiscard]] double total() const { return model_m + delay_m + noise_m + bias_m + gusts_m + swaps_m; }
};

/// What safety::BarrierParameters should be set to.
struct Margins {
  double lag_s = 0.0;
  double pair_gain = 0.0;  ///< 1/s
  double wall_gain = 0.0;  ///< 1/s
  MarginParts pair;        ///< pair_margin_m is their total
  MarginParts wall;        ///< margin_m is theirs
};

/// Pure, and remembered for each problem as long as the process lives: adversarial flights take a tenth of a second.
/// Any thread. An immediate or first-order vehicle whose limits are never reached needs none.
///
/// A model_m is half as much again as the worst of some fifty flights of two and three adversaries without a margin,
/// flown a quarter more eagerly, and 0.15 lag u_max of each drone. The gains are at most 5/s, ln 2 / L for pairs and 1
/// / L for walls, L = silence_s + observation_delay_s + command_delay_s. Below that, those of least model_m + u_max /
/// (10 gain): the margin, and how early drones slow down.
[[nodiscard]] Margins derive_margins(const MarginProblem& problem);

/// The same, anew.
[[nodiscard]] Margins computed_margins(const MarginProblem& problem);

}  // namespace vigil::runtime
