#include "vigil/core/safety/barrier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vigil/core/safety/pair_formula.hpp"

namespace vigil::safety {
namespace {

using pair_formula::kCoincident;

/// A gain may be low to leave time for what is lost or slow; what must hold when there is no room for more, and
/// outranks walls, must not use that up.
constexpr double kBareGain = 5.0;

double pair_margin_of(const BarrierParameters& parameters) {
  return parameters.kind == BarrierKind::kLagAware ? parameters.pair_margin_m : 0.0;
}

pair_formula::Sampling sampling_of(double lag, double dt) {
  if (lag <= 0.0) return {.dt_s = dt};
  const double fade = std::exp(-dt / lag);  // what a tick leaves of v - u
  return {.lag_squared = lag * lag,
          .slope_s = lag * lag * fade * (1.0 - fade) / dt,
          .relief = 1.0 - fade * fade,
          .dt_s = dt};
}

/// The barrier of something that stands still, at a signed distance.
double fixed_offset(const BarrierParameters& parameters, double distance, double radius) {
  const bool is_paper = parameters.kind == BarrierKind::kPaper;
  if (is_paper) {
    const PairBarrier wall{.radius_m = radius, .gain = parameters.wall_gain, .hold_s = parameters.dt_s};
    return pair_formula::squared_offset(pair_formula::rule_of(parameters, wall), radius, distance, distance);
  }
  if (distance < radius - pair_formula::kOnBoundary)
    return pair_formula::escape_speed(parameters.u_max_m_s, radius - distance, 0.0);
  return -pair_formula::gamma_d(is_paper, parameters.wall_gain, std::max(0.0, distance - radius), parameters.dt_s);
}

std::optional<HalfPlane> binding(const BarrierParameters& parameters, const HalfPlane& row) {
  if (!(row.offset > -parameters.u_max_m_s)) return std::nullopt;
  return row;
}

/// As set, but never so short that one tick could step over the boundary.
bool beyond_wall_range(const BarrierParameters& parameters, double distance, double radius) {
  if (!parameters.wall_range_m) return false;
  return distance > std::max(*parameters.wall_range_m, radius + parameters.u_max_m_s * parameters.dt_s);
}

/// To the right of the edge: out of the polygon.
Vec2 outward(const field::Segment& edge) {
  const Vec2 along = edge.b - edge.a;
  const double length = along.norm();
  return length > 0.0 ? Vec2(along.y() / length, -along.x() / length) : Vec2(1.0, 0.0);
}

double reach_of_row(const BarrierParameters& parameters, const PairBarrier& barrier) {
  const double closing = parameters.u_max_m_s + barrier.closing_speed_m_s;  // gamma_d(h) = |a| closing there
  // h >= |z|^2 - R^2 - w^2 and |a| <= 2 (|z| + w) with w = lag |v_ij| at its greatest.
  const double w = 2.0 * barrier.lag_s * parameters.u_max_m_s;
  const auto by_rate = [&](double rate) {
    const double half = closing / rate;
    return half + std::sqrt((half + w) * (half + w) + barrier.radius_m * barrier.radius_m);
  };
  const double held = by_rate(1.0 / barrier.hold_s);
  if (parameters.kind == BarrierKind::kLagAware) return std::max(held, by_rate(barrier.gain));
  const auto slack = [&](double d) {
    const double h = (d - barrier.radius_m) * (d + barrier.radius_m);
    return barrier.gain * h * h * h - 2.0 * d * closing;
  };
  double low = barrier.radius_m;
  double high = std::max(1.0, 2.0 * barrier.radius_m);
  while (slack(high) < 0.0 && high < std::numeric_limits<double>::max() / 4.0) high *= 2.0;
  for (int i = 0; i < 64; ++i) {
    const double middle = 0.5 * (low + high);
    (slack(middle) < 0.0 ? low : high) = middle;
  }
  return std::max(held, high);
}

double closing_speed_of(const Body& other) {
  return other.is_controlled ? 0.0 : std::max(0.0, other.uncooperative_speed_m_s);
}

/// How far two drones may have come since they were seen.
double drift_of(const BarrierParameters& parameters, const Body& own, const Body& other) {
  const double u_max = parameters.u_max_m_s;
  return u_max * std::max(0.0, own.age_s) + std::max(u_max, closing_speed_of(other)) * std::max(0.0, other.age_s);
}

PairBarrier barrier_of_distance(const BarrierParameters& parameters, const Body& other, double distance, double drift,
                                double gain) {
  const double lag = barrier_lag(parameters);
  const double u_max = parameters.u_max_m_s;
  const double speed = closing_speed_of(other);
  PairBarrier barrier;
  barrier.gain = gain;
  if (other.is_controlled) {
    // Between two samples with h >= 0 the sum may dip below 0, by no more than 5 (u_max dt)^2: [6].
    const double dip = lag > 0.0 ? std::sqrt(5.0) * u_max * parameters.dt_s : 0.0;
    barrier.radius_m = std::hypot(distance, dip) + drift;
    barrier.lag_s = lag;
    barrier.hold_s = 2.0 * parameters.dt_s;
  } else {
    // With z_j = p_j: |z_ij|^2 = |p_ij|^2 + 2 lag p_ij.v_j + lag^2 |v_i|^2 there, whatever the other's velocity does.
    barrier.radius_m = std::sqrt(distance * distance + 2.0 * lag * speed * distance + std::pow(lag * u_max, 2)) + drift;
    barrier.hold_s = parameters.dt_s;
    barrier.closing_speed_m_s = speed;
  }
  return barrier;
}

PairBarrier barrier_of_two_drones(const BarrierParameters& parameters) {
  return separation_barrier(parameters, Body{}, Body{});
}

}  // namespace

double barrier_lag(const BarrierParameters& parameters) {
  return parameters.kind == BarrierKind::kLagAware ? parameters.lag_s : 0.0;
}

Vec2 parting_direction(int own, int other) { return own < other ? Vec2(1.0, 0.0) : Vec2(-1.0, 0.0); }

pair_formula::Rule pair_formula::rule_of(const BarrierParameters& parameters, const PairBarrier& barrier) {
  return {.is_paper = parameters.kind == BarrierKind::kPaper,
          .u_max_m_s = parameters.u_max_m_s,
          .gain = barrier.gain,
          .hold_s = barrier.hold_s,
          .closing_speed_m_s = barrier.closing_speed_m_s,
          .sampling = sampling_of(barrier.lag_s, parameters.dt_s)};
}

double barrier_radius(const BarrierParameters& parameters) { return barrier_of_two_drones(parameters).radius_m; }

double derived_sensing_range(const BarrierParameters& parameters) {
  return pair_reach(parameters, barrier_of_two_drones(parameters));
}

double least_sensing_range(const BarrierParameters& parameters) {
  const double w = 2.0 * barrier_lag(parameters) * parameters.u_max_m_s;
  const double met_at = w + std::hypot(barrier_radius(parameters), w) + 2.0 * parameters.u_max_m_s * parameters.dt_s;
  return std::min(met_at, derived_sensing_range(parameters));
}

Vec2 barrier_point(const BarrierParameters& parameters, const Body& body) {
  if (!body.is_controlled) return body.position;
  return body.position + barrier_lag(parameters) * body.velocity;
}

PairBarrier separation_barrier(const BarrierParameters& parameters, const Body& own, const Body& other) {
  return barrier_of_distance(parameters, other, parameters.separation_m + pair_margin_of(parameters),
                             drift_of(parameters, own, other), parameters.pair_gain);
}

PairBarrier margin_barrier(const BarrierParameters& parameters, const Body& other) {
  PairBarrier barrier = barrier_of_distance(parameters, other, parameters.separation_m + pair_margin_of(parameters),
                                            0.0, parameters.pair_gain);
  barrier.closing_speed_m_s = 0.0;
  return barrier;
}

PairBarrier bare_separation_barrier(const BarrierParameters& parameters, const Body& other) {
  const bool is_paper = parameters.kind == BarrierKind::kPaper;
  const double gain = is_paper ? parameters.pair_gain : std::max(parameters.pair_gain, kBareGain);
  return barrier_of_distance(parameters, other, parameters.separation_m, 0.0, gain);
}

PairBarrier contact_barrier(const BarrierParameters& parameters, const Body& other) {
  return barrier_of_distance(parameters, other, parameters.contact_distance_m, 0.0, std::numeric_limits<double>::max());
}

double wall_margin(const BarrierParameters& parameters) {
  return parameters.kind == BarrierKind::kLagAware ? parameters.margin_m : 0.0;
}

double wall_reserve(const BarrierParameters& parameters, const Body& own) {
  return wall_margin(parameters) + parameters.u_max_m_s * std::max(0.0, own.age_s);
}

std::optional<HalfPlane> pair_row(const BarrierParameters& parameters, const PairBarrier& barrier, const Vec2& z_ij,
                                  const Vec2& v_ij, int own, int other, Priority priority) {
  const pair_formula::Row row = pair_formula::row(pair_formula::rule_of(parameters, barrier), barrier.radius_m,
                                                  z_ij.x(), z_ij.y(), v_ij.x(), v_ij.y());
  if (row.lever <= kCoincident) return binding(parameters, {parting_direction(own, other), row.offset, priority});
  return binding(parameters, {Vec2(row.half_slope_x / row.lever, row.half_slope_y / row.lever), row.offset, priority});
}

double pair_reach(const BarrierParameters& parameters, const PairBarrier& barrier) {
  return reach_of_row(parameters, barrier);
}

double wall_reach(const BarrierParameters& parameters, double reserve_m) {
  const double radius = parameters.wall_distance_m + reserve_m;
  const auto binds = [&](double distance) {  // with a little to spare
    return fixed_offset(parameters, distance, radius) > -(1.0 + 1e-9) * parameters.u_max_m_s;
  };
  double low = radius;
  double high = radius + 1.0;
  while (binds(high) && high < std::numeric_limits<double>::max() / 4.0) high *= 2.0;
  for (int i = 0; i < 64; ++i) {
    const double middle = 0.5 * (low + high);
    (binds(middle) ? low : high) = middle;
  }
  return high;
}

double wall_distance(const field::Field& field, const Vec2& z, int wall) {
  const std::array distances{z.x(), field.length_x - z.x(), z.y(), field.length_y - z.y()};
  return distances[static_cast<std::size_t>(wall)];
}

std::optional<HalfPlane> wall_row(const BarrierParameters& parameters, const field::Field& field, const Vec2& z,
                                  int wall, double reserve_m, Priority priority) {
  static const std::array<Vec2, 4> kInward{Vec2(1.0, 0.0), Vec2(-1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, -1.0)};
  const double distance = wall_distance(field, z, wall);
  const double radius = parameters.wall_distance_m + reserve_m;
  if (beyond_wall_range(parameters, distance, radius)) return std::nullopt;
  const double offset = fixed_offset(parameters, distance, radius);
  return binding(parameters, {kInward[static_cast<std::size_t>(wall)], offset, priority});
}

double no_fly_radius(const BarrierParameters& parameters, double reserve_m) {
  return std::hypot(parameters.no_fly_buffer_m + reserve_m, barrier_lag(parameters) * parameters.u_max_m_s);
}

std::size_t outline_length(std::span<const field::Segment> edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i].a != edges[i - 1].b) break;
    if (i > 0 && edges[i].b == edges.front().a) return i + 1;
  }
  return std::min<std::size_t>(1, edges.size());
}

