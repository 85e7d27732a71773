#include "vigil/core/safety/passing_row.hpp"

#include <cmath>

#include "vigil/core/safety/barrier.hpp"

namespace vigil::safety {

std::optional<HalfPlane> passing_row(const BarrierParameters& parameters, const Body& own, const Body& other,
                                     double radius_m, const Vec2& u_nom, Priority priority) {
  const double lag_s = barrier_lag(parameters);
  const Vec2 to_other =
      (other.position + (lag_s + other.age_s) * other.velocity) - (own.position + lag_s * own.velocity);
  const double distance = to_other.norm();
  if (!(distance > radius_m) || to_other.dot(other.velocity) >= 0.0) return std::nullopt;
  const Vec2 ahead = to_other / distance;
  const Vec2 left(-ahead.y(), ahead.x());
  const double sine = radius_m / distance;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double side = left.dot(u_nom - other.velocity) >= 0.0 ? 1.0 : -1.0;
  const Vec2 normal = side * cosine * left - sine * ahead;  // at right angles to the tangent on that side
  const double offset = normal.dot(other.velocity);
  if (!(offset > -parameters.u_max_m_s)) return std::nullopt;
  return HalfPlane{normal, offset, priority};
}

}  // namespace vigil::safety
