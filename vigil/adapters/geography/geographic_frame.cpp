#include "vigil/adapters/geography/geographic_frame.hpp"

#include <cmath>

#include <GeographicLib/LocalCartesian.hpp>

namespace vigil::geography {

GeographicFrame::GeographicFrame(const runtime::DatumSection& datum) : datum_(datum) {}

GeographicPoint GeographicFrame::at(const Vec2& p_W) const {
  constexpr double kTurnDeg = 360.0;
  const GeographicLib::LocalCartesian plane(datum_.latitude_deg, datum_.longitude_deg);
  GeographicPoint point;
  double height_m = 0.0;
  plane.Reverse(p_W.x(), p_W.y(), 0.0, point.latitude_deg, point.longitude_deg, height_m);
  point.longitude_deg = datum_.longitude_deg + std::remainder(point.longitude_deg - datum_.longitude_deg, kTurnDeg);
  return point;
}

}  // namespace vigil::geography
