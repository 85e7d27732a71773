#include "vigil/runtime/mission_setup.hpp"

#include <algorithm>
#include <iterator>

#include "vigil/core/ergodic/look_ahead.hpp"
#include "vigil/runtime/mission_margins.hpp"

namespace vigil::runtime {
namespace {

/// What the mission gives of how the barriers are set; the paper's have no more than gains.
void set_given(const SafetySection& safety, safety::BarrierParameters& barrier) {
  const double gain = safety.barrier == safety::BarrierKind::kPaper ? 10.0 : 5.0;
  barrier.pair_gain = safety.pair_gain.value_or(gain);
  barrier.wall_gain = safety.wall_gain.value_or(gain);
  barrier.lag_s = safety.lag_s.value_or(0.0);
  barrier.margin_m = safety.margin_m.value_or(0.0);
  barrier.pair_margin_m = safety.pair_margin_m.value_or(2.0 * barrier.margin_m);
}

void set_derived(const Mission& mission, safety::BarrierParameters& barrier) {
  const Margins margins = derived_margins(mission);
  const SafetySection& safety = mission.safety;
  barrier.pair_gain = margins.pair_gain;
  barrier.wall_gain = margins.wall_gain;
  barrier.lag_s = margins.lag_s;
  barrier.margin_m = safety.margin_m.value_or(margins.wall.total());
  const double pair_margin_m = safety.margin_m ? 2.0 * *safety.margin_m : margins.pair.total();
  barrier.pair_margin_m = safety.pair_margin_m.value_or(pair_margin_m);
}

}  // namespace

field::Field monitored_field(const Mission& mission) {
  return {.length_x = mission.field.size_m.x(), .length_y = mission.field.size_m.y()};
}

field::WorldFrame world_frame(const Mission& mission) {
  return {.origin_W = mission.field.origin_m, .yaw_rad = mission.field.yaw_rad};
}

dynamics::VehicleModel vehicle_model(const Mission& mission) {
  switch (mission.simulation.vehicle.model) {
    case dynamics::VehicleKind::kFirstOrderLag:
      return dynamics::first_order_lag_vehicle(mission.simulation.vehicle.lag_s);
    case dynamics::VehicleKind::kCrazyflie:
      return dynamics::crazyflie_vehicle();
    case dynamics::VehicleKind::kArduCopter:
      return dynamics::arducopter_vehicle();
    case dynamics::VehicleKind::kPx4:
      return dynamics::px4_vehicle();
    case dynamics::VehicleKind::kIdeal:
      break;
  }
  return dynamics::ideal_vehicle();
}

double tick_s(const Mission& mission) { return 1.0 / mission.control.rate_hz; }

double sigma_min_m(const Mission& mission) {
  return mission.targets.sigma_min_m.value_or(0.05 * monitored_field(mission).shorter_side());
}

double footprint_radius_m(const Mission& mission) {
  return mission.sensor.footprint_radius_m.value_or(0.1 * monitored_field(mission).shorter_side());
}

double look_ahead_s(const Mission& mission) {
  return mission.control.look_ahead_s.value_or(
      ergodic::default_look_ahead_s(monitored_field(mission), mission.drones.size(), mission.control.speed_limit_m_s));
}

std::optional<double> memory_s(const Mission& mission) {
  constexpr double kCrossings = 20.0;
  if (mission.control.memory == Memory::kEndless) return std::nullopt;
  const double crossing_s = mission.field.size_m.maxCoeff() / mission.control.speed_limit_m_s;
  return mission.control.memory_s.value_or(kCrossings * crossing_s);
}

safety::BarrierParameters barrier_parameters(const Mission& mission) {
  const SafetySection& safety = mission.safety;
  safety::BarrierParameters barrier{.kind = safety.barrier,
                                    .separation_m = safety.separation_m,
                                    .contact_distance_m = safety.contact_distance_m.value_or(0.5 * safety.separation_m),
                                    .wall_distance_m = safety.wall_distance_m,
                                    .no_fly_buffer_m = safety.no_fly_buffer_m.value_or(safety.wall_distance_m),
                                    .u_max_m_s = mission.control.speed_limit_m_s,
                                    .dt_s = tick_s(mission),
                                    .sensing_range_m = safety.sensing_range_m,
                                    .wall_range_m = safety.wall_range_m};
  const bool is_given = safety.barrier == safety::BarrierKind::kPaper || (safety.lag_s && safety.margin_m);
  if (is_given)
    set_given(safety, barrier);
  else
    set_derived(mission, barrier);
  return barrier;
}

double command_delay_s(const Mission& mission) {
  return mission.safety.command_delay_s.value_or(derived_command_delay_s(mission));
}

double observation_delay_s(const Mission& mission) {
  return mission.safety.observation_delay_s.value_or(derived_observation_delay_s(mission));
}

double goal_radius_m(const Mission& mission) {
  return mission.simulation.goals->radius_m.value_or(0.6 * safety::barrier_radius(barrier_parameters(mission)));
}

Vec2 target_in_field(const Mission& mission, const Vec2& point_W) {
  return monitored_field(mission).clamp(world_frame(mission).point_to_field(point_W));
}

field::Polygon polygon_in_field(const Mission& mission, std::span<const Vec2> outline_W) {
  const field::WorldFrame frame = world_frame(mission);
  field::Polygon polygon;
  polygon.vertices.reserve(outline_W.size());
  for (const Vec2& vertex : outline_W) polygon.vertices.push_back(frame.point_to_field(vertex));
  return polygon;
}

field::Cluster cluster_in_field(const Mission& mission, const ClusterEntry& cluster) {
  std::vector<Vec2> targets;
  targets.reserve(cluster.points_m.size());
  for (const Vec2& point : cluster.points_m) targets.push_back(target_in_field(mission, point));
  return {.name = cluster.name,
          .targets = std::move(targets),
          .weight = cluster.weight,
          .is_protected = cluster.is_protected};
}

field::Area area_in_field(const Mission& mission, const AreaEntry& area) {
  return {.name = area.name,
          .outline = polygon_in_field(mission, area.outline_m),
          .weight = area.weight,
          .soft_edge_m = area.soft_edge_m,
          .is_protected = area.is_protected};
}

field::Importance importance(const Mission& mission) {
  field::Importance result;
  for (const ClusterEntry& entry : mission.targets.clusters)
    result.clusters.push_back(cluster_in_field(mission, entry));
  for (const AreaEntry& entry : mission.targets.areas) result.areas.push_back(area_in_field(mission, entry));
  for (const NoFlyEntry& entry : mission.no_fly) result.no_fly.push_back(polygon_in_field(mission, entry.outline_m));
  result.uniform_floor = mission.targets.uniform_floor;
  result.sigma_min_m = sigma_min_m(mission);
  return result;
}

std::vector<Vec2> starts_in_field(const Mission& mission) {
  const field::WorldFrame frame = world_frame(mission);
  std::vector<Vec2> starts;
  starts.reserve(mission.drones.size());
  for (const DroneEntry& drone : mission.drones) starts.push_back(frame.point_to_field(drone.start_m));
  return starts;
}

std::vector<swarm::ChargingPad> charging_pads(const Mission& mission) {
  const field::WorldFrame frame = world_frame(mission);
  std::vector<swarm::ChargingPad> pads;
  for (std::size_t station = 0; station < mission.stations.size(); ++station) {
    const StationEntry& entry = mission.stations[station];
    for (const Vec2& pad_W : entry.pads_m)
      pads.push_back({.place = frame.point_to_field(pad_W),
                      .station = station,
                      .full_in_s = entry.full_in_s,
                      .radius_m = entry.pad_radius_m});
  }
  return pads;
}

std::vector<field::Segment> no_fly_edges(const Mission& mission) {
  std::vector<field::Segment> result;
  for (const NoFlyEntry& entry : mission.no_fly) {
    std::ranges::copy(field::edges(polygon_in_field(mission, entry.outline_m)), std::back_inserter(result));
  }
  return result;
}

}  // namespace vigil::runtime
