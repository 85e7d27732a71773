#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "vigil/runtime/mission_checks.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/command.hpp"

namespace vigil::runtime {
namespace {

static_assert(kMostNoFlyPoints <= swarm::kMaxNoFlyEdges, "an intent must take every mission's polygons");
/// Points a side with which an area is probed.
constexpr int kProbes = 24;

using FirstKeys = std::map<std::string, std::string, std::less<>>;

void require_new_name(const MissionSource& source, const std::string& name, const std::string& key, FirstKeys& taken) {
  const auto [found, is_new] = taken.emplace(name, key);
  if (is_new) return;
  source.refuse({.place = "",
                 .key = key + ".name",
                 .value = "",
                 .problem = fmt::format("is also the name of {}", found->second),
                 .valid = "must be unique",
                 .advice = "rename one of them"});
}

void require_simple(const MissionSource& source, const field::Polygon& polygon, const std::string& key) {
  if (field::is_simple(polygon)) return;
  source.refuse({.place = "",
                 .key = key + ".outline_m",
                 .value = "",
                 .problem = "crosses or touches itself, or encloses nothing",
                 .valid = "must be a polygon that does not cross itself",
                 .advice = "give its vertices in their order around it, each once, the first not again at the end"});
}

/// True where the straight line from a to b meets the field (Liang and Barsky's clipping).
bool meets(const field::Field& field, const field::Segment& edge) {
  double enter = 0.0;
  double leave = 1.0;
  const auto clip = [&](double start, double step, double length) {
    if (step == 0.0) return start >= 0.0 && start <= length;
    const double at_zero = -start / step;
    const double at_length = (length - start) / step;
    enter = std::max(enter, std::min(at_zero, at_length));
    leave = std::min(leave, std::max(at_zero, at_length));
    return enter <= leave;
  };
  const Vec2 step = edge.b - edge.a;
  return clip(edge.a.x(), step.x(), field.length_x) && clip(edge.a.y(), step.y(), field.length_y);
}

bool overlaps(const field::Field& field, const field::Polygon& polygon) {
  const Vec2 middle(0.5 * field.length_x, 0.5 * field.length_y);
  return field::contains(polygon, middle) ||
         std::ranges::any_of(field::edges(polygon), [&](const field::Segment& edge) { return meets(field, edge); });
}

/// Polygons where nothing is seen, and who they are.
struct NoFly {
  std::vector<field::Polygon> polygons;

  /// The number of a polygon that contains p.
  [[nodiscard]] std::optional<std::size_t> around(const Vec2& p) const {
    const auto found =
        std::ranges::find_if(polygons, [&](const field::Polygon& polygon) { return field::contains(polygon, p); });
    return found == polygons.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - polygons.begin()));
  }
};

/// True where some probe of the rectangle from low to high, or one of `more`, is wanted.
template <typename Wanted>
bool any_probe(const Vec2& low, const Vec2& high, const std::vector<Vec2>& more, Wanted wanted) {
  for (int ix = 0; ix < kProbes; ++ix) {
    for (int iy = 0; iy < kProbes; ++iy) {
      const Vec2 share((ix + 0.5) / kProbes, (iy + 0.5) / kProbes);
      if (wanted(Vec2(low + share.cwiseProduct(high - low)))) return true;
    }
  }
  return std::ranges::any_of(more, wanted);
}

/// The centroids of every three successive vertices: at least two of them are inside, however thin the polygon.
std::vector<Vec2> ears(const field::Polygon& polygon) {
  std::vector<Vec2> centroids;
  const std::vector<Vec2>& vertices = polygon.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2& second = vertices[(i + 1) % vertices.size()];
    const Vec2& third = vertices[(i + 2) % vertices.size()];
    centroids.emplace_back((vertices[i] + second + third) / 3.0);
  }
  return centroids;
}

