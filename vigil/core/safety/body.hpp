#pragma once

#include <cstdint>
#include <optional>

#include "vigil/core/field/vec2.hpp"

namespace vigil::safety {

enum class BarrierKind : std::uint8_t {
  kPaper,    ///< (10), (11): h_o = |p_ij|^2 - R_s^2, h_w = d^2 - R_wall^2, gamma(h) = gain h^3
  kLagAware  ///< for v' = (u - v)/lag: h = |p_ij|^2 + 2 lag p_ij.v_ij - R^2, R = R_s + pair margin (and a little for
             ///< the tick); on z = p + lag v: h_w = d - R_wall - margin; gamma(h) = gain h
};

/// What the filter guarantees and how firmly. Metres, seconds; one value for the whole swarm.
struct BarrierParameters {
  BarrierKind kind = BarrierKind::kLagAware;
  double separation_m = 0.0;        ///< R_s > 0: no two drones' centres closer than this
  double contact_distance_m = 0.0;  ///< in (0, R_s]: centres at which bodies touch; the last thing to give way
  double wall_distance_m = 0.0;     ///< R_wall >= 0
  double no_fly_buffer_m = 0.0;     ///< >= 0, kept from every no-fly edge
  double u_max_m_s = 0.0;           ///< > 0
  double dt_s = 0.0;                ///< > 0, the tick: velocities are held this long
  double pair_gain = 5.0;           ///< of gamma for pairs: 1/(m^4 s) for kPaper, 1/s for kLagAware
  double wall_gain = 5.0;           ///< of gamma for walls and no-fly edges, the same units
  double lag_s = 0.0;               ///< tau >= 0 of v' = (u - v)/tau; kLagAware only
  /// >= 0, kept beyond R_wall and the no-fly buffer, and beyond R_s by a pair: for noise, wind, and all that a vehicle
  /// does unlike v' = (u - v)/lag; kLagAware only.
  double margin_m = 0.0;
  double pair_margin_m = 0.0;
  /// Pairs farther apart have no row, walls and edges likewise (R_threat); none: derived, so that no row is ever
  /// missed. Whatever is set, nobody can step over a boundary within one tick: see least_sensing_range().
  std::optional<double> sensing_range_m;
  std::optional<double> wall_range_m;
};

/// The distance beyond which a pair row cannot bind: gamma(h) >= 2 d u_max there (0.61 m for the paper's numbers).
[[nodiscard]] double derived_sensing_range(const BarrierParameters& parameters);
/// The least sensing range with which nobody meets the barrier for the first time behind its boundary: R + 2 u_max dt
/// for kPaper; for kLagAware 2 w + hypot(R, 2 w) instead of R, with w = lag u_max, since h >= 0 there whatever the
/// velocities. Never more than derived_sensing_range().
[[nodiscard]] double least_sensing_range(const BarrierParameters& parameters);
/// The distance at which h = 0 for two drones at rest: R_s for kPaper, R for kLagAware.
[[nodiscard]] double barrier_radius(const BarrierParameters& parameters);

/// A drone as the filter sees it. Field frame.
struct Body {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double age_s = 0.0;         ///< of position and velocity; others keep u_max x age more distance
  bool is_obstacle = true;    ///< others avoid it
  bool is_controlled = true;  ///< the filter computes its velocity
  /// How fast it may come closer by itself although nobody controls it: others then carry the whole burden. 0 for one
  /// that stands still; meaningful only where is_controlled is false.
  double uncooperative_speed_m_s = 0.0;
};

}  // namespace vigil::safety
