#include "vigil/core/safety/filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vigil/core/safety/barrier.hpp"

namespace vigil::safety {
namespace {

/// A violation smaller than this share of u_max is the solver's rounding.
constexpr double kRounding = 1e-9;

Vec2 nowhere() { return Vec2::Constant(std::numeric_limits<double>::quiet_NaN()); }

bool is_finite(const Body& body) {
  return body.position.allFinite() && body.velocity.allFinite() && std::isfinite(body.age_s) &&
         std::isfinite(body.uncooperative_speed_m_s);
}

/// The barrier of the slowest, oldest and most wayward pair of these bodies: none of theirs reaches farther.
PairBarrier widest_barrier(const BarrierParameters& parameters, std::span<const Body> bodies) {
  Body drone;
  Body stranger;
  stranger.is_controlled = false;
  bool is_any_uncontrolled = false;
  for (const Body& body : bodies) {
    if (!is_finite(body)) continue;
    drone.age_s = std::max(drone.age_s, body.age_s);
    if (body.is_controlled) continue;
    is_any_uncontrolled = true;
    stranger.uncooperative_speed_m_s = std::max(stranger.uncooperative_speed_m_s, body.uncooperative_speed_m_s);
  }
  PairBarrier widest = separation_barrier(parameters, drone, drone);
  if (!is_any_uncontrolled) return widest;
  stranger.age_s = drone.age_s;
  const PairBarrier other = separation_barrier(parameters, drone, stranger);
  widest.radius_m = std::max(widest.radius_m, other.radius_m);
  widest.closing_speed_m_s = other.closing_speed_m_s;
  return widest;
}

/// The range within which a pair has a row: as set, but never so short that one tick could step over the boundary.
double range_of(const BarrierParameters& parameters, const PairBarrier& barrier) {
  if (!parameters.sensing_range_m) return std::numeric_limits<double>::infinity();
  const double closing = parameters.u_max_m_s + std::max(parameters.u_max_m_s, barrier.closing_speed_m_s);
  const double longer = barrier.radius_m - barrier_radius(parameters);
  return std::max(*parameters.sensing_range_m + longer, barrier.radius_m + closing * parameters.dt_s);
}

/// The more speed a row asks for, the more it presses; what gives way later presses more.
double pressure(const HalfPlane& row) {
  return row.offset + static_cast<double>(kPriorities - 1 - static_cast<std::size_t>(row.priority));
}

/// Calls visit(outline, first) for every polygon among the edges: its edges, and the index of the first of them.
template <typename Visit>
void for_each_outline(std::span<const field::Segment> edges, const Visit& visit) {
  for (std::size_t first = 0; first < edges.size();) {
    const auto outline = edges.subspan(first, outline_length(edges.subspan(first)));
    visit(outline, first);
    first += outline.size();
  }
}

}  // namespace

Filter::Filter(const BarrierParameters& parameters, const field::Field& field, std::size_t capacity)
    : parameters_(parameters),
      field_(field),
      grid_(field, std::min(derived_sensing_range(parameters), parameters.sensing_range_m.value_or(HUGE_VAL)),
            capacity),
      points_(capacity, nowhere()) {}

void Filter::run(std::span<const Body> bodies, std::span<const field::Segment> no_fly, std::span<const Vec2> u_nom,
                 std::span<Vec2> u, std::span<FilterReport> reports) noexcept {
  assert(bodies.size() <= points_.size() && u_nom.size() == bodies.size() && u.size() == bodies.size() &&
         reports.size() == bodies.size());
  place(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    u[i].setZero();
    reports[i] = {};
    if (bodies[i].is_controlled) steer(i, bodies, no_fly, u_nom[i], u[i], reports[i]);
  }
}

Explanation Filter::explain(std::size_t own, std::span<const Body> bodies, std::span<const field::Segment> no_fly,
                            const Vec2& u_nom) {
  assert(own < bodies.size() && bodies.size() <= points_.size());
  Explanation why;
  why.u_nom = u_nom;
  row_count_ = 0;
  place(bodies);
  if (bodies[own].is_controlled) steer(own, bodies, no_fly, u_nom, why.u, why.report);
  why.rows.assign(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(row_count_));
  return why;
}

void Filter::place(std::span<const Body> bodies) noexcept {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool is_seen = bodies[i].is_obstacle && is_finite(bodies[i]);
    points_[i] = is_seen ? barrier_point(parameters_, bodies[i]) : nowhere();
  }
  grid_.sort(std::span<const Vec2>(points_).first(bodies.size()));
  const PairBarrier widest = widest_barrier(parameters_, bodies);
  reach_m_ = std::min(pair_reach(parameters_, widest), range_of(parameters_, widest));
}

