#pragma once

#include <span>
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

[[nodiscard]] Vec2 nearest_point(const Segment& segment, const Vec2& p);

/// Unsigned area, square metres.
[[nodiscard]] double area(const Polygon& polygon);
/// True where p is inside; points exactly on an edge may fall on either side.
[[nodiscard]] bool contains(const Polygon& polygon, const Vec2& p);
/// Distance from p to the outline: positive outside, negative inside. Precondition: at least three vertices.
[[nodiscard]] double signed_distance(const Polygon& polygon, const Vec2& p);
/// True where at least three vertices enclose an area and no two edges cross, touch or overlap
/// (but for neighbours, which share their vertex).
[[nodiscard]] bool is_simple(const Polygon& polygon);
[[nodiscard]] std::vector<Segment> edges(const Polygon& polygon);

}  // namespace vigil::field
