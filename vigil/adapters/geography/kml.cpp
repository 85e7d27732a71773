#include "vigil/adapters/geography/kml.hpp"

#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "vigil/adapters/geography/geographic_frame.hpp"
#include "vigil/adapters/geography/outlines.hpp"

namespace vigil::geography {
namespace {

/// KML writes colours as alpha, blue, green, red.
struct Look {
  const char* style;
  const char* line;
  const char* fill;
};
constexpr Look kFieldLook{"field", "ff808080", "00000000"};
constexpr Look kAreaLook{"area", "ff3c3cdc", "503c3cdc"};
constexpr Look kNoFlyLook{"no-fly", "ff00a5ff", "5000a5ff"};
constexpr Look kTrackLook{"track", "ff3cb43c", "00000000"};
constexpr const char* kGround = "clampToGround";
constexpr const char* kHeight = "relativeToGround";

void add_text(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text().set(text.c_str());
}

std::string position(const GeographicFrame& frame, const Vec2& p_W) {
  const GeographicPoint point = frame.at(p_W);
  return fmt::format("{:.8f},{:.8f}", point.longitude_deg, point.latitude_deg);
}

void add_look(pugi::xml_node document, const Look& look) {
  pugi::xml_node style = document.append_child("Style");
  style.append_attribute("id") = look.style;
  pugi::xml_node line = style.append_child("LineStyle");
  add_text(line, "color", look.line);
  add_text(line, "width", "2");
  add_text(style.append_child("PolyStyle"), "color", look.fill);
}

pugi::xml_node add_place(pugi::xml_node folder, const std::string& name, const char* style) {
  pugi::xml_node place = folder.append_child("Placemark");
  add_text(place, "name", name);
  if (style != nullptr) add_text(place, "styleUrl", fmt::format("#{}", style));
  return place;
}

void add_polygon(pugi::xml_node folder, const std::string& name, const Look& look, const GeographicFrame& frame,
                 std::span<const Vec2> outline_m) {
  pugi::xml_node polygon = add_place(folder, name, look.style).append_child("Polygon");
  add_text(polygon, "altitudeMode", kGround);
  std::string corners;
  for (const Vec2& corner : closed_ring(outline_m)) corners += position(frame, corner) + " ";
  add_text(polygon.append_child("outerBoundaryIs").append_child("LinearRing"), "coordinates", corners);
}

void add_cluster(pugi::xml_node folder, const GeographicFrame& frame, const runtime::ClusterEntry& cluster) {
  pugi::xml_node points = add_place(folder, cluster.name, nullptr).append_child("MultiGeometry");
  for (const Vec2& point : cluster.points_m)
    add_text(points.append_child("Point"), "coordinates", position(frame, point));
}

void add_piece(pugi::xml_node tracks, const GeographicFrame& frame, std::span<const TrackPoint> piece,
               std::int64_t began_ns) {
  pugi::xml_node track = tracks.append_child("gx:Track");
  add_text(track, "altitudeMode", kHeight);
  for (const TrackPoint& point : piece) add_text(track, "when", time_of_day(began_ns, point.time_s));
  for (const TrackPoint& point : piece) {
    const GeographicPoint at = frame.at(point.place_m);
    add_text(track, "gx:coord", fmt::format("{:.8f} {:.8f} {:.3f}", at.longitude_deg, at.latitude_deg, point.height_m));
  }
}

void add_track(pugi::xml_node folder, const GeographicFrame& frame, const Track& track, std::int64_t began_ns) {
  pugi::xml_node pieces = add_place(folder, track.drone, kTrackLook.style).append_child("gx:MultiTrack");
  add_text(pieces, "altitudeMode", kHeight);
  // Nobody knows where it was between two pieces.
  add_text(pieces, "gx:interpolate", "0");
  for (const auto& piece : track.pieces) add_piece(pieces, frame, piece, began_ns);
}

pugi::xml_node add_folder(pugi::xml_node document, const char* name) {
  pugi::xml_node folder = document.append_child("Folder");
  add_text(folder, "name", name);
  return folder;
}

void add_watched(pugi::xml_node folder, const GeographicFrame& frame, const MappedFlight& flight) {
  add_polygon(folder, "field", kFieldLook, frame, field_outline(flight.mission));
  for (const runtime::ClusterEntry& cluster : flight.targets.targets.clusters) add_cluster(folder, frame, cluster);
  for (const runtime::AreaEntry& area : flight.targets.targets.areas)
    add_polygon(folder, area.name, kAreaLook, frame, area.outline_m);
  for (const runtime::NoFlyEntry& no_fly : flight.targets.no_fly)
    add_polygon(folder, no_fly.name, kNoFlyLook, frame, no_fly.outline_m);
}

}  // namespace

std::string kml(const MappedFlight& flight) {
  pugi::xml_document file;
  pugi::xml_node declaration = file.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = file.append_child("kml");
  root.append_attribute("xmlns") = "http://www.opengis.net/kml/2.2";
  root.append_attribute("xmlns:gx") = "http://www.google.com/kml/ext/2.2";
  pugi::xml_node document = root.append_child("Document");
  add_text(document, "name", flight.mission.name);
  for (const Look& look : {kFieldLook, kAreaLook, kNoFlyLook, kTrackLook}) add_look(document, look);
  const GeographicFrame frame(*flight.mission.field.datum);
  add_watched(add_folder(document, "What is watched"), frame, flight);
  pugi::xml_node drones = add_folder(document, "Drones");
  for (const Track& track : flight.tracks)
    if (!track.pieces.empty()) add_track(drones, frame, track, flight.began_ns);
  std::ostringstream text;
  file.save(text, "  ");
  return text.str();
}

}  // namespace vigil::geography
