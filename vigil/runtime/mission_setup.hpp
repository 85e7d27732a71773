#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/importance.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/safety/filter.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/charging_pad.hpp"

/// From a mission, as its file says it, to the values of core/: field frame, defaults resolved.
/// Precondition of all: a mission that load_mission or parse_mission returned.
namespace vigil::runtime {

[[nodiscard]] field::Field monitored_field(const Mission& mission);
[[nodiscard]] field::WorldFrame world_frame(const Mission& mission);

/// The time for which a velocity is held, seconds.
/// The model that the simulated vehicles have. Precondition: check_numbers has passed.
[[nodiscard]] dynamics::VehicleModel vehicle_model(const Mission& mission);
[[nodiscard]] double tick_s(const Mission& mission);

/// targets.sigma_min_m, by default 5 % of the field's shorter side.
[[nodiscard]] double sigma_min_m(const Mission& mission);
/// sensor.footprint_radius_m, by default 10 % of the field's shorter side.
[[nodiscard]] double footprint_radius_m(const Mission& mission);
/// How far `look_ahead` looks while every drone is active: control.look_ahead_s, by default its own choice.
[[nodiscard]] double look_ahead_s(const Mission& mission);
/// The time constant with which past coverage fades: control.memory_s, by default 20 times what a drone needs along the
/// field's longer side at control.speed_limit_m_s. None where control.memory is endless.
[[nodiscard]] std::optional<double> memory_s(const Mission& mission);
/// All that the filter is to keep. Lag, gains and margins are derived_margins() where the mission gives none; its
/// ranges stay unset where it leaves them to be derived.
[[nodiscard]] safety::BarrierParameters barrier_parameters(const Mission& mission);
/// What the controller makes up for: safety.command_delay_s and safety.observation_delay_s, by default
/// derived_command_delay_s() and derived_observation_delay_s().
[[nodiscard]] double command_delay_s(const Mission& mission);
[[nodiscard]] double observation_delay_s(const Mission& mission);
/// simulation.goals.radius_m, by default 0.6 times the barrier's radius. Precondition: the mission has goals.
[[nodiscard]] double goal_radius_m(const Mission& mission);

/// A target point (world frame) in the field frame, on the field's border where it lies outside.
[[nodiscard]] Vec2 target_in_field(const Mission& mission, const Vec2& point_W);
[[nodiscard]] field::Polygon polygon_in_field(const Mission& mission, std::span<const Vec2> outline_W);
[[nodiscard]] field::Cluster cluster_in_field(const Mission& mission, const ClusterEntry& cluster);
[[nodiscard]] field::Area area_in_field(const Mission& mission, const AreaEntry& area);

/// Everything that says where to look, field frame.
[[nodiscard]] field::Importance importance(const Mission& mission);
/// In the order of Mission::drones, field frame.
[[nodiscard]] std::vector<Vec2> starts_in_field(const Mission& mission);
/// The pads of all stations, station by station, field frame.
[[nodiscard]] std::vector<swarm::ChargingPad> charging_pads(const Mission& mission);
/// The edges of every no-fly polygon, in their order, field frame.
[[nodiscard]] std::vector<field::Segment> no_fly_edges(const Mission& mission);

}  // namespace vigil::runtime
