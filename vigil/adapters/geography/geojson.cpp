#include "vigil/adapters/geography/geojson.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "vigil/adapters/geography/geographic_frame.hpp"
#include "vigil/adapters/geography/outlines.hpp"

namespace vigil::geography {
namespace {

using Json = nlohmann::ordered_json;

double with_decimals(double value, double scale) { return std::round(value * scale) / scale; }

Json position(const GeographicFrame& frame, const Vec2& p_W) {
  constexpr double kDegreeScale = 1e8;
  const GeographicPoint point = frame.at(p_W);
  return {with_decimals(point.longitude_deg, kDegreeScale), with_decimals(point.latitude_deg, kDegreeScale)};
}

Json positions(const GeographicFrame& frame, std::span<const Vec2> points_m) {
  Json list = Json::array();
  for (const Vec2& point : points_m) list.push_back(position(frame, point));
  return list;
}

Json feature(const char* type, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}};
}

Json polygon(const GeographicFrame& frame, std::span<const Vec2> outline_m, Json properties) {
  return feature("Polygon", Json::array({positions(frame, closed_ring(outline_m))}), std::move(properties));
}

/// What is asked of a cluster or an area.
template <class Entry>
Json wanted(const char* kind, const Entry& entry) {
  Json properties{{"kind", kind}, {"name", entry.name}, {"weight", entry.weight}};
  if (entry.revisit_s) properties["revisit_s"] = *entry.revisit_s;
  if (entry.is_protected) properties["protect"] = true;
  return properties;
}

Json track(const GeographicFrame& frame, const Track& track, std::int64_t began_ns) {
  constexpr double kMilli = 1e3;
  Json lines = Json::array();
  Json times = Json::array();
  Json heights = Json::array();
  for (const auto& piece : track.pieces) {
    Json& line = lines.emplace_back(Json::array());
    Json& at = times.emplace_back(Json::array());
    Json& height = heights.emplace_back(Json::array());
    for (const TrackPoint& point : piece) {
      line.push_back(position(frame, point.place_m));
      at.push_back(with_decimals(point.time_s, kMilli));
      height.push_back(with_decimals(point.height_m, kMilli));
    }
  }
  Json properties = {{"kind", "track"}, {"drone", track.drone}};
  if (began_ns != 0) properties["began"] = time_of_day(began_ns, 0.0);
  properties["times_s"] = std::move(times);
  properties["heights_m"] = std::move(heights);
  return feature("MultiLineString", std::move(lines), std::move(properties));
}

}  // namespace

std::string geojson(const MappedFlight& flight) {
  const runtime::Mission& mission = flight.mission;
  const GeographicFrame frame(*mission.field.datum);
  Json features = Json::array();
  features.push_back(polygon(frame, field_outline(mission), {{"kind", "field"}, {"name", mission.name}}));
  for (const runtime::ClusterEntry& cluster : flight.targets.targets.clusters)
    features.push_back(feature("MultiPoint", positions(frame, cluster.points_m), wanted("cluster", cluster)));
  for (const runtime::AreaEntry& area : flight.targets.targets.areas) {
    Json properties = wanted("area", area);
    properties["soft_edge_m"] = area.soft_edge_m;
    features.push_back(polygon(frame, area.outline_m, std::move(properties)));
  }
  for (const runtime::NoFlyEntry& no_fly : flight.targets.no_fly)
    features.push_back(polygon(frame, no_fly.outline_m, {{"kind", "no_fly"}, {"name", no_fly.name}}));
  for (const Track& one : flight.tracks)
    if (!one.pieces.empty()) features.push_back(track(frame, one, flight.began_ns));
  return Json{{"type", "FeatureCollection"}, {"features", std::move(features)}}.dump() + "\n";
}

}  // namespace vigil::geography
