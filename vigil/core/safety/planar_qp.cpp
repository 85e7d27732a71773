#include "vigil/core/safety/planar_qp.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vigil/core/safety/planar_qp_arithmetic.hpp"

namespace vigil::safety {
namespace {

using planar_qp::kParallel;
using planar_qp::kRounding;
using planar_qp::kUnit;

/// Data beyond this is cut down to it, so that squares stay finite.
constexpr double kLargest = 1e100;
constexpr double kSmallest = 1e-100;  ///< a smaller radius is 0

double dot(const Vec2& a, const Vec2& b) { return a.x() * b.x() + a.y() * b.y(); }
Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }
double size(const Vec2& v) { return std::abs(v.x()) + std::abs(v.y()); }

double gap(const HalfPlane& row, const Vec2& u) { return row.offset - dot(row.normal, u); }

double rounding(const HalfPlane& row, const Vec2& u) {
  return kRounding * (std::abs(row.offset) + size(row.normal) * size(u));
}

bool broken(const HalfPlane& row, const Vec2& u) {
  const double g = gap(row, u);
  return g > 0.0 && g > rounding(row, u);
}

/// The row with a unit normal; a zero normal stays as it is.
HalfPlane normalised(const HalfPlane& row) {
  if (std::abs(dot(row.normal, row.normal) - 1.0) <= kUnit)
    return {row.normal, std::clamp(row.offset, -kLargest, kLargest), row.priority};
  const double largest = row.normal.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return row;
  const Vec2 direction = row.normal / largest;  // first, so that no square under- or overflows
  const double length = std::sqrt(dot(direction, direction));
  return {direction / length, std::clamp(row.offset / largest / length, -kLargest, kLargest), row.priority};
}

Vec2 within_largest(const Vec2& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > kLargest ? Vec2(v * (kLargest / largest)) : v;
}

/// The point of the disk closest to u.
Vec2 clipped(const Vec2& u, double radius) {
  if (radius == 0.0) return Vec2::Zero();
  const double squared = dot(u, u);
  return squared > radius * radius ? Vec2(u * (radius / std::sqrt(squared))) : u;
}

/// The point of a feasible set closest to u_nom, and what holds it there; or the row at which the set became empty.
struct Projection {
  Vec2 u = Vec2::Zero();
  int line = -1;  ///< u lies on the line of this row, -1: on none
  int end = -1;   ///< and at the end that this row sets to the allowed part of the line, -1: at none
  bool on_disk = false;
  int failed = -1;  ///< no point of the disk satisfies this row and all those before it
};

/// A row's line inside the disk: u(t) = base + t direction, |t| <= half.
struct Chord {
  Vec2 base, direction;
  double half;

  Chord(const HalfPlane& unit_row, double radius)
      : base(unit_row.normal * std::clamp(unit_row.offset, -radius, radius)),
        direction(turned_left(unit_row.normal)),
        half(std::sqrt(std::max(0.0, (radius - unit_row.offset) * (radius + unit_row.offset)))) {}

  [[nodiscard]] Vec2 at(double t) const { return base + t * direction; }
  [[nodiscard]] double clamp(double t) const { return std::clamp(t, -half, half); }
};

/// A row's line, and its point closest to u_nom that satisfies some rows: a problem in one variable.
class Line {
 public:
  Line(const Vec2& u_nom, std::span<const HalfPlane> rows, std::size_t i, double radius)
      : rows_(rows), i_(i), line_(normalised(rows[i])), chord_(line_, radius) {
    const double t_nom = dot(chord_.direction, u_nom);
    const double t = chord_.clamp(t_nom);
    best_ = {chord_.at(t), static_cast<int>(i), -1, t != t_nom, -1};
    is_empty_ = broken(line_, best_.u);  // also where the normal is zero
  }

