#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety {

enum class BarrierKind : std::uint8_t {
  kPaper,    ///< (10), (11): h_o = |p_ij|^2 - R_s^2, h_w = d^2 - R_wall^2, gamma(h) = gain h^3
  kLagAware  ///< on z = p + lag v: h = |z_ij|^2 - R_z^2, R_z^2 = (R_s + margin)^2 + (2 lag u_max)^2, h_w = d - R_wall,
             ///< gamma(h) = gain h
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
  double margin_m = 0.0;            ///< >= 0, added to R_s for delay, noise and acceleration limits; kLagAware only
  std::optional<double>
      sensing_range_m;  ///< pairs farther apart have no row; none: derived, so that no row is ever missed
  std::optional<double> wall_range_m;  ///< R_threat: farther walls have no row; none: derived
};

/// The distance beyond which a pair row cannot bind: gamma(h) >= 2 d u_max there (0.61 m for the paper's numbers).
[[nodiscard]] double derived_sensing_range(const BarrierParameters& parameters);
/// The least sensing range with which sampling cannot step over the boundary: R + 2 u_max dt (R_z for kLagAware).
[[nodiscard]] double least_sensing_range(const BarrierParameters& parameters);
/// R_s for kPaper, R_z for kLagAware: the distance (of p or of z) at which h = 0.
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

enum class RowKind : std::uint8_t { kNeighbour, kWall, kNoFly };

/// A constraint that holds a drone's velocity where it is.
struct HoldingRow {
  RowKind kind = RowKind::kNeighbour;
  int index = -1;           ///< of the other body, the wall (0 left, 1 right, 2 bottom, 3 top) or the no-fly edge
  double distance_m = 0.0;  ///< between positions, or from the wall or edge (signed)
};

/// What the filter did to one drone in one tick.
struct FilterReport {
  std::array<HoldingRow, 2> holding{};
  int holding_count = 0;
  bool speed_limited = false;   ///< the disk |u| <= u_max holds u
  bool fallback = false;        ///< no velocity satisfied every row: the least violation was taken
  double violation_m_s = 0.0;   ///< how far the worst row is from being satisfied then
  bool input_rejected = false;  ///< its own state or nominal velocity was not finite: u = 0
  bool crowded = false;         ///< more rows than kMaxRows: the most pressing ones were kept
  double correction_m_s = 0.0;  ///< |u - u_nom|
  int nearest = -1;             ///< index of the nearest obstacle within sensing range, -1 for none
  double nearest_distance_m = 0.0;
};

/// The safety filter: (10) solved exactly for every controlled drone, with gamma_d(h) = min(gamma(h), h / (2 dt)) for
/// pairs and h / dt for walls, no-fly edges and bodies nobody controls, so that zero-order hold never breaks the
/// guarantee; for h < 0 a linear rate of escape. Owns its work space, sized by `capacity` drones: run() allocates
/// nothing. One thread at a time. Same input, same bits.
class Filter {
 public:
  Filter(const BarrierParameters& parameters, const field::Field& field, std::size_t capacity);

  /// Precondition: all spans but `no_fly` have the same length, at most capacity. Bodies may be anything, also NaN.
  /// u[i] = 0 where bodies[i].is_controlled is false. Every |u[i]| <= u_max and finite.
  void run(std::span<const Body> bodies, std::span<const field::Segment> no_fly, std::span<const Vec2> u_nom,
           std::span<Vec2> u, std::span<FilterReport> reports) noexcept;

  [[nodiscard]] const BarrierParameters& parameters() const { return parameters_; }

 private:
  BarrierParameters parameters_;
  field::Field field_;
  // (the implementer completes this)
};

}  // namespace vigil::safety