void Filter::steer(std::size_t own, std::span<const Body> bodies, std::span<const field::Segment> no_fly,
                   const Vec2& u_nom, Vec2& u, FilterReport& report) noexcept {
  const Vec2 z = barrier_point(parameters_, bodies[own]);
  report.input_rejected = !is_finite(bodies[own]) || !z.allFinite() || !u_nom.allFinite();
  if (report.input_rejected) return;

  const double reserve_m = wall_reserve(parameters_, bodies[own]);
  row_count_ = 0;
  gather_pairs(own, z, bodies, report);
  gather_walls(z, bodies[own], reserve_m, Priority::kDoubt, report);
  gather_edges(z, bodies[own], no_fly, reserve_m, Priority::kDoubt, report);
  gather_ways_out(z, bodies[own], no_fly, report);
  PlanarQpSolution solution = solve_rows(u_nom);
  if (!solution.feasible) {
    // What lost drones might do can contradict all else, noise alone can break a margin, and margins of two neighbours
    // can contradict each other or a wall. They give way first: to rows that ask for less, so that they matter only
    // now.
    report.margin_used = true;
    gather_lesser_pairs(own, z, bodies, report);
    const double margin_m = wall_margin(parameters_);
    gather_walls(z, bodies[own], margin_m, Priority::kMargin, report);
    gather_edges(z, bodies[own], no_fly, margin_m, Priority::kMargin, report);
    gather_walls(z, bodies[own], 0.0, Priority::kWall, report);
    gather_edges(z, bodies[own], no_fly, 0.0, Priority::kWall, report);
    solution = solve_rows(u_nom);
  }
  u = solution.u;
  write_report(solution, u_nom, report);
}

void Filter::write_report(const PlanarQpSolution& solution, const Vec2& u_nom, FilterReport& report) const noexcept {
  for (const int row : solution.active) {
    if (row < 0) continue;
    report.holding[static_cast<std::size_t>(report.holding_count)] = rows_[static_cast<std::size_t>(row)].what;
    ++report.holding_count;
  }
  report.speed_limited = solution.on_disk;
  const auto margin = static_cast<std::size_t>(Priority::kMargin);
  for (std::size_t priority = 0; priority < margin; ++priority)
    report.violation_m_s = std::max(report.violation_m_s, solution.violation[priority]);
  report.fallback = !solution.feasible && report.violation_m_s > kRounding * parameters_.u_max_m_s;
  report.correction_m_s = (solution.u - u_nom).stableNorm();
}

PlanarQpSolution Filter::solve_rows(const Vec2& u_nom) noexcept {
  for (std::size_t i = 0; i < row_count_; ++i) half_planes_[i] = rows_[i].half_plane;
  return solve(u_nom, std::span<const HalfPlane>(half_planes_).first(row_count_), parameters_.u_max_m_s);
}

void Filter::gather_pairs(std::size_t own, const Vec2& z, std::span<const Body> bodies, FilterReport& report) noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  grid_.visit_near(z, reach_m_, [&](std::size_t other) {
    if (other == own) return;
    const PairBarrier barrier = separation_barrier(parameters_, bodies[own], bodies[other]);
    const Vec2 z_ij = z - points_[other];
    if (z_ij.norm() > std::min(reach_m_, range_of(parameters_, barrier))) return;
    const double distance = (bodies[own].position - bodies[other].position).norm();
    const auto index = static_cast<int>(other);
    if (distance < nearest) {
      nearest = distance;
      report.nearest = index;
      report.nearest_distance_m = distance;
    }
    const Vec2 v_ij = bodies[own].velocity - bodies[other].velocity;
    const auto row = pair_row(parameters_, barrier, z_ij, v_ij, static_cast<int>(own), index, Priority::kDoubt);
    if (row) add(*row, {RowKind::kNeighbour, index, distance}, report);
  });
}

