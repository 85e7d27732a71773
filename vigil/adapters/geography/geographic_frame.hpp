#pragma once

#include "vigil/core/field/vec2.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::geography {

/// WGS 84, degrees. The longitude goes on beyond +-180 where a field lies across that meridian, so that an outline
/// never jumps round the earth.
struct GeographicPoint {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;
};

/// Where the world frame of a mission lies on the earth: the datum is its origin, x points to the east and y to the
/// north there, and the plane touches the ellipsoid at the datum. A distance within 10 km of it is off by less than
/// 3 ppm, within 100 km by less than 300 ppm.
class GeographicFrame {
 public:
  explicit GeographicFrame(const runtime::DatumSection& datum);

  /// Precondition: `p_W` is finite and within 1000 km of the datum.
  [[nodiscard]] GeographicPoint at(const Vec2& p_W) const;

 private:
  runtime::DatumSection datum_;
};

}  // namespace vigil::geography
