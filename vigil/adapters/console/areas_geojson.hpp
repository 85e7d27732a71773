#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/target_edit.hpp"

/// Clusters, areas and no-fly polygons as GeoJSON. The coordinates are metres in the world frame, not degrees,
/// whatever datum a mission has. The collection says so in its member "vigil".
namespace vigil::console {

[[nodiscard]] nlohmann::ordered_json areas_geojson(const runtime::Mission& mission);

/// What a FeatureCollection adds or replaces: polygons become areas (no-fly polygons where `kind` says so), points
/// clusters; each polygon of a MultiPolygon an entry of its own, with a number where there are several. An entry of the
/// same kind and name is replaced; what has no name gets a free one. In words what is wrong with it otherwise: a name
/// that is there twice, or of the other kind, a hole in a polygon.
[[nodiscard]] std::variant<std::vector<runtime::TargetEdit>, std::string> edits_of_geojson(
    std::string_view text, const runtime::Mission& mission);

}  // namespace vigil::console
