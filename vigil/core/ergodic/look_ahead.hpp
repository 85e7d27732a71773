#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "vigil/core/ergodic/forecast.hpp"

namespace vigil::ergodic {

/// How far and how finely the swarm looks ahead. The values were measured: docs/decisions/0002-look-ahead.md.
struct LookAheadParameters {
  double u_max_m_s = 0.0;  ///< > 0
  double lag_s = 0.0;      ///< tau >= 0 of v' = (u - v)/tau: paths begin at z = p + tau v, since z' = u
  double dt_s = 0.0;       ///< > 0, the tick
  /// Seconds > 0; none: default_look_ahead_s() of the field and the active drones.
  std::optional<double> horizon_s = std::nullopt;
  int pieces = 8;              ///< >= 1, of equal length, with one velocity each
  double decisions = 40.0;     ///< > 0, decisions a horizon, ...
  double least_pause_s = 0.1;  ///< >= 0, ... but not more often than that
  double catch_up = 6.0;       ///< >= 0, times to cross the longer side: so long new targets are planned for in detail
  double step = 1.0;           ///< > 0, of a decision: in units of what a single drone's curvature allows
};

/// 0.6 times what a drone needs to cross its share of the field: 0.6 sqrt(area / drones) / u_max. Seconds.
[[nodiscard]] double default_look_ahead_s(const field::Field& field, std::size_t drones, double u_max_m_s) noexcept;

/// The part of a drone's state that paths begin with. Field frame.
struct Departure {
  std::size_t drone = 0;  ///< its index in the swarm
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
};

/// The look-ahead controller: every active drone keeps a path for the next seconds. A few times a second one forecast
/// for all of them says how the coverage to come changes with the velocities of all paths, and they move downhill
/// together, so that two drones do not make for one gap; a velocity beyond u_max is shortened to it. Between decisions
/// a drone flies the first velocity of its path. |u| <= u_max but for rounding. A value: a copy goes on like its
/// original. No call allocates. One thread at a time.
class LookAhead {
 public:
  LookAhead(const Basis& basis, const LookAheadParameters& parameters, std::size_t drones);

  /// Lets the next steer() decide, whatever time it is.
  void decide_at_once() noexcept { is_due_ = true; }
  /// The same for new targets. If the swarm was steered before, what is new has to be made up for: for
  /// LookAheadParameters::catch_up plans go by Emphasis::kDetail.
  void targets_changed() noexcept;

  /// u[i] for departures[i]. Call once a tick, after the tick's sample was added to the statistics. A drone that was
  /// not among the last call's departures begins a new path; whenever others take part, all decide at once.
  /// Precondition: departures in ascending order of `drone`, finite, as many as u; the kernel, the statistics and phi_k
  /// are of the same basis.
  void steer(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
             const AllowedRegion& region, std::span<const Departure> departures, std::span<Vec2> u) noexcept;

  /// From now on a tick lasts so long. Precondition: > 0.
  void set_tick(double dt_s) noexcept { parameters_.dt_s = dt_s; }

  /// How far ahead so many drones look, seconds.
  [[nodiscard]] double horizon_s(std::size_t drones) const noexcept;

 private:
  void enlist(std::span<const Departure> departures) noexcept;
  void decide(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
              const AllowedRegion& region, std::span<const Departure> departures) noexcept;
  void fly_on(std::span<Vec2> path, double pieces_flown) const noexcept;
  [[nodiscard]] std::span<Vec2> path_of(std::size_t drone) noexcept;

  LookAheadParameters parameters_;
  field::Field field_;
  Forecast forecast_;
  std::vector<Vec2> paths_;       ///< velocity of piece j of drone i at i x pieces + j
  std::vector<char> takes_part_;  ///< of each drone: whether it was among the last departures
  bool is_due_ = true;
  double since_decision_s_ = 0.0;
  bool has_steered_ = false;
  double catch_up_left_s_ = 0.0;
  // Work space of one decision.
  std::vector<Vec2> starts_;
  std::vector<Vec2> velocities_;
};

}  // namespace vigil::ergodic
