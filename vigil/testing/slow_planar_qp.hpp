#pragma once

#include <cmath>
#include <vector>

#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety::slow {

/// The obvious solver in long double, for tests only: it writes down every point that could be the answer and keeps the
/// best. It shares nothing with solve() but the statement of the problem. Rows without a normal are left out.
struct Point {
  long double x = 0;
  long double y = 0;
};

struct Line {  ///< a x + b y = c, and as a row a x + b y >= c; (a, b) of any length
  long double a, b, c;
  std::size_t priority;
};

struct Answer {
  Point u;
  long double objective = 0;  ///< |u - u_nom|^2
  std::array<long double, kPriorities> violation{};
};

inline long double violation(const Line& row, const Point& u) { return row.c - row.a * u.x - row.b * u.y; }

class Solver {
 public:
  Solver(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius)
      : u_nom_{u_nom.x(), u_nom.y()}, radius_(radius) {
    for (const HalfPlane& row : rows) {
      const long double a = row.normal.x();
      const long double b = row.normal.y();
      const long double length = std::hypot(a, b);
      if (length == 0) continue;
      rows_.push_back({a / length, b / length, static_cast<long double>(row.offset) / length,
                       static_cast<std::size_t>(row.priority)});
      size_ = std::max(size_, std::abs(rows_.back().c));
    }
    size_ = std::max(size_, radius_);
  }

  /// The radius or the largest offset, at least 1.
  [[nodiscard]] long double size_of_data() const { return size_; }

  /// The answer where every priority is loosened by `slack` once it has been settled: 0 for the exact answer.
  [[nodiscard]] Answer answer(long double slack = 0) const { return answer(nullptr, slack); }

  /// What each priority's least violation and u would be if those before it had been settled at `claimed` + `slack`.
  /// An empty set has the violation or objective HUGE_VALL.
  [[nodiscard]] Answer answer_given(const std::array<double, kPriorities>& claimed, long double slack) const {
    return answer(&claimed, slack);
  }

 private:
  static constexpr long double kNoise = 1e-18L;  ///< relative to the size of the data; grows with every
  /// priority, so that what one priority reached the next cannot find empty

  [[nodiscard]] Answer answer(const std::array<double, kPriorities>* claimed, long double slack) const {
    Answer result;
    std::vector<Line> settled;
    std::vector<Point> found;
    for (std::size_t p = 0; p < kPriorities; ++p) {
      std::vector<Line> level;
      for (const Line& row : rows_) {
        if (row.priority == p) level.push_back(row);
      }
      const long double least = level.empty() ? 0 : least_violation(settled, level, kNoise * (1.0L + p), found);
      result.violation[p] = least;
      for (Line row : level) {
        row.c -= slack + (claimed == nullptr ? least : static_cast<long double>((*claimed)[p]));
        settled.push_back(row);
      }
    }
    closest(settled, found, result);
    return result;
  }

  [[nodiscard]] bool allowed(const std::vector<Line>& rows, const Point& u, long double noise) const {
    if (std::hypot(u.x, u.y) > radius_ + noise * size_) return false;
    for (const Line& row : rows) {
      if (violation(row, u) > noise * size_) return false;
    }
    return true;
  }

  /// By steps along p, so that the point lies on both lines even where they are nearly parallel (Cramer's rule does
  /// not).
  static void intersect(const Line& p, const Line& q, std::vector<Point>& points) {
    const long double squared = p.a * p.a + p.b * p.b;
    const long double crossing = q.b * p.a - q.a * p.b;
    if (squared == 0 || crossing == 0) return;
    const Point foot{p.a * p.c / squared, p.b * p.c / squared};
    const long double step = violation(q, foot) / crossing;
    points.push_back({foot.x - step * p.b, foot.y + step * p.a});
  }

  void intersect_circle(const Line& line, std::vector<Point>& points) const {
    const long double length = std::hypot(line.a, line.b);
    if (length == 0) return;
    const long double a = line.a / length;
    const long double b = line.b / length;
    const long double c = line.c / length;
    const long double squared = (radius_ - c) * (radius_ + c);
    if (squared < -kNoise * size_ * radius_) return;
    const long double half = std::sqrt(std::max(0.0L, squared));
    points.push_back({a * c - b * half, b * c + a * half});
    points.push_back({a * c + b * half, b * c - a * half});
  }

  /// The corners of all lines with each other and with the circle.
  [[nodiscard]] std::vector<Point> corners(const std::vector<Line>& lines) const {
    std::vector<Point> points;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      intersect_circle(lines[i], points);
      for (std::size_t j = 0; j < i; ++j) intersect(lines[i], lines[j], points);
    }
    return points;
  }

  /// The least of max(0, the level's violations): it is attained where nothing is violated, at the circle's extreme
  /// point of a row, or at a corner of lines on which two rows are violated alike and of lines of settled rows.
  [[nodiscard]] long double least_violation(const std::vector<Line>& settled, const std::vector<Line>& level,
                                            long double noise, std::vector<Point>& found) const {
    std::vector<Line> lines = settled;
    for (std::size_t i = 0; i < level.size(); ++i) {
      lines.push_back(level[i]);
      for (std::size_t j = 0; j < i; ++j) {
        lines.push_back({level[i].a - level[j].a, level[i].b - level[j].b, level[i].c - level[j].c, 0});
      }
    }
    std::vector<Point> points = corners(lines);
    points.push_back({0, 0});
    for (const Line& row : level) points.push_back({radius_ * row.a, radius_ * row.b});
    for (const Line& row : settled) points.push_back({radius_ * row.a, radius_ * row.b});
    points.insert(points.end(), found.begin(), found.end());
    long double least = HUGE_VALL;
    Point best;
    for (const Point& u : points) {
      long double worst = 0;
      for (const Line& row : level) worst = std::max(worst, violation(row, u));
      if (worst < least && allowed(settled, u, noise)) {
        least = worst;
        best = u;
      }
    }
    found.push_back(best);
    return least;
  }

  /// The answer is u_nom, its projection on the circle or a line, or a corner. Where rounding leaves none of these, it
  /// is the point that a priority was settled at.
  void closest(const std::vector<Line>& rows, const std::vector<Point>& found, Answer& result) const {
    std::vector<Point> points = corners(rows);
    points.insert(points.end(), found.begin(), found.end());
    points.push_back(u_nom_);
    const long double length = std::hypot(u_nom_.x, u_nom_.y);
    if (length > 0) points.push_back({u_nom_.x * (radius_ / length), u_nom_.y * (radius_ / length)});
    for (const Line& row : rows) {
      Point foot = u_nom_;
      for (int twice = 0; twice < 2; ++twice) {  // the second step removes the rounding of a far u_nom
        const long double v = violation(row, foot);
        foot = {foot.x + v * row.a, foot.y + v * row.b};
      }
      points.push_back(foot);
    }
    result.objective = HUGE_VALL;
    for (const Point& u : points) {
      const long double dx = u.x - u_nom_.x;
      const long double dy = u.y - u_nom_.y;
      const long double objective = dx * dx + dy * dy;
      if (objective < result.objective && allowed(rows, u, kNoise * (1.0L + kPriorities))) {
        result.objective = objective;
        result.u = u;
      }
    }
  }

  Point u_nom_;
  long double radius_;
  std::vector<Line> rows_;
  long double size_ = 1;
};

}  // namespace vigil::safety::slow
