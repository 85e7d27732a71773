#pragma once

#include <vector>

#include "vigil/core/field/vec2.hpp"

namespace vigil::field {

/// A simple polygon, either orientation, closed implicitly (the last vertex joins the first). Metres, field frame.
struct Polygon {
  std::vector<Vec2> vertices;
};

/// A straight edge of a polygon.
struct Segment {
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
};

/// The point of the segment closest to p; a where both ends coincide. Precondition: finite.
[[nodiscard]] Vec2 nearest_point(const Segment& segment, const Vec2& p);

/// Unsigned area, square metres. Zero for fewer than three vertices.
[[nodiscard]] double area(const Polygon& polygon);

/// True where p is inside; points exactly on an edge may fall on either side. Precondition: finite.
[[nodiscard]] bool contains(const Polygon& polygon, const Vec2& p);

/// Distance from p to the outline: positive outside, negative inside. Precondition: finite, at least three vertices.
[[nodiscard]] double signed_distance(const Polygon& polygon, const Vec2& p);

/// True where at least three finite vertices enclose an area and no two edges cross, touch or overlap
/// (but for neighbours, which share their vertex). Decided by exact arithmetic for coordinates from 1e-100 to 1e100;
/// the time grows with the square of the number of vertices (a few milliseconds for a thousand).
[[nodiscard]] bool is_simple(const Polygon& polygon);

/// The outline counter-clockwise, whatever the order of the vertices: walking each edge from a to b, the inside lies on
/// the left. Empty for fewer than three vertices. Precondition: simple.
[[nodiscard]] std::vector<Segment> edges(const Polygon& polygon);

}  // namespace vigil::field
