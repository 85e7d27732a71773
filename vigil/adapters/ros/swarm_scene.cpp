#include "vigil/adapters/ros/swarm_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/ros/mission_scene.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/runtime/event_words.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::ros_bridge {
namespace {

using swarm::DroneSnapshot;

constexpr Colour kDown{0.6F, 0.6F, 0.6F, 1.0F};
constexpr Colour kName{1.0F, 1.0F, 1.0F, 1.0F};
constexpr Colour kHolding{1.0F, 0.75F, 0.1F, 1.0F};
constexpr double kTrailZ = 0.01;

bool is_known(const DroneSnapshot& drone) { return std::isfinite(drone.age_s) && drone.position.allFinite(); }

Mark body(const runtime::Mission& mission, const DroneSnapshot& drone, const Colour& colour) {
  const double width = mission.safety.contact_distance_m.value_or(0.5 * mission.safety.separation_m);
  Mark mark;
  mark.set = "drones";
  mark.kind = Mark::Kind::kCylinder;
  mark.colour = runtime::is_airborne(drone) ? colour : kDown;
  mark.place = in_world(mission, drone.position, std::max(drone.height_m, 0.02));
  mark.size = {width, width, 0.3 * width};
  return mark;
}

Mark name(const runtime::Mission& mission, std::size_t index, const DroneSnapshot& drone) {
  const double separation = mission.safety.separation_m;
  Mark mark;
  mark.set = "names";
  mark.kind = Mark::Kind::kText;
  mark.colour = kName;
  mark.place = in_world(mission, drone.position, drone.height_m);
  mark.place.y += 0.75 * separation;
  mark.size.z = 0.5 * separation;
  mark.text = mission.drones[index].id;
  return mark;
}

/// Of a drone that is not in the air it is taken away: a line without points.
Mark safety_circle(const runtime::Mission& mission, const DroneSnapshot& drone, const Colour& colour) {
  Mark mark;
  mark.set = "safety";
  mark.colour = colour;
  mark.size.x = 0.04 * mission.safety.separation_m;
  if (!runtime::is_airborne(drone)) return mark;
  constexpr int kCorners = 32;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Vec2 way = 0.5 * mission.safety.separation_m * Vec2(std::cos(angle), std::sin(angle));
    mark.points.push_back(in_world(mission, drone.position + way, drone.height_m));
  }
  return mark;
}

Vec2 foot_on_wall(const field::Field& field, const Vec2& place, int wall) {
  switch (wall) {
    case 0:
      return {0.0, place.y()};
    case 1:
      return {field.length_x, place.y()};
    case 2:
      return {place.x(), 0.0};
    default:
      return {place.x(), field.length_y};
  }
}

/// Where the thing is that a row keeps a drone away from.
Vec2 place_of(const safety::HoldingRow& row, const DroneSnapshot& drone, const swarm::Snapshot& snapshot,
              const field::Field& field, std::span<const field::Segment> edges) {
  const auto index = static_cast<std::size_t>(row.index);
  if (row.kind == safety::RowKind::kNeighbour && index < snapshot.drones.size()) return snapshot.drones[index].position;
  if (row.kind == safety::RowKind::kWall) return foot_on_wall(field, drone.position, row.index);
  if (row.kind == safety::RowKind::kNoFly && index < edges.size()) return nearest_point(edges[index], drone.position);
  return drone.position;
}

Mark holding_lines(const runtime::Mission& mission, const swarm::Snapshot& snapshot) {
  const field::Field field = runtime::monitored_field(mission);
  const std::vector<field::Segment> edges = runtime::no_fly_edges(mission);
  Mark mark;
  mark.set = "constraints";
  mark.kind = Mark::Kind::kLines;
  mark.colour = kHolding;
  mark.size.x = 0.05 * mission.safety.separation_m;
  for (const DroneSnapshot& drone : snapshot.drones) {
    for (int n = 0; n < drone.filter.holding_count; ++n) {
      const Vec2 to = place_of(drone.filter.holding[static_cast<std::size_t>(n)], drone, snapshot, field, edges);
      mark.points.push_back(in_world(mission, drone.position, drone.height_m));
      mark.points.push_back(in_world(mission, to, drone.height_m));
    }
  }
  return mark;
}

Diagnosis::Level level_of(runtime::Severity severity, const DroneSnapshot& drone) {
  if (!is_known(drone)) return Diagnosis::Level::kStale;
  switch (severity) {
    case runtime::Severity::kInfo:
      return Diagnosis::Level::kOk;
    case runtime::Severity::kWarning:
      return Diagnosis::Level::kWarning;
    case runtime::Severity::kAlarm:
      break;
  }
  return Diagnosis::Level::kError;
}

