#include "vigil/core/guidance/way_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vigil/core/safety/barrier.hpp"

namespace vigil::guidance {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kWidestTurn = std::numbers::pi / 3.0;  ///< that one corner rounds
constexpr double kFartherOut = 1.05;      ///< so that a line between two corners is clear, whatever rounding does
constexpr double kLeastClearance = 1e-4;  ///< of the field's shorter side
constexpr double kRounding = 1e-9;        ///< of the clearance

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The smaller of the distances of two intervals' nearest ends, 0 where they overlap.
double gap(double a0, double a1, double b0, double b1) {
  return std::max({0.0, std::min(b0, b1) - std::max(a0, a1), std::min(a0, a1) - std::max(b0, b1)});
}

bool is_far(const field::Segment& one, const field::Segment& other, double distance_m) {
  const double x = gap(one.a.x(), one.b.x(), other.a.x(), other.b.x());
  const double y = gap(one.a.y(), one.b.y(), other.a.y(), other.b.y());
  return x * x + y * y >= distance_m * distance_m;
}

double distance(const field::Segment& segment, const Vec2& p) { return (field::nearest_point(segment, p) - p).norm(); }

bool cross_each_other(const field::Segment& one, const field::Segment& other) {
  const Vec2 along = one.b - one.a;
  const Vec2 across = other.b - other.a;
  const double a = cross(along, other.a - one.a);
  const double b = cross(along, other.b - one.a);
  const double c = cross(across, one.a - other.a);
  const double d = cross(across, one.b - other.a);
  return (a > 0.0) != (b > 0.0) && (c > 0.0) != (d > 0.0);
}

bool is_clear(const field::Segment& line, const field::Segment& edge, double clearance_m) {
  if (is_far(line, edge, clearance_m)) return true;
  if (cross_each_other(line, edge)) return false;
  const double least =
      std::min({distance(edge, line.a), distance(edge, line.b), distance(line, edge.a), distance(line, edge.b)});
  return least >= clearance_m * (1.0 - kRounding);
}

/// Numbers in [0, 1) that fill it evenly (the golden section's sequence).
double share_of(std::size_t count) {
  const double x = std::numbers::phi * static_cast<double>(count);
  return x - std::floor(x);
}

/// A line's two ends have three corners each; nothing has more.
std::size_t most_candidates(const WayParameters& parameters) { return 6 * parameters.most_edges; }

}  // namespace

WayMap::WayMap(const WayParameters& parameters) : parameters_(parameters) {
  const double side_m = std::min(parameters.field.length_x, parameters.field.length_y);
  parameters_.clearance_m = std::max(parameters.clearance_m, kLeastClearance * side_m);
  edges_.reserve(parameters.most_edges);
  candidates_.reserve(most_candidates(parameters));
  corners_.reserve(kMostCorners);
  lengths_.reserve(kMostCorners * kMostCorners);
  from_.reserve(kMostCorners);
  to_.reserve(kMostCorners);
}

void WayMap::begin(std::span<const field::Segment> no_fly) noexcept {
  const auto kept = no_fly.first(std::min(no_fly.size(), parameters_.most_edges));
  edges_.assign(kept.begin(), kept.end());
  find_corners();
  const std::size_t count = corners_.size();
  lengths_.assign(count * count, kFar);
  for (std::size_t i = 0; i < count; ++i) length(i, i) = 0.0;
  from_.assign(count, kFar);
  to_.assign(count, kFar);
  row_ = 0;
  column_ = 0;
  step_ = count > 0 ? Step::kSeeing : Step::kReady;
}

double WayMap::distance_to_edges(const Vec2& place) const noexcept {
  double least = kFar;
  for (const field::Segment& edge : edges_) least = std::min(least, distance(edge, place));
  return least;
}

/// Clear of walls and edges, and inside of no polygon.
bool WayMap::is_open(const Vec2& place) const noexcept {
  const field::Field& field = parameters_.field;
  const double wall_m = std::min({place.x(), place.y(), field.length_x - place.x(), field.length_y - place.y()});
  if (!(wall_m >= parameters_.wall_distance_m) || !(distance_to_edges(place) >= parameters_.clearance_m)) return false;
  return !safety::is_enclosed(edges_, place);
}

/// Tangents to the circle of the clearance round a convex vertex, each turning by at most kWidestTurn, meet at the
/// corners. `before`, `after`: the directions of the edges there, the inside on their left.
void WayMap::add_corners(const Vec2& vertex, const Vec2& before, const Vec2& after) noexcept {
  double turn = std::atan2(cross(before, after), before.dot(after));
  const bool is_line_s_end = before.dot(after) < 0.0 && cross(before, after) == 0.0;
  if (is_line_s_end) turn = std::numbers::pi;
  if (!(turn > 0.0)) return;
  const double pieces = std::ceil(turn / kWidestTurn - kRounding);
  const double reach_m = kFartherOut * parameters_.clearance_m / std::cos(0.5 * turn / pieces);
  const double outward = std::atan2(before.y(), before.x()) - 0.5 * std::numbers::pi;
  for (double piece = 0.5; piece < pieces; piece += 1.0) {
    const double angle = outward + piece * turn / pieces;
    const Vec2 place = vertex + reach_m * Vec2(std::cos(angle), std::sin(angle));
    if (candidates_.size() == most_candidates(parameters_) || !is_open(place)) continue;
    candidates_.push_back({.place = place, .turn_rad = turn / pieces, .share = share_of(candidates_.size())});
  }
}

