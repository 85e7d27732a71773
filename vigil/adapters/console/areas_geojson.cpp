#include "vigil/adapters/console/areas_geojson.hpp"

#include <optional>
#include <set>
#include <string>
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
void put_wishes(ordered_json& properties, const Entry& entry) {
  if (entry.revisit_s) properties["revisit_s"] = *entry.revisit_s;
  if (entry.is_protected) properties["protect"] = true;
}

std::vector<Vec2> points_in(const json& list, const std::string& place) {
  constexpr std::size_t kMostPoints = 10'000;
  if (!list.is_array() || list.size() > kMostPoints)
    throw JsonFault(fmt::format("{}: must be a list of at most {} positions", place, kMostPoints));
  std::vector<Vec2> points;
  for (const json& position : list) {
    const bool is_position = position.is_array() && position.size() >= 2 && position.size() <= 3 &&
                             position[0].is_number() && position[1].is_number();
    if (!is_position) throw JsonFault(place + ": must be positions [x, y] in metres, world frame");
    points.emplace_back(position[0].get<double>(), position[1].get<double>());
  }
  return points;
}

std::vector<Vec2> outline_in(const json& rings, const std::string& place) {
  if (!rings.is_array() || rings.empty()) throw JsonFault(place + ": must be a list of one ring");
  if (rings.size() > 1)
    throw JsonFault(
        fmt::format("{}: has {} rings; a polygon must have one: no hole can be cut into it; draw polygons "
                    "around the hole, or a no-fly polygon in its place",
                    place, rings.size()));
  std::vector<Vec2> outline = points_in(rings[0], place);
  if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  return outline;
}

/// The outlines of a Polygon or a MultiPolygon.
std::vector<std::vector<Vec2>> outlines_in(const std::string& type, const json& coordinates, const std::string& place) {
  if (type == "Polygon") return {outline_in(coordinates, place)};
  if (!coordinates.is_array() || coordinates.empty() || coordinates.size() > runtime::MissionDesk::kMostEdits)
    throw JsonFault(fmt::format("{}: must be a list of 1 to {} polygons", place, runtime::MissionDesk::kMostEdits));
  std::vector<std::vector<Vec2>> outlines;
  for (const json& rings : coordinates)
    outlines.push_back(outline_in(rings, fmt::format("{}[{}]", place, outlines.size())));
  return outlines;
}

/// A feature's entries: one, but of a MultiPolygon as many as it has polygons, their names numbered where there are
/// several. The name is empty where the feature has none.
std::vector<TargetEntry> entries_in(const JsonReader& properties, const JsonReader& shape, const json& geometry,
                                    const std::string& place) {
  constexpr std::size_t kMostWordBytes = 40;
  constexpr std::size_t kMostNameBytes = 400;
  const std::string type = shape.text("type", kMostWordBytes);
  const json& coordinates = geometry.contains("coordinates") ? geometry.at("coordinates") : json::array();
  const auto number = [&](std::string_view member, double otherwise) {
    return properties.has(member) ? properties.number(member) : otherwise;
  };
  const std::optional<double> revisit_s =
      properties.has("revisit_s") ? std::optional(properties.number("revisit_s")) : std::nullopt;
  const bool is_protected = properties.has("protect") && properties.flag("protect");
  const std::string name = properties.has("name") ? properties.text("name", kMostNameBytes) : std::string();
  const bool is_point = type == "Point";
  if (is_point || type == "MultiPoint")
    return {runtime::ClusterEntry{name, points_in(is_point ? json::array({coordinates}) : coordinates, place),
                                  number("weight", 1.0), revisit_s, is_protected}};
  if (type != "Polygon" && type != "MultiPolygon")
    shape.refuse("type", "must be Point, MultiPoint, Polygon or MultiPolygon");
  const bool is_no_fly = properties.has("kind") && properties.text("kind", kMostWordBytes) == "no_fly";
  std::vector<TargetEntry> entries;
  std::vector<std::vector<Vec2>> outlines = outlines_in(type, coordinates, place);
  for (std::vector<Vec2>& outline : outlines) {
    const bool is_numbered = !name.empty() && outlines.size() > 1;
    std::string own = is_numbered ? fmt::format("{}-{}", name, entries.size() + 1) : name;
    if (is_no_fly)
      entries.emplace_back(runtime::NoFlyEntry{std::move(own), std::move(outline)});
    else
      entries.emplace_back(runtime::AreaEntry{std::move(own), std::move(outline), number("weight", 5.0),
                                              number("soft_edge_m", 0.0), revisit_s, is_protected});
  }
  return entries;
}

/// The names that are there, and what becomes of an entry of a file beside them.
class Intake {
 public:
  explicit Intake(const runtime::Mission& mission) {
    for (const auto& entry : mission.targets.clusters) there_.insert({TargetKind::kCluster, entry.name});
    for (const auto& entry : mission.targets.areas) there_.insert({TargetKind::kArea, entry.name});
    for (const auto& entry : mission.no_fly) there_.insert({TargetKind::kNoFly, entry.name});
  }

