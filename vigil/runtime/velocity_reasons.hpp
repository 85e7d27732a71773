#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/tick.hpp"

/// Why a drone's velocity was what it was in the newest tick: what coverage wanted, every row of (10) that the safety
/// filter was given, and what came of it. World frame; rows normalised, so that offset and slack are speeds.
/// Precondition: state.ticks() > 0; drone.index() < the mission's drones; the state is of this mission's flight.
namespace vigil::runtime {

/// {tick, time_s, drone, activity, u_max_m_s, u_nom_m_s, u_m_s, changed_m_s, speed_limited, margin_used, fallback,
/// crowded, rows: [{kind, drone | wall | edge, distance_m, normal, offset_m_s, slack_m_s, priority, holds}]}: a row
/// asks for normal . u >= offset_m_s, `slack_m_s` is by how much it is kept (negative: it is not), `holds` marks those
/// that keep u where it is. The most pressing rows come first. `u_m_s` is the filter's: what was ordered is zero where
/// the drone was not flown by velocities.
[[nodiscard]] nlohmann::ordered_json velocity_reasons_json(const swarm::SwarmState& state, swarm::DroneId drone,
                                                           const Mission& mission);

/// The same as a text for people.
[[nodiscard]] std::string velocity_reasons(const swarm::SwarmState& state, swarm::DroneId drone,
                                           const Mission& mission);

}  // namespace vigil::runtime