void WayMap::find_corners() noexcept {
  candidates_.clear();
  std::span<const field::Segment> rest = edges_;
  while (!rest.empty()) {
    const std::size_t count = safety::outline_length(rest);
    for (std::size_t i = 0; i < count; ++i) {
      const field::Segment& before = rest[(i + count - 1) % count];
      const Vec2 along = rest[i].b - rest[i].a;
      add_corners(rest[i].a, count > 1 ? Vec2(before.b - before.a) : Vec2(-along), along);
      if (count == 1) add_corners(rest[i].b, along, -along);
    }
    rest = rest.subspan(count);
  }
  const auto sharper = [](const Corner& one, const Corner& other) {
    return one.turn_rad != other.turn_rad ? one.turn_rad > other.turn_rad : one.share < other.share;
  };
  std::sort(candidates_.begin(), candidates_.end(), sharper);
  corners_.clear();
  for (std::size_t i = 0; i < std::min(candidates_.size(), kMostCorners); ++i) corners_.push_back(candidates_[i].place);
}

double WayMap::clearance_at(const Vec2& place) const noexcept {
  return std::min(parameters_.clearance_m, distance_to_edges(place));
}

bool WayMap::is_free(const field::Segment& line, double clearance_m) const noexcept {
  return std::all_of(edges_.begin(), edges_.end(),
                     [&](const field::Segment& edge) { return is_clear(line, edge, clearance_m); });
}

bool WayMap::sees(const Vec2& from, const Vec2& to) const noexcept {
  if (!from.allFinite() || !to.allFinite()) return false;
  return is_free({from, to}, std::min(clearance_at(from), clearance_at(to)));
}

void WayMap::see_next() noexcept {
  if (column_ <= row_) column_ = row_ + 1;
  if (column_ < corners_.size()) {
    if (is_free({corners_[row_], corners_[column_]}, parameters_.clearance_m))
      length(row_, column_) = length(column_, row_) = (corners_[row_] - corners_[column_]).norm();
    ++column_;
    return;
  }
  column_ = 0;
  if (++row_ < corners_.size()) return;
  row_ = 0;
  step_ = Step::kJoining;
}

/// Floyd and Warshall's step: ways that bend at the corner row_ or at one before it.
void WayMap::join_next() noexcept {
  const std::size_t count = corners_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double first = length(i, row_);
    if (first == kFar) continue;
    for (std::size_t j = 0; j < count; ++j) length(i, j) = std::min(length(i, j), first + length(row_, j));
  }
  if (++row_ == count) step_ = Step::kReady;
}

void WayMap::work(std::size_t looks) noexcept {
  constexpr std::size_t kSumsInALook = 8;
  std::size_t done = 0;
  do {
    if (step_ == Step::kSeeing) {
      see_next();
      done += edges_.size();
    } else if (step_ == Step::kJoining) {
      join_next();
      done += 1 + corners_.size() * corners_.size() / kSumsInALook;
    }
  } while (!is_ready() && done < looks);
}

void WayMap::look_around(const Vec2& from, std::span<double> lengths) const noexcept {
  const double clearance_m = clearance_at(from);
  for (std::size_t i = 0; i < corners_.size(); ++i)
    lengths[i] = is_free({from, corners_[i]}, clearance_m) ? (corners_[i] - from).norm() : kFar;
}

std::optional<Way> WayMap::way(const Vec2& from, const Vec2& to) noexcept {
  if (sees(from, to)) return Way{.length_m = (to - from).norm(), .next = to};
  if (!is_ready() || !from.allFinite() || !to.allFinite()) return std::nullopt;
  look_around(from, from_);
  look_around(to, to_);
  const double there_m = kRounding * parameters_.clearance_m;
  Way best{.length_m = kFar};
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    if (from_[i] == kFar || from_[i] <= there_m) continue;  // a corner that it is at leads nowhere
    double rest = kFar;
    for (std::size_t j = 0; j < corners_.size(); ++j) rest = std::min(rest, length(i, j) + to_[j]);
    if (from_[i] + rest < best.length_m) best = {.length_m = from_[i] + rest, .next = corners_[i]};
  }
  if (best.length_m == kFar) return std::nullopt;
  return best;
}

}  // namespace vigil::guidance
