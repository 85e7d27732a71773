#include "vigil/core/field/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace vigil::field {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Positive where the vertices run counter-clockwise. Relative to the first vertex, so that a small polygon far from the
// origin keeps its digits.
double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.vertices.size(); ++i) {
    const Vec2& o = polygon.vertices.front();
    twice += cross(polygon.vertices[i - 1] - o, polygon.vertices[i] - o);
  }
  return 0.5 * twice;
}

std::size_t next(const Polygon& polygon, std::size_t i) { return i + 1 == polygon.vertices.size() ? 0 : i + 1; }

Segment edge(const Polygon& polygon, std::size_t i) {
  return {polygon.vertices[i], polygon.vertices[next(polygon, i)]};
}

int sign(double x) { return (x > 0.0) - (x < 0.0); }

// A sum of doubles that is never rounded: components of growing magnitude that do not overlap (Shewchuk's expansion),
// so that the last non-zero one has the sign of the whole.
class ExactSum {
 public:
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  [[nodiscard]] int sign_of_sum() const {
    for (std::size_t i = size_; i-- > 0;) {
      if (parts_[i] != 0.0) return sign(parts_[i]);
    }
    return 0;
  }

 private:
  void add(double x) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i];
      const double virtual_part = sum - x;
      parts_[i] = (x - (sum - virtual_part)) + (parts_[i] - virtual_part);
      x = sum;
    }
    parts_[size_++] = x;
  }

  std::array<double, 12> parts_{};
  std::size_t size_ = 0;
};

// (a - c) x (b - c) multiplied out, so that no difference is rounded before it is used.
int exact_turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  ExactSum sum;
  sum.add_product(a.x(), b.y());
  sum.add_product(-a.x(), c.y());
  sum.add_product(-c.x(), b.y());
  sum.add_product(-a.y(), b.x());
  sum.add_product(a.y(), c.x());
  sum.add_product(c.y(), b.x());
  return sum.sign_of_sum();
}

// +1 where a, b, c turn left, -1 where they turn right, 0 where they are on one line.
int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double certain = 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right));
  const double difference = left - right;
  return std::abs(difference) > certain ? sign(difference) : exact_turn(a, b, c);
}

// For p on the line through the segment.
bool within_box(const Segment& s, const Vec2& p) {
  return (p.array() >= s.a.array().min(s.b.array())).all() && (p.array() <= s.a.array().max(s.b.array())).all();
}

bool boxes_apart(const Segment& s, const Segment& t) {
  return (s.a.array().max(s.b.array()) < t.a.array().min(t.b.array())).any() ||
         (t.a.array().max(t.b.array()) < s.a.array().min(s.b.array())).any();
}

bool have_common_point(const Segment& s, const Segment& t) {
  if (boxes_apart(s, t)) return false;
  const int s_ta = turn(s.a, s.b, t.a);
  const int s_tb = turn(s.a, s.b, t.b);
  const int t_sa = turn(t.a, t.b, s.a);
  const int t_sb = turn(t.a, t.b, s.b);
  if (s_ta * s_tb < 0 && t_sa * t_sb < 0) return true;
  return (s_ta == 0 && within_box(s, t.a)) || (s_tb == 0 && within_box(s, t.b)) || (t_sa == 0 && within_box(t, s.a)) ||
         (t_sb == 0 && within_box(t, s.b));
}

// For two edges that follow each other: do they share more than their vertex? Only where they are on one line and one
// of the outer ends lies on the other edge.
bool folds_back(const Segment& first, const Segment& second) {
  return turn(first.a, first.b, second.b) == 0 && (within_box(first, second.b) || within_box(second, first.a));
}

bool any_two_edges_meet(const Polygon& polygon) {
  const std::size_t n = polygon.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (folds_back(edge(polygon, i), edge(polygon, next(polygon, i)))) return true;
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j == n - 1;
      if (!neighbours && have_common_point(edge(polygon, i), edge(polygon, j))) return true;
    }
  }
  return false;
}

}  // namespace

Vec2 nearest_point(const Segment& segment, const Vec2& p) {
  const Vec2 along = segment.b - segment.a;
  const double length_squared = along.squaredNorm();
  if (length_squared == 0.0) return segment.a;
  const double t = std::clamp((p - segment.a).dot(along) / length_squared, 0.0, 1.0);
  return segment.a + t * along;
}

double area(const Polygon& polygon) { return std::abs(signed_area(polygon)); }

bool contains(const Polygon& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    const bool upward = a.y() <= p.y() && p.y() < b.y();
    const bool downward = b.y() <= p.y() && p.y() < a.y();
    if ((upward && turn(a, b, p) > 0) || (downward && turn(a, b, p) < 0)) inside = !inside;
  }
  return inside;
}

double signed_distance(const Polygon& polygon, const Vec2& p) {
  double nearest_squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    nearest_squared = std::min(nearest_squared, (nearest_point(edge(polygon, i), p) - p).squaredNorm());
  }
  return contains(polygon, p) ? -std::sqrt(nearest_squared) : std::sqrt(nearest_squared);
}

bool is_simple(const Polygon& polygon) {
  const auto finite = [](const Vec2& v) { return v.allFinite(); };
  return polygon.vertices.size() >= 3 && std::all_of(polygon.vertices.begin(), polygon.vertices.end(), finite) &&
         !any_two_edges_meet(polygon);
}

std::vector<Segment> edges(const Polygon& polygon) {
  const std::size_t n = polygon.vertices.size();
  if (n < 3) return {};
  std::vector<Segment> outline;
  outline.reserve(n);
  for (std::size_t i = 0; i < n; ++i) outline.push_back(edge(polygon, i));
  if (signed_area(polygon) < 0.0) {
    std::reverse(outline.begin(), outline.end());
    for (Segment& s : outline) std::swap(s.a, s.b);
  }
  return outline;
}

}  // namespace vigil::field
