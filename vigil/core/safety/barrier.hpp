#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/safety/body.hpp"
#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety {

/// The barriers of (10), (11) as rows for the solver. Every row has a unit normal n, so that its offset is a speed: the
/// least speed along n that the barrier asks of the drone. Rows that no velocity of the disk |u| <= u_max can break are
/// left out. Docs: docs/derivations/safety.md.

/// The point of a body whose barriers are kept: its position p for kPaper; z = p + lag v for kLagAware and a controlled
/// body, since z' = u exactly. Nobody's command moves an uncontrolled body: it is where it is, and its barrier radius
/// makes up for the lag.
[[nodiscard]] Vec2 barrier_point(const BarrierParameters& parameters, const Body& body);

/// What keeps a drone away from one other body.
struct PairBarrier {
  double radius_m = 0.0;  ///< h = |z_ij|^2 - (lag |v_ij|)^2 - radius^2
  double lag_s = 0.0;     ///< of both bodies; 0 where one is not controlled, or for kPaper
  double gain = 0.0;      ///< of gamma
  double hold_s = 0.0;    ///< gamma_d(h) = min(gamma(h), h / hold): 2 dt where both give way, dt where one does
  double closing_speed_m_s = 0.0;  ///< how fast the other may come closer by itself
};

/// The barrier of separation_m between a controlled drone and another body, with all that is kept beyond it: margin_m,
/// and the way that both may have gone since they were seen.
[[nodiscard]] PairBarrier separation_barrier(const BarrierParameters& parameters, const Body& own, const Body& other);

/// The barrier of separation_m and pair_margin_m: without the way that drones may have gone unseen, or may yet go by
/// themselves.
[[nodiscard]] PairBarrier margin_barrier(const BarrierParameters& parameters, const Body& other);

/// The barrier of separation_m alone: what must hold when there is no room for more. It never asks for more than
/// separation_barrier().
[[nodiscard]] PairBarrier bare_separation_barrier(const BarrierParameters& parameters, const Body& other);

/// The barrier of contact_distance_m alone, with gamma_d(h) = h / hold, the loosest that sampling allows: it outranks
/// separation and must not hold a drone a moment before it has to. It never asks for more than
/// bare_separation_barrier().
[[nodiscard]] PairBarrier contact_barrier(const BarrierParameters& parameters, const Body& other);

/// What a drone keeps beyond R_wall and the no-fly buffer: margin_m (0 for kPaper), ...
[[nodiscard]] double wall_margin(const BarrierParameters& parameters);
/// ... and with the way that it may have gone since it was seen.
[[nodiscard]] double wall_reserve(const BarrierParameters& parameters, const Body& own);

/// With lag 0: 2 z_ij . u_i >= -gamma_d(h) + 2 |z_ij| closing_speed, divided by 2 |z_ij|; with a lag the exact change
/// of h over a tick, half of it: [5]. For h < 0 the speed of escape. z_ij and v_ij are the differences of the bodies'
/// points and velocities. `own` and `other` are the bodies' indices: they choose the direction where both points
/// coincide.
[[nodiscard]] std::optional<HalfPlane> pair_row(const BarrierParameters& parameters, const PairBarrier& barrier,
                                                const Vec2& z_ij, const Vec2& v_ij, int own, int other,
                                                Priority priority);

/// Where both points of a pair coincide. Along x, by index: then the first and the last of many drones in one point are
/// always free to leave it. Directions that differ from pair to pair would surround every one of them, and none could
/// move.
[[nodiscard]] Vec2 parting_direction(int own, int other);

/// The distance of z beyond which pair_row() leaves the row out, whatever the velocities up to u_max.
[[nodiscard]] double pair_reach(const BarrierParameters& parameters, const PairBarrier& barrier);

/// lag of v' = (u - v)/lag as the barriers know it: 0 for kPaper.
[[nodiscard]] double barrier_lag(const BarrierParameters& parameters);

/// A distance beyond which wall_row() with this reserve, or a lesser one, leaves the row out.
[[nodiscard]] double wall_reach(const BarrierParameters& parameters, double reserve_m);

/// The distance from z to the nearest wall: negative outside.
[[nodiscard]] inline double least_wall_distance(const field::Field& field, const Vec2& z) {
  return std::min(std::min(z.x(), field.length_x - z.x()), std::min(z.y(), field.length_y - z.y()));
}

/// The distance from z to a wall of the field (0 left, 1 right, 2 bottom, 3 top): negative outside.
[[nodiscard]] double wall_distance(const field::Field& field, const Vec2& z, int wall);

/// (11), with R_wall longer by reserve_m: kPaper 2 d n.u >= -gamma_d(d^2 - R_wall^2); kLagAware n.u >= -gamma_d(d -
/// R_wall). Behind the wall the row points back inside. None beyond wall_range_m.
[[nodiscard]] std::optional<HalfPlane> wall_row(const BarrierParameters& parameters, const field::Field& field,
                                                const Vec2& z, int wall, double reserve_m, Priority priority);

/// How many of the edges, from the first on, make one outline: each begins where the one before it ends, and the last
/// ends where the first begins. Edges that do not close make outlines of one.
[[nodiscard]] std::size_t outline_length(std::span<const field::Segment> edges);

/// True where the outline of a polygon encloses z. False for fewer than three edges.
[[nodiscard]] bool encloses(std::span<const field::Segment> outline, const Vec2& z);

/// True where one of the outlines, which follow each other in `edges`, encloses z.
[[nodiscard]] bool is_enclosed(std::span<const field::Segment> edges, const Vec2& z);

/// The row that keeps z away from one edge, from outside: like a wall at the edge's nearest point, with the radius
/// no_fly_radius(reserve_m). None beyond wall_range_m.
[[nodiscard]] std::optional<HalfPlane> edge_row(const BarrierParameters& parameters, const field::Segment& edge,
                                                const Vec2& z, double reserve_m, Priority priority);

/// The row that leads out of a polygon that encloses z, by its nearest edge. Precondition: at least one edge, in the
/// order of field::edges() (the inside on the left).
struct WayOut {
  HalfPlane row;
  std::size_t edge = 0;
  double distance_m = 0.0;  ///< to the edge
};
[[nodiscard]] WayOut way_out(const BarrierParameters& parameters, std::span<const field::Segment> outline,
                             const Vec2& z);

/// The distance of z from a no-fly edge at which h = 0: no_fly_buffer_m + reserve_m for kPaper, and for kLagAware
/// sqrt((no_fly_buffer_m + reserve_m)^2 + (lag u_max)^2).
[[nodiscard]] double no_fly_radius(const BarrierParameters& parameters, double reserve_m);

}  // namespace vigil::safety
