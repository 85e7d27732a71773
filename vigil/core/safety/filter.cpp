#include "vigil/core/safety/filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/core/safety/passing_row.hpp"

namespace vigil::safety {
namespace {

/// A violation smaller than this share of u_max is the solver's rounding.
constexpr double kRounding = 1e-9;

Vec2 nowhere() { return Vec2::Constant(std::numeric_limits<double>::quiet_NaN()); }

bool is_finite(const Body& body) {
  return body.position.allFinite() && body.velocity.allFinite() && std::isfinite(body.age_s) &&
         std::isfinite(body.uncooperative_speed_m_s);
}

/// Bodies ahead of the one at work whose data are sent for: by index they are anywhere in memory.
constexpr std::size_t kAhead = 12;

template <typename Value>
void send_for(const Value& value) {
  __builtin_prefetch(&value);
}

/// So many drones are worth solving their problems together.
constexpr std::size_t kCrowd = 2 * PlanarQpBatch::kLanes;

/// Drones that one thread steers before it asks for more.
constexpr std::size_t kPart = 512;

std::size_t parts_of(std::size_t count) { return (count + kPart - 1) / kPart; }

/// Nobody can keep R_s for ever from what comes on, fast or slowly: who tries to is driven into others, into a corner,
/// or a wall.
bool may_outrun(const BarrierParameters& parameters, const Body& other) {
  constexpr double kFast = 0.3;
  return !other.is_controlled && other.uncooperative_speed_m_s >= kFast * parameters.u_max_m_s;
}

/// The barrier of the slowest, oldest and most wayward pair of such bodies: none of theirs reaches farther.
PairBarrier widest_barrier(const BarrierParameters& parameters, const Extremes& extremes) {
  Body drone;
  drone.age_s = extremes.age_s;
  PairBarrier widest = separation_barrier(parameters, drone, drone);
  if (!extremes.is_any_uncontrolled) return widest;
  Body stranger;
  stranger.is_controlled = false;
  stranger.age_s = extremes.age_s;
  stranger.uncooperative_speed_m_s = extremes.uncooperative_speed_m_s;
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
      lag_s_(barrier_lag(parameters)),
      pair_rows_(parameters),
      pair_screen_(parameters),
      grid_(field, std::min(derived_sensing_range(parameters), parameters.sensing_range_m.value_or(HUGE_VAL)),
            capacity),
      bodies_(capacity),
      columns_(capacity),
      extremes_(parts_of(capacity)) {}

void Extremes::include(const Body& body) noexcept {
  if (!is_finite(body)) return;
  age_s = std::max(age_s, body.age_s);
  if (body.is_controlled) return;
  is_any_uncontrolled = true;
  uncooperative_speed_m_s = std::max(uncooperative_speed_m_s, body.uncooperative_speed_m_s);
}

void Extremes::include(const Extremes& others) noexcept {
  age_s = std::max(age_s, others.age_s);
  is_any_uncontrolled = is_any_uncontrolled || others.is_any_uncontrolled;
  uncooperative_speed_m_s = std::max(uncooperative_speed_m_s, others.uncooperative_speed_m_s);
}

void Filter::run(std::span<const Body> bodies, std::span<const field::Segment> no_fly, std::span<const Vec2> u_nom,
                 std::span<Vec2> u, std::span<FilterReport> reports, parallel::Workers* workers) noexcept {
  assert(bodies.size() <= bodies_.size() && u.size() <= bodies.size() && u_nom.size() == u.size() &&
         reports.size() == u.size());
  place(bodies, workers);
  const Task task{no_fly, u_nom, u, reports};
  const bool is_crowd = u.size() >= kCrowd;
  const std::span<const std::uint32_t> sorted = grid_.sorted();
  parallel::for_each_part(workers, sorted.size(), kPart, [&](std::size_t first, std::size_t last, std::size_t) {
    Desk desk;
    Together together;
    for (std::size_t place = first; place < last; ++place) {
      const std::size_t own = sorted[place];
      if (own >= u.size()) continue;
      const std::size_t later = std::min<std::size_t>(sorted[std::min(place + kAhead, last - 1)], u.size() - 1);
      send_for(u_nom[later]);
      send_for(u[later]);
      send_for(reports[later]);
      if (is_crowd)
        steer_together(place, own, task, desk, together);
      else
        steer_alone(place, own, task, desk);
    }
    finish_together(task, desk, together);
  });
}

void Filter::steer_alone(std::size_t place, std::size_t own, const Task& task, Desk& desk) const noexcept {
  Vec2 velocity = Vec2::Zero();
  FilterReport report;
  if (bodies_[place].is_controlled)
    steer(place, own, bodies_[place], task.no_fly, task.u_nom[own], Gather::kPressing, velocity, report, desk);
  task.u[own] = velocity;
  task.reports[own] = report;
}

/// What is not like most has it alone.
void Filter::steer_together(std::size_t place, std::size_t own, const Task& task, Desk& desk,
                            Together& together) const noexcept {
  const Body& body = bodies_[place];
  const Vec2 z = point_of(body);
  const Vec2& u_nom = task.u_nom[own];
  const bool is_usable = body.is_controlled && is_finite(body) && z.allFinite() && u_nom.allFinite();
  Together::Drone& drone = together.drones[together.count];
  desk.rows.clear();
  drone.report = {};
  const bool is_gathered = is_usable && gather_pressing(place, own, body, z, task.no_fly, u_nom, drone.report, desk);
  const std::span<const HalfPlane> rows = desk.rows.half_planes();
  if (!is_gathered || rows.size() > PlanarQpBatch::kMostRows) return steer_alone(place, own, task, desk);
  drone.place = place;
  drone.own = own;
  drone.rows = rows.size();
  std::ranges::copy(desk.rows.whats(), drone.whats.begin());
  together.problems.begin(together.count, u_nom);
  for (const HalfPlane& row : rows) together.problems.add(together.count, row);
  if (++together.count == PlanarQpBatch::kLanes) finish_together(task, desk, together);
}

void Filter::finish_together(const Task& task, Desk& desk, Together& together) const noexcept {
  if (together.count == 0) return;
  for (std::size_t lane = together.count; lane < PlanarQpBatch::kLanes; ++lane)
    together.problems.begin(lane, Vec2::Zero());
  together.problems.solve(parameters_.u_max_m_s);
  for (std::size_t lane = 0; lane < together.count; ++lane) {
    Together::Drone& drone = together.drones[lane];
    if (!together.problems.is_solved(lane)) {
      steer_alone(drone.place, drone.own, task, desk);
      continue;
    }
    const PlanarQpSolution solution = together.problems.solution(lane);
    write_report(solution, task.u_nom[drone.own], std::span(drone.whats).first(drone.rows), drone.report);
    task.u[drone.own] = solution.u;
    task.reports[drone.own] = drone.report;
  }
  together.count = 0;
}

Explanation Filter::explain(std::size_t own, std::span<const Body> bodies, std::span<const field::Segment> no_fly,
                            const Vec2& u_nom) {
  assert(own < bodies.size() && bodies.size() <= bodies_.size());
  Explanation why;
  why.u_nom = u_nom;
  place(bodies, nullptr);
  Desk desk;
  if (bodies[own].is_controlled) steer(0, own, bodies[own], no_fly, u_nom, Gather::kAll, why.u, why.report, desk);
  const std::span<const HalfPlane> half_planes = desk.rows.half_planes();
  for (std::size_t row = 0; row < half_planes.size(); ++row)
    why.rows.push_back({half_planes[row], desk.rows.what(row)});
  return why;
}

void Filter::place(std::span<const Body> bodies, parallel::Workers* workers) noexcept {
  const auto place_of = [&](std::size_t i) {
    const bool is_seen = bodies[i].is_obstacle && is_finite(bodies[i]);
    return is_seen ? point_of(bodies[i]) : nowhere();
  };
  grid_.sort(bodies.size(), place_of, workers);
  const std::span<const std::uint32_t> sorted = grid_.sorted();
  parallel::for_each_part(workers, sorted.size(), kPart, [&](std::size_t first, std::size_t last, std::size_t) {
    Extremes extremes;
    for (std::size_t place = first; place < last; ++place) {
      send_for(bodies[sorted[std::min(place + kAhead, last - 1)]]);
      const Body& body = bodies[sorted[place]];
      bodies_[place] = body;
      columns_.set(place, body, point_of(body), place < grid_.placed(), parameters_.u_max_m_s);
      extremes.include(body);
    }
    extremes_[first / kPart] = extremes;
  });
  Extremes extremes;
  for (std::size_t part = 0; part < parts_of(bodies.size()); ++part) extremes.include(extremes_[part]);
  are_all_fresh_ = extremes.age_s <= 0.0 && !extremes.is_any_uncontrolled;
  const PairBarrier widest = widest_barrier(parameters_, extremes);
  reach_m_ = std::min(pair_reach(parameters_, widest), range_of(parameters_, widest));
  Body oldest;
  oldest.age_s = extremes.age_s;
  wall_reach_m_ = wall_reach(parameters_, wall_reserve(parameters_, oldest));
}

Vec2 Filter::point_of(const Body& body) const noexcept {
  return body.is_controlled ? Vec2(body.position + lag_s_ * body.velocity) : body.position;
}

void Filter::gather_fixed(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly,
                          RowSet& rows) const noexcept {
  const double reserve_m = wall_reserve(parameters_, body);
  if (least_wall_distance(field_, z) <= wall_reach_m_) gather_walls(z, body, reserve_m, Priority::kDoubt, rows);
  if (no_fly.empty()) return;
  gather_edges(z, body, no_fly, reserve_m, Priority::kDoubt, rows);
  gather_ways_out(z, body, no_fly, rows);
}

/// False where that is not known: all have to be gathered then.
bool Filter::gather_pressing(std::size_t place, std::size_t own, const Body& body, const Vec2& z,
                             std::span<const field::Segment> no_fly, const Vec2& u_nom, FilterReport& report,
                             Desk& desk) const noexcept {
  Screening& screening = desk.screening;
  const Screened drone{.place = place,
                       .point = z,
                       .position = body.position,
                       .velocity = body.velocity,
                       .drift_m = parameters_.u_max_m_s * std::max(0.0, body.age_s),
                       .u_nom = u_nom,
                       .reach_m = reach_m_,
                       .are_all_fresh = are_all_fresh_};
  screening.clear();
  grid_.visit_parts(z, reach_m_, [&](std::size_t first, std::size_t last) { screening.add(first, last); });
  pair_screen_.look(columns_, drone, screening);
  constexpr std::size_t kWalls = 4;
  const bool is_crowded = screening.within_range() + kWalls + 2 * no_fly.size() >= kMaxRows;
  if (!screening.is_sure() || is_crowded) return false;

  desk.nearest_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t other : screening.nearest()) {
    const Vec2 p_ij = body.position - bodies_[other].position;
    const double distance = pair_formula::length(p_ij.x(), p_ij.y());
    if (!(distance < desk.nearest_m)) continue;
    desk.nearest_m = distance;
    report.nearest = static_cast<int>(grid_.sorted()[other]);
  }
  if (report.nearest >= 0) report.nearest_distance_m = desk.nearest_m;
  desk.nearest_m = 0.0;  // nobody is nearer
  desk.gathered = 0;
  for (const std::uint32_t other : screening.pressing()) {
    desk.places[desk.gathered++] = other;
    if (desk.gathered == PairBatch::kSize) add_pairs(own, body, z, report, desk);
  }
  if (desk.gathered > 0) add_pairs(own, body, z, report, desk);
  gather_fixed(z, body, no_fly, desk.rows);
  return std::ranges::none_of(desk.rows.half_planes(), [](const HalfPlane& row) { return row.offset > 0.0; });
}

void Filter::steer(std::size_t place, std::size_t own, const Body& body, std::span<const field::Segment> no_fly,
                   const Vec2& u_nom, Gather gather, Vec2& u, FilterReport& report, Desk& desk) const noexcept {
  RowSet& rows = desk.rows;
  rows.clear();
  const Vec2 z = point_of(body);
  report.input_rejected = !is_finite(body) || !z.allFinite() || !u_nom.allFinite();
  if (report.input_rejected) return;

  PlanarQpSolution solution;
  solution.feasible = false;
  if (gather == Gather::kPressing && gather_pressing(place, own, body, z, no_fly, u_nom, report, desk))
    solution = solve(u_nom, rows.half_planes(), parameters_.u_max_m_s);
  if (!solution.feasible) {
    rows.clear();
    report = {};
    gather_pairs(own, body, z, report, desk);
    gather_fixed(z, body, no_fly, rows);
    solution = solve(u_nom, rows.half_planes(), parameters_.u_max_m_s);
  }
  if (!solution.feasible) {
    // What lost drones might do can contradict all else, noise alone can break a margin, and margins of two neighbours
    // can contradict each other or a wall. They give way first: to rows that ask for less, so that they matter only
    // now.
    report.margin_used = true;
    gather_lesser_pairs(own, body, z, u_nom, rows);
    const double margin_m = wall_margin(parameters_);
    gather_walls(z, body, margin_m, Priority::kMargin, rows);
    gather_edges(z, body, no_fly, margin_m, Priority::kMargin, rows);
    gather_walls(z, body, 0.0, Priority::kWall, rows);
    gather_edges(z, body, no_fly, 0.0, Priority::kWall, rows);
    solution = solve(u_nom, rows.half_planes(), parameters_.u_max_m_s);
  }
  u = solution.u;
  report.crowded = rows.is_crowded();
  write_report(solution, u_nom, rows.whats(), report);
}

void Filter::write_report(const PlanarQpSolution& solution, const Vec2& u_nom, std::span<const HoldingRow> whats,
                          FilterReport& report) const noexcept {
  for (const int row : solution.active) {
    if (row < 0) continue;
    report.holding[static_cast<std::size_t>(report.holding_count)] = whats[static_cast<std::size_t>(row)];
    ++report.holding_count;
  }
  report.speed_limited = solution.on_disk;
  const auto margin = static_cast<std::size_t>(Priority::kMargin);
  for (std::size_t priority = 0; priority < margin; ++priority)
    report.violation_m_s = std::max(report.violation_m_s, solution.violation[priority]);
  report.fallback = !solution.feasible && report.violation_m_s > kRounding * parameters_.u_max_m_s;
  report.correction_m_s = (solution.u - u_nom).stableNorm();
}

void Filter::gather_pairs(std::size_t own, const Body& body, const Vec2& z, FilterReport& report,
                          Desk& desk) const noexcept {
  constexpr double kLonger = 1.0 + 1e-12;  // what is just within reach must not be lost here: it is measured again
  const double reach_squared = reach_m_ * reach_m_ * kLonger;
  desk.nearest_m = std::numeric_limits<double>::infinity();
  desk.gathered = 0;
  grid_.visit_parts(z, reach_m_, [&](std::size_t first, std::size_t last) {
    while (first < last) {
      const std::size_t end = std::min(last, first + (PairBatch::kSize - desk.gathered));
      for (; first < end; ++first) {
        desk.places[desk.gathered] = static_cast<std::uint32_t>(first);
        desk.gathered += (z - point_of(bodies_[first])).squaredNorm() <= reach_squared ? 1u : 0u;
      }
      if (desk.gathered == PairBatch::kSize) add_pairs(own, body, z, report, desk);
    }
  });
  if (desk.gathered > 0) add_pairs(own, body, z, report, desk);
  if (report.nearest >= 0) report.nearest_distance_m = desk.nearest_m;
}

/// The rows of those that were gathered.
void Filter::add_pairs(std::size_t own, const Body& body, const Vec2& z, FilterReport& report,
                       Desk& desk) const noexcept {
  PairBatch& batch = desk.batch;
  bool are_controlled = true;
  for (std::size_t i = 0; i < desk.gathered; ++i) {
    const std::size_t place = desk.places[i];
    const Body& other = bodies_[place];
    are_controlled = are_controlled && other.is_controlled;
    const Vec2 point = point_of(other);
    batch.point_x[i] = point.x();
    batch.point_y[i] = point.y();
    batch.position_x[i] = other.position.x();
    batch.position_y[i] = other.position.y();
    batch.velocity_x[i] = other.velocity.x();
    batch.velocity_y[i] = other.velocity.y();
    batch.age_s[i] = other.age_s;
  }
  if (!are_controlled) return add_pairs_one_by_one(own, body, z, report, desk);
  pair_rows_.compute(body, z, reach_m_, desk.gathered, batch);
  const std::span<const std::uint32_t> sorted = grid_.sorted();
  for (std::size_t i = 0; i < desk.gathered; ++i) {
    const auto index = static_cast<int>(sorted[desk.places[i]]);
    if (batch.excess_m[i] > 0.0 || index == static_cast<int>(own)) continue;
    const double distance = batch.distance_m[i];
    const bool is_nearest = distance < desk.nearest_m;
    desk.nearest_m = is_nearest ? distance : desk.nearest_m;
    report.nearest = is_nearest ? index : report.nearest;
    const bool is_coincident = batch.lever[i] <= pair_formula::kCoincident;
    const Vec2 parting = parting_direction(static_cast<int>(own), index);
    const double normal_x = is_coincident ? parting.x() : batch.normal_x[i];
    const double normal_y = is_coincident ? parting.y() : batch.normal_y[i];
    const bool is_binding = batch.offset[i] > -parameters_.u_max_m_s;
    desk.rows.add_neighbour_if(is_binding, {Vec2(normal_x, normal_y), batch.offset[i], Priority::kDoubt}, index,
                               distance);
  }
  desk.gathered = 0;
}

/// The same where some of them are not controlled: each has a barrier of its own.
void Filter::add_pairs_one_by_one(std::size_t own, const Body& body, const Vec2& z, FilterReport& report,
                                  Desk& desk) const noexcept {
  for (std::size_t i = 0; i < desk.gathered; ++i) {
    const std::size_t place = desk.places[i];
    const Body& other = bodies_[place];
    const auto index = static_cast<int>(grid_.sorted()[place]);
    if (index == static_cast<int>(own)) continue;
    const PairBarrier barrier = separation_barrier(parameters_, body, other);
    const Vec2 z_ij = z - point_of(other);
    if (z_ij.norm() > std::min(reach_m_, range_of(parameters_, barrier))) continue;
    const double distance = (body.position - other.position).norm();
    if (distance < desk.nearest_m) {
      desk.nearest_m = distance;
      report.nearest = index;
    }
    const Vec2 v_ij = body.velocity - other.velocity;
    const auto row = pair_row(parameters_, barrier, z_ij, v_ij, static_cast<int>(own), index, Priority::kDoubt);
    if (row) desk.rows.add(*row, {RowKind::kNeighbour, index, distance});
  }
  desk.gathered = 0;
}

/// As wide as there is room for.
std::optional<HalfPlane> Filter::row_beside(const Body& body, const Body& other, const Vec2& u_nom) const noexcept {
  const double wide_m = parameters_.separation_m + parameters_.pair_margin_m;
  for (const double radius_m : {wide_m, parameters_.separation_m, parameters_.contact_distance_m}) {
    const auto row = passing_row(parameters_, body, other, radius_m, u_nom, Priority::kMargin);
    if (row) return row;
  }
  return std::nullopt;
}

void Filter::gather_lesser_pairs(std::size_t own, const Body& body, const Vec2& z, const Vec2& u_nom,
                                 RowSet& rows) const noexcept {
  grid_.visit_parts(z, reach_m_, [&](std::size_t first, std::size_t last) {
    for (std::size_t place = first; place < last; ++place) {
      const Body& other = bodies_[place];
      const auto index = static_cast<int>(grid_.sorted()[place]);
      const Vec2 z_ij = z - point_of(other);
      if (index == static_cast<int>(own) || z_ij.norm() > reach_m_) continue;
      const double distance = (body.position - other.position).norm();
      const auto add_row = [&](const PairBarrier& barrier, Priority priority) {
        const Vec2 v_ij = body.velocity - other.velocity;
        const auto row = pair_row(parameters_, barrier, z_ij, v_ij, static_cast<int>(own), index, priority);
        if (row) rows.add(*row, {RowKind::kNeighbour, index, distance});
      };
      const bool is_fast = may_outrun(parameters_, other);
      const auto beside = is_fast ? row_beside(body, other, u_nom) : std::nullopt;
      if (beside) {
        rows.add(*beside, {RowKind::kNeighbour, index, distance});
      } else {
        add_row(margin_barrier(parameters_, other), Priority::kMargin);
        add_row(bare_separation_barrier(parameters_, other), is_fast ? Priority::kMargin : Priority::kSeparation);
      }
      add_row(contact_barrier(parameters_, other), Priority::kPhysicalRadius);
    }
  });
}

void Filter::gather_walls(const Vec2& z, const Body& body, double reserve_m, Priority priority,
                          RowSet& rows) const noexcept {
  for (int wall = 0; wall < 4; ++wall) {
    const auto row = wall_row(parameters_, field_, z, wall, reserve_m, priority);
    if (row) rows.add(*row, {RowKind::kWall, wall, wall_distance(field_, body.position, wall)});
  }
}

void Filter::gather_edges(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly, double reserve_m,
                          Priority priority, RowSet& rows) const noexcept {
  for_each_outline(no_fly, [&](std::span<const field::Segment> outline, std::size_t first) {
    if (encloses(outline, z)) return;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto row = edge_row(parameters_, outline[i], z, reserve_m, priority);
      if (!row) continue;
      const double distance = (body.position - field::nearest_point(outline[i], body.position)).norm();
      rows.add(*row, {RowKind::kNoFly, static_cast<int>(first + i), distance});
    }
  });
}

void Filter::gather_ways_out(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly,
                             RowSet& rows) const noexcept {
  for_each_outline(no_fly, [&](std::span<const field::Segment> outline, std::size_t first) {
    if (!encloses(outline, z)) return;
    const WayOut way = way_out(parameters_, outline, z);
    const double distance = (body.position - field::nearest_point(outline[way.edge], body.position)).norm();
    rows.add(way.row, {RowKind::kNoFly, static_cast<int>(first + way.edge), -distance});
  });
}

}  // namespace vigil::safety