std::string seconds(double value) { return std::isfinite(value) ? fmt::format("{:.3f}", value) : "never"; }

Diagnosis diagnosis_of(const runtime::Mission& mission, const swarm::Snapshot& snapshot, std::size_t index) {
  const DroneSnapshot& drone = snapshot.drones[index];
  const std::string& id = mission.drones[index].id;
  const runtime::EventWords words =
      runtime::words_for(id, drone.activity, drone, snapshot.active, snapshot.drones.size());
  const Point place = in_world(mission, drone.position, drone.height_m);
  return {.name = id,
          .level = level_of(words.severity, drone),
          .summary = words.next.empty() ? words.text : fmt::format("{}: {}", words.text, words.next),
          .values = {{"activity", std::string(swarm::name_of(drone.activity))},
                     {"mode", std::string(swarm::name_of(drone.mode))},
                     {"place [m]", fmt::format("{:.3f} {:.3f} {:.3f}", place.x, place.y, place.z)},
                     {"age of its position [s]", seconds(drone.age_s)},
                     {"age of its link [s]", seconds(drone.link_age_s)},
                     {"battery", std::isfinite(drone.battery) ? fmt::format("{:.2f}", drone.battery) : "not reported"},
                     {"held back [m/s]", fmt::format("{:.3f}", drone.filter.correction_m_s)}}};
}

}  // namespace

std::vector<Mark> drone_marks(const runtime::Mission& mission, const swarm::Snapshot& snapshot) {
  std::vector<Mark> marks;
  const auto add = [&marks](Mark mark, std::size_t id) {
    mark.id = static_cast<int>(id);
    marks.push_back(std::move(mark));
  };
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
    const DroneSnapshot& drone = snapshot.drones[i];
    if (!is_known(drone)) continue;
    const Colour green = green_of(i, snapshot.drones.size());
    add(body(mission, drone, green), i);
    add(name(mission, i, drone), i);
    add(safety_circle(mission, drone, green), i);
  }
  add(holding_lines(mission, snapshot), 0);
  return marks;
}

std::vector<Figure> figures_of(const runtime::Mission& mission, const swarm::Snapshot& snapshot) {
  std::vector<Figure> figures{{"active_drones", static_cast<double>(snapshot.active)}};
  if (snapshot.has_metric) figures.push_back({"metric_percent", snapshot.metric_percent});
  const double smallest = runtime::least_airborne_pair_m(snapshot);
  if (std::isfinite(smallest)) figures.push_back({"smallest_distance_m", smallest});
  double oldest_position_s = 0.0;
  double oldest_link_s = 0.0;
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
    const DroneSnapshot& drone = snapshot.drones[i];
    if (!is_known(drone)) continue;
    figures.push_back({ros_name(mission.drones[i].id) + "/age_s", drone.age_s});
    oldest_position_s = std::max(oldest_position_s, drone.age_s);
    if (std::isfinite(drone.link_age_s)) oldest_link_s = std::max(oldest_link_s, drone.link_age_s);
  }
  figures.push_back({"oldest_position_s", oldest_position_s});
  figures.push_back({"oldest_link_s", oldest_link_s});
  return figures;
}

std::vector<Diagnosis> diagnoses_of(const runtime::Mission& mission, const swarm::Snapshot& snapshot) {
  std::vector<Diagnosis> diagnoses;
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i) diagnoses.push_back(diagnosis_of(mission, snapshot, i));
  return diagnoses;
}

Trails::Trails(const runtime::Mission& mission)
    : mission_(mission),
      spacing_m_(runtime::monitored_field(mission).shorter_side() / 200.0),
      places_(mission.drones.size()) {}

void Trails::add(const swarm::Snapshot& snapshot) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const DroneSnapshot& drone = snapshot.drones[i];
    if (!is_known(drone) || !runtime::is_airborne(drone)) continue;
    const Point place = in_world(mission_, drone.position, kTrailZ);
    std::vector<Point>& trail = places_[i];
    if (!trail.empty() && std::hypot(place.x - trail.back().x, place.y - trail.back().y) < spacing_m_) continue;
    if (trail.size() == kMostPoints) trail.erase(trail.begin(), trail.begin() + kMostPoints / 4);
    trail.push_back(place);
  }
}

std::vector<Mark> Trails::marks() const {
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Mark mark;
    mark.set = "trails";
    mark.id = static_cast<int>(i);
    mark.colour = green_of(i, places_.size());
    mark.size.x = 1.2 * spacing_m_;
    mark.points = places_[i];
    marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace vigil::ros_bridge