  runtime::TargetEdit take(TargetEntry entry, const std::string& place) {
    const auto kind = static_cast<TargetKind>(entry.index());
    std::string& name = std::visit([](auto& one) -> std::string& { return one.name; }, entry);
    if (name.empty()) name = free_name(kind);
    if (!of_the_file_.insert({kind == TargetKind::kNoFly, name}).second)
      throw JsonFault(fmt::format("{}: the name {} is there twice; names must differ", place, name));
    if (there_.contains({kind, name})) return runtime::ReplaceEntry{{kind, name}, std::move(entry)};
    const TargetKind other = kind == TargetKind::kCluster ? TargetKind::kArea : TargetKind::kCluster;
    if (kind != TargetKind::kNoFly && there_.contains({other, name}))
      throw JsonFault(fmt::format("{}: {} is the name of {} already; give it another", place, name,
                                  other == TargetKind::kArea ? "an area" : "a cluster"));
    there_.insert({kind, name});
    return runtime::AddEntry{std::move(entry)};
  }

 private:
  /// Clusters and areas share their names.
  [[nodiscard]] bool is_taken(TargetKind kind, const std::string& name) const {
    if (kind == TargetKind::kNoFly) return there_.contains({kind, name});
    return there_.contains({TargetKind::kCluster, name}) || there_.contains({TargetKind::kArea, name});
  }
  [[nodiscard]] std::string free_name(TargetKind kind) const {
    std::string name = "imported";
    for (int number = 2; is_taken(kind, name); ++number) name = fmt::format("imported-{}", number);
    return name;
  }

  std::set<runtime::TargetName> there_;
  std::set<std::pair<bool, std::string>> of_the_file_;  ///< no-fly polygon or not, and its name
};

void take_feature(const JsonReader& feature, const json& object, const std::string& place, Intake& intake,
                  std::vector<runtime::TargetEdit>& edits) {
  const bool has_properties = feature.has("properties") && !feature.is_null("properties");
  const json none = json::object();
  const JsonReader properties = has_properties ? feature.object("properties") : JsonReader(none, "properties");
  const JsonReader shape = feature.object("geometry");
  for (TargetEntry& entry : entries_in(properties, shape, object.at("geometry"), place + ".geometry.coordinates"))
    edits.push_back(intake.take(std::move(entry), place));
}

/// Any other GeoJSON is in degrees (RFC 7946, 4), and a valley in degrees is a millimetre wide in metres.
void require_metres(const JsonReader& collection) {
  constexpr std::size_t kMostWordBytes = 40;
  const auto is_in_metres = [&](const JsonReader& own) {
    return own.text("frame", kMostWordBytes) == "world" && own.text("unit", kMostWordBytes) == "m";
  };
  if (collection.has("crs") || !collection.has("vigil") || !is_in_metres(collection.object("vigil")))
    collection.refuse("vigil",
                      R"(must be {"frame": "world", "unit": "m"}, and no crs: a file that does not say that it is in )"
                      "metres of the mission's world frame is in longitude and latitude, which are not read here; "
                      "convert it, then add that");
}

}  // namespace

ordered_json areas_geojson(const runtime::Mission& mission) {
  ordered_json features = ordered_json::array();
  for (const runtime::ClusterEntry& entry : mission.targets.clusters) {
    ordered_json properties{{"kind", "cluster"}, {"name", entry.name}, {"weight", entry.weight}};
    put_wishes(properties, entry);
    features.push_back(feature({{"type", "MultiPoint"}, {"coordinates", positions(entry.points_m)}}, properties));
  }
  for (const runtime::AreaEntry& entry : mission.targets.areas) {
    ordered_json properties{
        {"kind", "area"}, {"name", entry.name}, {"weight", entry.weight}, {"soft_edge_m", entry.soft_edge_m}};
    put_wishes(properties, entry);
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
  const ParsedJson parsed = parse_json(text);
  if (std::string problem = parsed.problem(); !problem.empty()) return problem;
  const json& collection = parsed.value;
  try {
    const JsonReader reader(collection, "");
    if (reader.text("type", 40) != "FeatureCollection") reader.refuse("type", "must be FeatureCollection");
    require_metres(reader);
    Intake intake(mission);
    std::vector<runtime::TargetEdit> edits;
    std::size_t number = 0;
    for (const JsonReader& feature : reader.objects("features", runtime::MissionDesk::kMostEdits)) {
      const json& object = collection.at("features")[number];
      take_feature(feature, object, fmt::format("features[{}]", number++), intake, edits);
    }
    if (edits.empty()) reader.refuse("features", "must have at least one feature");
    return edits;
  } catch (const JsonFault& fault) {
    return runtime::on_one_line(fault.what(), kMostReasonBytes);
  }
}

}  // namespace vigil::console