void Filter::gather_lesser_pairs(std::size_t own, const Vec2& z, std::span<const Body> bodies,
                                 FilterReport& report) noexcept {
  grid_.visit_near(z, reach_m_, [&](std::size_t other) {
    const Vec2 z_ij = z - points_[other];
    if (other == own || z_ij.norm() > reach_m_) return;
    const auto index = static_cast<int>(other);
    const double distance = (bodies[own].position - bodies[other].position).norm();
    const auto add_row = [&](const PairBarrier& barrier, Priority priority) {
      const Vec2 v_ij = bodies[own].velocity - bodies[other].velocity;
      const auto row = pair_row(parameters_, barrier, z_ij, v_ij, static_cast<int>(own), index, priority);
      if (row) add(*row, {RowKind::kNeighbour, index, distance}, report);
    };
    add_row(margin_barrier(parameters_, bodies[other]), Priority::kMargin);
    add_row(bare_separation_barrier(parameters_, bodies[other]), Priority::kSeparation);
    add_row(contact_barrier(parameters_, bodies[other]), Priority::kPhysicalRadius);
  });
}

void Filter::gather_walls(const Vec2& z, const Body& own, double reserve_m, Priority priority,
                          FilterReport& report) noexcept {
  for (int wall = 0; wall < 4; ++wall) {
    const auto row = wall_row(parameters_, field_, z, wall, reserve_m, priority);
    if (row) add(*row, {RowKind::kWall, wall, wall_distance(field_, own.position, wall)}, report);
  }
}

void Filter::gather_edges(const Vec2& z, const Body& own, std::span<const field::Segment> no_fly, double reserve_m,
                          Priority priority, FilterReport& report) noexcept {
  for_each_outline(no_fly, [&](std::span<const field::Segment> outline, std::size_t first) {
    if (encloses(outline, z)) return;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto row = edge_row(parameters_, outline[i], z, reserve_m, priority);
      if (!row) continue;
      const double distance = (own.position - field::nearest_point(outline[i], own.position)).norm();
      add(*row, {RowKind::kNoFly, static_cast<int>(first + i), distance}, report);
    }
  });
}

void Filter::gather_ways_out(const Vec2& z, const Body& own, std::span<const field::Segment> no_fly,
                             FilterReport& report) noexcept {
  for_each_outline(no_fly, [&](std::span<const field::Segment> outline, std::size_t first) {
    if (!encloses(outline, z)) return;
    const WayOut way = way_out(parameters_, outline, z);
    const double distance = (own.position - field::nearest_point(outline[way.edge], own.position)).norm();
    add(way.row, {RowKind::kNoFly, static_cast<int>(first + way.edge), -distance}, report);
  });
}

void Filter::add(const HalfPlane& half_plane, const HoldingRow& what, FilterReport& report) noexcept {
  const auto presses_more = [](const GivenRow& a, const GivenRow& b) {
    return pressure(a.half_plane) > pressure(b.half_plane);
  };
  if (row_count_ < kMaxRows) {
    rows_[row_count_++] = {half_plane, what};
    if (row_count_ == kMaxRows) std::make_heap(rows_.begin(), rows_.end(), presses_more);
    return;
  }
  report.crowded = true;
  if (pressure(half_plane) <= pressure(rows_.front().half_plane)) return;
  std::pop_heap(rows_.begin(), rows_.end(), presses_more);  // the one that presses least goes to the end
  rows_.back() = {half_plane, what};
  std::push_heap(rows_.begin(), rows_.end(), presses_more);
}

}  // namespace vigil::safety