  /// Moves on to where row j is satisfied.
  void satisfy(std::size_t j) {
    const HalfPlane& row = rows_[j];
    if (is_empty_ || !broken(row, best_.u)) return;
    const double slope = dot(row.normal, chord_.direction);
    is_empty_ = std::abs(slope) <= kParallel * size(row.normal);
    if (is_empty_) return;
    // A row that is nearly parallel cuts the line where rounding says: better a little too late than far too early.
    const double wanted = (gap(row, chord_.base) - 0.5 * rounding(row, chord_.base)) / slope;
    const double t = chord_.clamp(wanted);
    best_.u = chord_.at(t);
    best_.on_disk = t != wanted;
    best_.end = best_.on_disk ? -1 : static_cast<int>(j);
  }

  void check(std::size_t j) { is_empty_ = is_empty_ || broken(rows_[j], best_.u); }

  [[nodiscard]] Projection best() const {
    if (!is_empty_) return best_;
    Projection failure;
    failure.failed = static_cast<int>(i_);
    return failure;
  }

 private:
  std::span<const HalfPlane> rows_;
  std::size_t i_;
  HalfPlane line_;
  Chord chord_;
  Projection best_;
  bool is_empty_ = false;
};

Projection clipped_projection(const Vec2& u_nom, double radius) {
  Projection best;
  best.u = clipped(u_nom, radius);
  best.on_disk = dot(u_nom, u_nom) > radius * radius;
  return best;
}

/// Row by row: where the best point so far breaks a row, the best point with that row lies on the row's line.
Projection project(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius) {
  Projection best = clipped_projection(u_nom, radius);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!broken(rows[i], best.u)) continue;
    Line line(u_nom, rows, i, radius);
    for (std::size_t j = 0; j < i; ++j) line.satisfy(j);
    for (std::size_t j = 0; j < i; ++j) line.check(j);
    best = line.best();
    if (best.failed >= 0) break;
  }
  return best;
}

/// The row that u breaks most; rows.size() for none.
std::size_t worst_row(std::span<const HalfPlane> rows, const Vec2& u) {
  std::size_t worst = rows.size();
  double largest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double g = gap(rows[i], u);
    if (!(g > largest && g > rounding(rows[i], u))) continue;
    largest = g;
    worst = i;
  }
  return worst;
}

/// The same, beginning with the row that is broken most: it often leaves no other to be broken.
Projection project_from_worst(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius) {
  Projection best = clipped_projection(u_nom, radius);
  const std::size_t first = worst_row(rows, best.u);
  if (first == rows.size()) return best;
  best = Line(u_nom, rows, first, radius).best();
  for (std::size_t i = 0; i < rows.size() && best.failed < 0; ++i) {
    if (i == first || !broken(rows[i], best.u)) continue;
    Line line(u_nom, rows, i, radius);
    line.satisfy(first);
    for (std::size_t j = 0; j < i; ++j)
      if (j != first) line.satisfy(j);
    line.check(first);
    for (std::size_t j = 0; j < i; ++j)
      if (j != first) line.check(j);
    best = line.best();
  }
  return best;
}

