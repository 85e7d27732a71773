#include "vigil/adapters/console/edit_json.hpp"

#include <nlohmann/json.hpp>

#include "vigil/runtime/mission_desk.hpp"

namespace vigil::console {
namespace {

using runtime::AreaEntry;
using runtime::ClusterEntry;
using runtime::NoFlyEntry;
using runtime::TargetEdit;
using runtime::TargetEntry;
using runtime::TargetKind;
using runtime::TargetName;

constexpr std::size_t kMostNameBytes = 400;  // 64 characters; what is longer is refused with the rules of mission files
constexpr std::size_t kMostPoints = 10'000;

TargetKind kind_in(const JsonReader& reader) {
  const auto kind = runtime::target_kind_of(reader.text("kind", kMostNameBytes));
  if (!kind) reader.refuse("kind", "must be one of: cluster, area, no_fly");
  return *kind;
}

std::optional<double> revisit_in(const JsonReader& reader) {
  if (reader.is_null("revisit_s")) return std::nullopt;
  return reader.number("revisit_s");
}

ClusterEntry cluster_in(const JsonReader& reader) {
  reader.allow_only({"name", "points_m", "weight", "revisit_s", "protect"});
  ClusterEntry entry;
  entry.name = reader.text("name", kMostNameBytes);
  entry.points_m = reader.points("points_m", kMostPoints);
  if (reader.has("weight")) entry.weight = reader.number("weight");
  if (reader.has("revisit_s")) entry.revisit_s = revisit_in(reader);
  if (reader.has("protect")) entry.is_protected = reader.flag("protect");
  return entry;
}

AreaEntry area_in(const JsonReader& reader) {
  reader.allow_only({"name", "outline_m", "weight", "soft_edge_m", "revisit_s", "protect"});
  AreaEntry entry;
  entry.name = reader.text("name", kMostNameBytes);
  entry.outline_m = reader.points("outline_m", kMostPoints);
  if (reader.has("weight")) entry.weight = reader.number("weight");
  if (reader.has("soft_edge_m")) entry.soft_edge_m = reader.number("soft_edge_m");
  if (reader.has("revisit_s")) entry.revisit_s = revisit_in(reader);
  if (reader.has("protect")) entry.is_protected = reader.flag("protect");
  return entry;
}

NoFlyEntry no_fly_in(const JsonReader& reader) {
  reader.allow_only({"name", "outline_m"});
  return {reader.text("name", kMostNameBytes), reader.points("outline_m", kMostPoints)};
}

TargetEntry entry_in(const JsonReader& reader) {
  const JsonReader entry = reader.object("entry");
  switch (kind_in(reader)) {
    case TargetKind::kCluster:
      return cluster_in(entry);
    case TargetKind::kArea:
      return area_in(entry);
    case TargetKind::kNoFly:
      break;
  }
  return no_fly_in(entry);
}

std::size_t index_in(const JsonReader& reader) { return reader.whole("index"); }

TargetEdit add_point_in(const JsonReader& reader) {
  reader.allow_only({"op", "kind", "name", "point_m", "index"});
  const std::optional<std::size_t> index = reader.has("index") ? std::optional(index_in(reader)) : std::nullopt;
  return runtime::AddPoint{target_name_in(reader), reader.point("point_m"), index};
}

TargetEdit edit_in(const JsonReader& reader) {
  const std::string op = reader.text("op", kMostNameBytes);
  if (op == "add") {
    reader.allow_only({"op", "kind", "entry"});
    return runtime::AddEntry{entry_in(reader)};
  }
  if (op == "replace") {
    reader.allow_only({"op", "kind", "name", "entry"});
    return runtime::ReplaceEntry{target_name_in(reader), entry_in(reader)};
  }
  if (op == "remove") {
    reader.allow_only({"op", "kind", "name"});
    return runtime::RemoveEntry{target_name_in(reader)};
  }
  if (op == "rename") {
    reader.allow_only({"op", "kind", "name", "to"});
    return runtime::RenameEntry{target_name_in(reader), reader.text("to", kMostNameBytes)};
  }
  if (op == "add_point") return add_point_in(reader);
  if (op == "move_point") {
    reader.allow_only({"op", "kind", "name", "index", "point_m"});
    return runtime::MovePoint{target_name_in(reader), index_in(reader), reader.point("point_m")};
  }
  if (op == "remove_point") {
    reader.allow_only({"op", "kind", "name", "index"});
    return runtime::RemovePoint{target_name_in(reader), index_in(reader)};
  }
  if (op == "set_weight") {
    reader.allow_only({"op", "kind", "name", "weight"});
    return runtime::SetWeight{target_name_in(reader), reader.number("weight")};
  }
  if (op == "set_revisit") {
    reader.allow_only({"op", "kind", "name", "revisit_s"});
    return runtime::SetRevisit{target_name_in(reader), revisit_in(reader)};
  }
  if (op == "set_protect") {
    reader.allow_only({"op", "kind", "name", "protect"});
    return runtime::SetProtect{target_name_in(reader), reader.flag("protect")};
  }
  if (op == "set_soft_edge") {
    reader.allow_only({"op", "kind", "name", "soft_edge_m"});
    return runtime::SetSoftEdge{target_name_in(reader), reader.number("soft_edge_m")};
  }
  if (op == "set_uniform_floor") {
    reader.allow_only({"op", "uniform_floor"});
    return runtime::SetUniformFloor{reader.number("uniform_floor")};
  }
  reader.refuse("op",
                "must be one of: add, replace, remove, rename, add_point, move_point, remove_point, set_weight, "
                "set_revisit, set_protect, set_soft_edge, set_uniform_floor");
}

nlohmann::ordered_json points_json(const std::vector<Vec2>& points) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Vec2& point : points) list.push_back({point.x(), point.y()});
  return list;
}

nlohmann::ordered_json or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

TargetName target_name_in(const JsonReader& reader) { return {kind_in(reader), reader.text("name", kMostNameBytes)}; }

std::vector<TargetEdit> edits_in(const JsonReader& reader, std::string_view member) {
  std::vector<TargetEdit> edits;
  for (const JsonReader& edit : reader.objects(member, runtime::MissionDesk::kMostEdits))
    edits.push_back(edit_in(edit));
  if (edits.empty()) reader.refuse(member, "must have at least one edit");
  return edits;
}

nlohmann::ordered_json to_json(const ClusterEntry& entry) {
  return {{"name", entry.name},
          {"points_m", points_json(entry.points_m)},
          {"weight", entry.weight},
          {"revisit_s", or_null(entry.revisit_s)},
          {"protect", entry.is_protected}};
}

nlohmann::ordered_json to_json(const AreaEntry& entry) {
  return {{"name", entry.name},
          {"outline_m", points_json(entry.outline_m)},
          {"weight", entry.weight},
          {"soft_edge_m", entry.soft_edge_m},
          {"revisit_s", or_null(entry.revisit_s)},
          {"protect", entry.is_protected}};
}

nlohmann::ordered_json to_json(const NoFlyEntry& entry) {
  return {{"name", entry.name}, {"outline_m", points_json(entry.outline_m)}};
}

}  // namespace vigil::console
