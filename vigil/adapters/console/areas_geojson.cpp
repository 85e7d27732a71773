#include "vigil/adapters/console/areas_geojson.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/json_reader.hpp"
#include "vigil/runtime/mission_desk.hpp"
#include "vigil/runtime/mission_error.hpp"

namespace vigil::console {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using runtime::TargetEntry;
using runtime::TargetKind;

ordered_json positions(const std::vector<Vec2>& points) {
  ordered_json list = ordered_json::array();
  for (const Vec2& point : points) list.push_back({point.x(), point.y()});
  return list;
}

/// A ring ends where it began.
ordered_json polygon(const std::vector<Vec2>& outline) {
  std::vector<Vec2> ring = outline;
  if (!ring.empty()) ring.push_back(ring.front());
  return {{"type", "Polygon"}, {"coordinates", ordered_json::array({positions(ring)})}};
}

ordered_json feature(ordered_json geometry, ordered_json properties) {
  return {{"type", "Feature"}, {"properties", std::move(properties)}, {"geometry", std::move(geometry)}};
}

template <typename Entry>
void put_revisit(ordered_json& properties, const Entry& entry) {
  if (entry.revisit_s) properties["revisit_s"] = *entry.revisit_s;
}

std::vector<Vec2> points_in(const json& list) {
  constexpr std::size_t kMostPoints = 10'000;
  if (!list.is_array() || list.size() > kMostPoints)
    throw JsonFault(fmt::format("coordinates: must be a list of at most {} positions", kMostPoints));
  std::vector<Vec2> points;
  for (const json& position : list) {
    const bool is_position = position.is_array() && position.size() >= 2 && position.size() <= 3 &&
                             position[0].is_number() && position[1].is_number();
    if (!is_position) throw JsonFault("coordinates: must be positions [x, y] in metres, world frame");
    points.emplace_back(position[0].get<double>(), position[1].get<double>());
  }
  return points;
}

std::vector<Vec2> outline_in(const json& rings) {
  if (!rings.is_array() || rings.size() != 1)
    throw JsonFault("coordinates: a polygon must have one ring; holes are no-fly polygons of their own");
  std::vector<Vec2> outline = points_in(rings[0]);
  if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  return outline;
}

TargetEntry entry_in(const JsonReader& properties, const std::string& name, const json& geometry) {
  constexpr std::size_t kMostWordBytes = 40;
  const JsonReader shape(geometry, "geometry");
  const std::string type = shape.text("type", kMostWordBytes);
  const json& coordinates = geometry.contains("coordinates") ? geometry.at("coordinates") : json::array();
  const auto number = [&](std::string_view member, double otherwise) {
    return properties.has(member) ? properties.number(member) : otherwise;
  };
  const std::optional<double> revisit_s =
      properties.has("revisit_s") ? std::optional(properties.number("revisit_s")) : std::nullopt;
  if (type == "Point")
    return runtime::ClusterEntry{name, points_in(json::array({coordinates})), number("weight", 1.0), revisit_s};
  if (type == "MultiPoint")
    return runtime::ClusterEntry{name, points_in(coordinates), number("weight", 1.0), revisit_s};
  if (type != "Polygon") shape.refuse("type", "must be Point, MultiPoint or Polygon");
  if (properties.has("kind") && properties.text("kind", kMostWordBytes) == "no_fly")
    return runtime::NoFlyEntry{name, outline_in(coordinates)};
  return runtime::AreaEntry{name, outline_in(coordinates), number("weight", 5.0), number("soft_edge_m", 0.0),
                            revisit_s};
}

bool is_there(const runtime::Mission& mission, TargetKind kind, const std::string& name) {
  const auto has = [&](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  };
  if (kind == TargetKind::kCluster) return has(mission.targets.clusters);
  return kind == TargetKind::kArea ? has(mission.targets.areas) : has(mission.no_fly);
}

runtime::TargetEdit edit_in(const JsonReader& feature, const json& object, const runtime::Mission& mission,
                            std::size_t number) {
  constexpr std::size_t kMostNameBytes = 400;
  const bool has_properties = feature.has("properties") && !feature.is_null("properties");
  const json none = json::object();
  const JsonReader properties = has_properties ? feature.object("properties") : JsonReader(none, "properties");
  std::string name =
      properties.has("name") ? properties.text("name", kMostNameBytes) : fmt::format("imported {}", number + 1);
  TargetEntry entry = entry_in(properties, name, object.contains("geometry") ? object.at("geometry") : none);
  const auto kind = static_cast<TargetKind>(entry.index());
  if (is_there(mission, kind, name)) return runtime::ReplaceEntry{{kind, std::move(name)}, std::move(entry)};
  return runtime::AddEntry{std::move(entry)};
}

}  // namespace

ordered_json areas_geojson(const runtime::Mission& mission) {
  ordered_json features = ordered_json::array();
  for (const runtime::ClusterEntry& entry : mission.targets.clusters) {
    ordered_json properties{{"kind", "cluster"}, {"name", entry.name}, {"weight", entry.weight}};
    put_revisit(properties, entry);
    features.push_back(feature({{"type", "MultiPoint"}, {"coordinates", positions(entry.points_m)}}, properties));
  }
  for (const runtime::AreaEntry& entry : mission.targets.areas) {
    ordered_json properties{
        {"kind", "area"}, {"name", entry.name}, {"weight", entry.weight}, {"soft_edge_m", entry.soft_edge_m}};
    put_revisit(properties, entry);
    features.push_back(feature(polygon(entry.outline_m), properties));
  }
  for (const runtime::NoFlyEntry& entry : mission.no_fly)
    features.push_back(feature(polygon(entry.outline_m), {{"kind", "no_fly"}, {"name", entry.name}}));
  return {{"type", "FeatureCollection"},
          {"vigil", {{"frame", "world"}, {"unit", "m"}, {"mission", mission.name}}},
          {"features", std::move(features)}};
}

std::variant<std::vector<runtime::TargetEdit>, std::string> edits_of_geojson(std::string_view text,
                                                                             const runtime::Mission& mission) {
  constexpr std::size_t kMostReasonBytes = 400;
  const json collection = json::parse(text, nullptr, false);
  if (collection.is_discarded()) return "it is not JSON in UTF-8";
  try {
    const JsonReader reader(collection, "");
    if (reader.text("type", 40) != "FeatureCollection") reader.refuse("type", "must be FeatureCollection");
    std::vector<runtime::TargetEdit> edits;
    for (const JsonReader& feature : reader.objects("features", runtime::MissionDesk::kMostEdits))
      edits.push_back(edit_in(feature, collection.at("features")[edits.size()], mission, edits.size()));
    if (edits.empty()) reader.refuse("features", "must have at least one feature");
    return edits;
  } catch (const JsonFault& fault) {
    return runtime::on_one_line(fault.what(), kMostReasonBytes);
  }
}

}  // namespace vigil::console