bool encloses(std::span<const field::Segment> outline, const Vec2& z) {
  if (outline.size() < 3) return false;
  bool inside = false;
  for (const field::Segment& edge : outline) {
    if ((edge.a.y() > z.y()) == (edge.b.y() > z.y())) continue;
    const double x = edge.a.x() + (z.y() - edge.a.y()) / (edge.b.y() - edge.a.y()) * (edge.b.x() - edge.a.x());
    if (z.x() < x) inside = !inside;
  }
  return inside;
}

bool is_enclosed(std::span<const field::Segment> edges, const Vec2& z) {
  while (!edges.empty()) {
    const std::size_t count = outline_length(edges);
    if (encloses(edges.first(count), z)) return true;
    edges = edges.subspan(count);
  }
  return false;
}

std::optional<HalfPlane> edge_row(const BarrierParameters& parameters, const field::Segment& edge, const Vec2& z,
                                  double reserve_m, Priority priority) {
  const Vec2 away = z - field::nearest_point(edge, z);
  const double distance = away.norm();
  const double radius = no_fly_radius(parameters, reserve_m);
  if (beyond_wall_range(parameters, distance, radius)) return std::nullopt;
  const Vec2 normal = distance > kCoincident ? Vec2(away / distance) : outward(edge);
  return binding(parameters, {normal, fixed_offset(parameters, distance, radius), priority});
}

WayOut way_out(const BarrierParameters& parameters, std::span<const field::Segment> outline, const Vec2& z) {
  WayOut way;
  way.distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 there = field::nearest_point(outline[i], z) - z;
    const double distance = there.norm();
    if (!(distance < way.distance_m)) continue;
    way.distance_m = distance;
    way.edge = i;
    way.row.normal = distance > kCoincident ? Vec2(there / distance) : outward(outline[i]);
  }
  way.row.offset =
      pair_formula::escape_speed(parameters.u_max_m_s, way.distance_m + no_fly_radius(parameters, 0.0), 0.0);
  way.row.priority = Priority::kWall;
  return way;
}

}  // namespace vigil::safety
