#include "vigil/core/ergodic/allowed_region.hpp"

#include <algorithm>
#include <limits>

namespace vigil::ergodic {
namespace {

struct NearestEdge {
  Vec2 point = Vec2::Zero();
  double distance_m = std::numeric_limits<double>::infinity();
  int winding = 0;  ///< how often the outlines go round q: above 0 inside a polygon
};

// By how much the edge adds to the winding number of its outline round q.
int winding_of(const field::Segment& edge, const Vec2& q) noexcept {
  const Vec2 along = edge.b - edge.a;
  const Vec2 to_q = q - edge.a;
  const double left = along.x() * to_q.y() - along.y() * to_q.x();
  if (edge.a.y() <= q.y()) return edge.b.y() > q.y() && left > 0.0 ? 1 : 0;
  return edge.b.y() <= q.y() && left < 0.0 ? -1 : 0;
}

NearestEdge nearest_edge(std::span<const field::Segment> edges, const Vec2& q) noexcept {
  NearestEdge nearest;
  for (const field::Segment& edge : edges) {
    nearest.winding += winding_of(edge, q);
    const Vec2 point = field::nearest_point(edge, q);
    const double distance_m = (q - point).norm();
    if (distance_m >= nearest.distance_m) continue;
    nearest.distance_m = distance_m;
    nearest.point = point;
  }
  return nearest;
}

void keep_off_edges(const AllowedRegion& region, KeptPoint& kept) noexcept {
  if (region.no_fly.empty()) return;
  const NearestEdge nearest = nearest_edge(region.no_fly, kept.point);
  const bool is_inside = nearest.winding > 0;
  if (!is_inside && nearest.distance_m >= region.no_fly_distance_m) return;
  if (nearest.distance_m <= 0.0) return;  // on the outline: no direction is known, and the next piece will have one
  kept.edge_normal = (kept.point - nearest.point) / (is_inside ? -nearest.distance_m : nearest.distance_m);
  kept.point = nearest.point + region.no_fly_distance_m * kept.edge_normal;
}

// Keeps x in [low, high]; which end held it, as the direction inwards.
double keep_between(double low, double high, double& x) noexcept {
  const double before = x;
  x = std::clamp(x, low, high);
  return x > before ? 1.0 : x < before ? -1.0 : 0.0;
}

Vec2 without_push(const Vec2& slope, const Vec2& normal) noexcept {
  return slope - std::max(0.0, slope.dot(normal)) * normal;  // a drone goes down the slope: against it
}

}  // namespace

Vec2 KeptPoint::slide(Vec2 slope) const noexcept {
  slope = without_push(slope, edge_normal);
  slope = without_push(slope, Vec2(wall_normal.x(), 0.0));
  return without_push(slope, Vec2(0.0, wall_normal.y()));
}

KeptPoint keep_inside(const AllowedRegion& region, const Vec2& q) noexcept {
  KeptPoint kept{.point = q};
  keep_off_edges(region, kept);
  const double margin = region.wall_distance_m;
  kept.wall_normal.x() = keep_between(margin, region.field.length_x - margin, kept.point.x());
  kept.wall_normal.y() = keep_between(margin, region.field.length_y - margin, kept.point.y());
  return kept;
}

}  // namespace vigil::ergodic
