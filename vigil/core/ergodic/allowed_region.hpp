#pragma once

#include <span>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"

namespace vigil::ergodic {

/// Where predicted paths may lead: the field without a margin along its walls, and away from no-fly polygons. It guides
/// predictions and guarantees nothing; that is the safety filter's business. Metres.
struct AllowedRegion {
  field::Field field;
  double wall_distance_m = 0.0;            ///< in [0, half the shorter side]
  double no_fly_distance_m = 0.0;          ///< kept from every edge
  std::span<const field::Segment> no_fly;  ///< edges of any number of polygons, inside on the left
};

/// A point that was kept inside, and what kept it. The normals point into the region; zero where nothing held.
struct KeptPoint {
  Vec2 point = Vec2::Zero();
  Vec2 wall_normal = Vec2::Zero();  ///< a sum of the held walls' normals
  Vec2 edge_normal = Vec2::Zero();

  /// The slope that is left for a point that slides along what keeps it: without its part that pushes against a normal.
  [[nodiscard]] Vec2 slide(Vec2 slope) const noexcept;
};

/// The point of the region next to q: away from the nearest no-fly edge first (out of its polygon where q is inside),
/// then within the walls. Near corners where several edges meet one step may not suffice. Precondition: q finite.
[[nodiscard]] KeptPoint keep_inside(const AllowedRegion& region, const Vec2& q) noexcept;

}  // namespace vigil::ergodic