/// The lexicographic relaxation. For one priority after the other: while the rows so far contradict each other, the
/// contradiction (at most three rows, or two and the disk) says by how much at least the priority must be relaxed. Each
/// such bound is attained or followed by a larger one, and there are finitely many: the last is the exact least
/// violation.
class Relaxation {
 public:
  Relaxation(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius) : u_nom_(u_nom), radius_(radius) {
    for (std::size_t p = 0; p < kPriorities; ++p) {
      const std::size_t first = count_;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (static_cast<std::size_t>(rows[i].priority) == p) add(rows[i], static_cast<int>(i));
      }
      bring_within_reach(first, p);
      settle(p);
    }
  }

  [[nodiscard]] PlanarQpSolution solution() const {
    PlanarQpSolution result;
    result.u = clipped(best_.u, radius_);
    result.on_disk = best_.on_disk;
    if (best_.line >= 0) result.active[0] = callers_index_[static_cast<std::size_t>(best_.line)];
    if (best_.end >= 0) result.active[1] = callers_index_[static_cast<std::size_t>(best_.end)];
    for (std::size_t p = 0; p < kPriorities; ++p) result.violation[p] = violation_at(result.u, p);
    result.feasible = result.violation == std::array<double, kPriorities>{};
    return result;
  }

 private:
  /// A lower bound of a violation, the rounding of the offsets it is made of, and how often the bound magnifies it.
  struct Bound {
    double value = 0.0;
    double noise = 0.0;
    double magnified = 1.0;
  };

  /// Of priority p at u, once it has been settled; 0 where nothing but rounding asked for one.
  [[nodiscard]] double violation_at(const Vec2& u, std::size_t p) const {
    double worst = constant_violation_[p];
    if (violation_[p] == 0.0 && excess_[p] == 0.0) return worst;
    for (std::size_t i = 0; i < count_; ++i) {
      if (static_cast<std::size_t>(rows_[i].priority) != p) continue;
      worst = std::max(worst, excess_[p] + (offset_[i] - dot(rows_[i].normal, u)));
    }
    return worst;
  }

  void add(const HalfPlane& row, int callers_index) {
    const HalfPlane unit = normalised(row);
    const auto p = static_cast<std::size_t>(unit.priority);
    if (unit.normal == Vec2::Zero()) {  // no u changes it, so nothing else gives way for it
      constant_violation_[p] = std::max(constant_violation_[p], unit.offset);
      return;
    }
    rows_[count_] = unit;
    offset_[count_] = unit.offset;
    callers_index_[count_] = callers_index;
    ++count_;
  }

  /// What the farthest row alone asks for, against the disk, is taken off first and exactly: it may be huge.
  void bring_within_reach(std::size_t first, std::size_t p) {
    double farthest = radius_;
    for (std::size_t i = first; i < count_; ++i) farthest = std::max(farthest, offset_[i]);
    if (farthest - radius_ <= kRounding * farthest) return;
    excess_[p] = farthest - radius_;
    for (std::size_t i = first; i < count_; ++i) offset_[i] = radius_ - (farthest - offset_[i]);
  }

  void settle(std::size_t p) {
    double wider = std::numeric_limits<double>::min();
    for (int round = 0; round < kMaxRounds; ++round) {
      relax();
      best_ = project(u_nom_, std::span(rows_).first(count_), radius_);
      if (best_.failed < 0) return;
      const Bound bound = least_violation(static_cast<std::size_t>(best_.failed), p);
      if (bound.value > violation_[p] + bound.noise) {
        violation_[p] = bound.value;
        // What the slack of the settled rows gained has to be given back, or u is pinned where nothing else pins it.
        const double gained = p > 0 ? slack_[p - 1] : 0.0;
        slack_[p] = std::max(slack_[p], bound.noise * bound.magnified + gained);
      } else {  // nothing but rounding keeps the rows apart
        wider = std::max(4.0 * wider, bound.noise);
        for (std::size_t q = 0; q <= p; ++q) slack_[q] = std::max(slack_[q], wider);
      }
    }
    best_.u = clipped(u_nom_, radius_);
  }

  void relax() {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto p = static_cast<std::size_t>(rows_[i].priority);
      rows_[i].offset = offset_[i] - violation_[p] - slack_[p];
    }
  }

  /// 1 where the priority that is being relaxed owns the row, 0 where the row is settled.
  [[nodiscard]] double weight(std::size_t i, std::size_t p) const {
    return static_cast<std::size_t>(rows_[i].priority) == p ? 1.0 : 0.0;
  }
  /// The offset from which the violation is measured.
  [[nodiscard]] double offset(std::size_t i, std::size_t p) const {
    return static_cast<std::size_t>(rows_[i].priority) == p ? offset_[i] : rows_[i].offset;
  }

  /// The least violation of priority p that the contradiction on line `i` asks for.
  [[nodiscard]] Bound least_violation(std::size_t i, std::size_t p) const {
    const Chord chord(rows_[i], radius_);
    double low = -chord.half;
    double high = chord.half;
    std::size_t low_row = kMaxRows;
    std::size_t high_row = kMaxRows;
    for (std::size_t j = 0; j < i; ++j) {
      const double slope = dot(rows_[j].normal, chord.direction);
      const double missing = gap(rows_[j], chord.base);
      if (std::abs(slope) <= kParallel * size(rows_[j].normal)) {
        if (missing > rounding(rows_[j], chord.base)) return of_two_and_disk(i, j, p);
        continue;
      }
      const double t = missing / slope;
      if (slope > 0.0 && t > low) {
        low = t;
        low_row = j;
      } else if (slope < 0.0 && t < high) {
        high = t;
        high_row = j;
      }
    }
    if (low_row < kMaxRows && high_row < kMaxRows) return of_three(i, low_row, high_row, p);
    if (low_row < kMaxRows) return of_two_and_disk(i, low_row, p);
    if (high_row < kMaxRows) return of_two_and_disk(i, high_row, p);
    return {0.0, noise(i, i, i)};
  }

  /// Rows whose normals, weighted with positive numbers, cancel: so must their offsets, weighted likewise.
  [[nodiscard]] Bound of_three(std::size_t i, std::size_t low, std::size_t high, std::size_t p) const {
    const Vec2 direction = turned_left(rows_[i].normal);
    const double at_low = std::abs(dot(rows_[high].normal, direction));
    const double at_high = std::abs(dot(rows_[low].normal, direction));
    const double at_i = std::max(
        0.0, -at_low * dot(rows_[low].normal, rows_[i].normal) - at_high * dot(rows_[high].normal, rows_[i].normal));
    const double weights = at_i * weight(i, p) + at_low * weight(low, p) + at_high * weight(high, p);
    if (!(weights > 0.0)) return {0.0, noise(i, low, high)};
    return {(at_i * offset(i, p) + at_low * offset(low, p) + at_high * offset(high, p)) / weights, noise(i, low, high),
            std::min(kMostMagnified, (at_i + at_low + at_high) / weights)};
  }

  /// Both rows are violated alike at the best point, and it lies on the circle.
  [[nodiscard]] Bound of_two_and_disk(std::size_t i, std::size_t j, std::size_t p) const {
    const double w_i = weight(i, p);
    const double w_j = weight(j, p);
    const Vec2 across = w_j * rows_[i].normal - w_i * rows_[j].normal;
    const double length = std::sqrt(dot(across, across));
    const double middle = w_j * offset(i, p) - w_i * offset(j, p);
    if (!(std::abs(middle) < radius_ * length)) return {0.0, noise(i, i, j)};
    const Chord alike({across / length, middle / length, Priority::kMargin}, radius_);
    const std::size_t owned = w_i > 0.0 ? i : j;
    const double reach =
        dot(rows_[owned].normal, alike.base) + alike.half * std::abs(dot(rows_[owned].normal, alike.direction));
    return {offset(owned, p) - reach, noise(i, i, j)};
  }

  [[nodiscard]] double noise(std::size_t i, std::size_t j, std::size_t k) const {
    return kRounding * (std::abs(offset_[i]) + std::abs(offset_[j]) + std::abs(offset_[k]));
  }

  /// Far more than any problem takes; the loop ends by itself, since the slack grows without bound.
  static constexpr int kMaxRounds = 100000;
  /// What no slack that is meant for rounding needs to exceed.
  static constexpr double kMostMagnified = 1e5;

  Vec2 u_nom_;
  double radius_;
  std::array<HalfPlane, kMaxRows> rows_;  ///< unit normals, relaxed offsets, by priority
  std::array<double, kMaxRows> offset_;   ///< for unit normals, within the disk's reach
  std::array<int, kMaxRows> callers_index_;
  std::size_t count_ = 0;
  std::array<double, kPriorities> excess_{};     ///< taken off the offsets
  std::array<double, kPriorities> violation_{};  ///< on top of it
  std::array<double, kPriorities> slack_{};      ///< on top of the violation, so that rounding does not empty the set
  std::array<double, kPriorities> constant_violation_{};
  Projection best_;
};

}  // namespace

PlanarQpSolution solve(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius) noexcept {
  assert(rows.size() <= kMaxRows);
  const Vec2 nominal = within_largest(u_nom);
  const double speed = radius > kSmallest ? std::min(radius, kLargest) : 0.0;
  const Projection best = project_from_worst(nominal, rows, speed);
  if (best.failed >= 0) return Relaxation(nominal, rows, speed).solution();
  PlanarQpSolution result;
  result.u = clipped(best.u, speed);
  result.active = {best.line, best.end};
  result.on_disk = best.on_disk;
  return result;
}

}  // namespace vigil::safety