bool can_be_seen(const field::Field& field, const field::Polygon& area, const NoFly& no_fly) {
  Vec2 low = area.vertices.front();
  Vec2 high = low;
  for (const Vec2& vertex : area.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const auto is_seen = [&](const Vec2& p) {
    return field.contains(p) && field::contains(area, p) && !no_fly.around(p);
  };
  return any_probe(field.clamp(low), field.clamp(high), ears(area), is_seen);
}

void check_no_fly(const Mission& mission, const MissionSource& source, const NoFly& no_fly) {
  const field::Field field = monitored_field(mission);
  FirstKeys names;
  std::size_t edges = 0;
  for (std::size_t i = 0; i < mission.no_fly.size(); ++i) {
    const std::string key = fmt::format("no_fly[{}]", i);
    require_new_name(source, mission.no_fly[i].name, key, names);
    require_simple(source, no_fly.polygons[i], key);
    if (!overlaps(field, no_fly.polygons[i])) {
      source.refuse({.place = "",
                     .key = key + ".outline_m",
                     .value = "",
                     .problem = "lies outside the field, where nobody flies",
                     .valid = "must overlap the field",
                     .advice = "remove it, or check its coordinates: they are in the world frame"});
    }
    edges += no_fly.polygons[i].vertices.size();
  }
  if (edges > kMostNoFlyPoints) {
    source.refuse({.place = "",
                   .key = "no_fly",
                   .value = "",
                   .problem = fmt::format("has {} vertices", edges),
                   .valid = fmt::format("must have at most {} in all", kMostNoFlyPoints),
                   .advice = "draw simpler outlines"});
  }
}

void check_room_to_fly(const Mission& mission, const MissionSource& source, const NoFly& no_fly) {
  const Vec2 corner = mission.field.size_m;
  const auto is_allowed = [&](const Vec2& p) { return !no_fly.around(p); };
  if (any_probe(Vec2::Zero(), corner, {}, is_allowed)) return;
  source.refuse({.place = "",
                 .key = "no_fly",
                 .value = "",
                 .problem = "covers the whole field",
                 .valid = "must leave room to fly",
                 .advice = "check the outlines: their coordinates are in the world frame"});
}

void check_target(const Mission& mission, const MissionSource& source, const NoFly& no_fly, const Vec2& point_W,
                  const std::string& key) {
  const field::Field field = monitored_field(mission);
  const Vec2 point = world_frame(mission).point_to_field(point_W);
  const bool is_outside = (field.clamp(point) - point).norm() > rounding_m(mission);
  if (is_outside && mission.targets.outside_field == OutsideField::kRefuse) {
    source.refuse({.place = "",
                   .key = key,
                   .value = "",
                   .problem = "is outside the field",
                   .valid = fmt::format("must be inside the field of {:.6g} m x {:.6g} m at field.origin_m",
                                        field.length_x, field.length_y),
                   .advice = "move the target, or take `outside_field: clamp` in targets"});
  }
  if (const std::optional<std::size_t> i = no_fly.around(field.clamp(point))) {
    source.refuse(
        {.place = "",
         .key = key,
         .value = "",
         .problem = fmt::format("is in the no-fly polygon {}, where nothing is looked at", mission.no_fly[*i].name),
         .valid = "must be outside every no-fly polygon",
         .advice = "move or remove the target"});
  }
}

/// Where an operator sends a drone.
void check_destination(const Mission& mission, const MissionSource& source, const NoFly& no_fly, const Vec2& point_W,
                       const std::string& key) {
  const field::Field field = monitored_field(mission);
  const Vec2 point = world_frame(mission).point_to_field(point_W);
  const bool is_free = field.contains(point) && !no_fly.around(point);
  if (is_free) return;
  source.refuse({.place = "",
                 .key = key,
                 .value = "",
                 .problem = "is where no drone may fly",
                 .valid = fmt::format("must be inside the field of {:.6g} m x {:.6g} m at field.origin_m, and outside "
                                      "every no-fly polygon",
                                      field.length_x, field.length_y),
                 .advice = "send the drone elsewhere"});
}

void check_area(const Mission& mission, const MissionSource& source, const NoFly& no_fly, std::size_t i) {
  const std::string key = fmt::format("targets.areas[{}]", i);
  const field::Polygon outline = polygon_in_field(mission, mission.targets.areas[i].outline_m);
  require_simple(source, outline, key);
  if (can_be_seen(monitored_field(mission), outline, no_fly)) return;
  source.refuse({.place = "",
                 .key = key + ".outline_m",
                 .value = "",
                 .problem = "has next to nothing that can be seen",
                 .valid = "must overlap the field where no no-fly polygon is",
                 .advice = "move or remove it; its coordinates are in the world frame"});
}

NoFly no_fly_of(const Mission& mission) {
  NoFly no_fly;
  for (const NoFlyEntry& entry : mission.no_fly) no_fly.polygons.push_back(polygon_in_field(mission, entry.outline_m));
  return no_fly;
}

}  // namespace

void check_places(const Mission& mission, const MissionSource& source) {
  const NoFly no_fly = no_fly_of(mission);
  check_no_fly(mission, source, no_fly);
  check_room_to_fly(mission, source, no_fly);
  FirstKeys names;
  for (std::size_t i = 0; i < mission.targets.clusters.size(); ++i) {
    const ClusterEntry& cluster = mission.targets.clusters[i];
    const std::string key = fmt::format("targets.clusters[{}]", i);
    require_new_name(source, cluster.name, key, names);
    for (std::size_t n = 0; n < cluster.points_m.size(); ++n) {
      check_target(mission, source, no_fly, cluster.points_m[n], fmt::format("{}.points_m[{}]", key, n));
    }
  }
  for (std::size_t i = 0; i < mission.targets.areas.size(); ++i) {
    require_new_name(source, mission.targets.areas[i].name, fmt::format("targets.areas[{}]", i), names);
    check_area(mission, source, no_fly, i);
  }
  for (std::size_t i = 0; i < mission.simulation.events.size(); ++i) {
    const EventEntry& event = mission.simulation.events[i];
    const std::string key = fmt::format("simulation.events[{}].point_m", i);
    if (event.what == EventKind::kGoTo) check_destination(mission, source, no_fly, event.point_m, key);
    if (event.what != EventKind::kAddTarget && event.what != EventKind::kMoveTarget) continue;
    check_target(mission, source, no_fly, event.point_m, key);
  }
}

}  // namespace vigil::runtime
