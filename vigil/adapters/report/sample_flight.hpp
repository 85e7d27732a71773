#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

/// A flight made by hand for tests: drones that circle from target to target on the paper's field, the second of which
/// lands, and distances by ground truth that follow from where they are.
namespace vigil::report {

struct SampleOptions {
  std::size_t drones = 3;
  double duration_s = 60.0;
  double rate_hz = 10.0;
  double landing_s = 23.0;  ///< of the second drone; beyond duration_s: never
};

inline runtime::Mission sample_mission(const SampleOptions& options = {}) {
  runtime::Mission mission;
  mission.name = "sample";
  mission.field.size_m = {3.0, 3.0};
  mission.field.origin_m = {-1.5, -1.5};
  mission.targets.clusters = {{"north-west", {{-0.85, 0.70}, {-0.65, 0.90}, {-0.75, 0.55}}, 1.0, {}},
                              {"east", {{0.70, 0.25}, {0.90, 0.45}, {0.85, 0.10}}, 1.0, {}},
                              {"south", {{-0.15, -0.80}, {0.10, -0.95}, {-0.30, -0.70}}, 1.0, {}}};
  for (std::size_t i = 0; i < options.drones; ++i)
    mission.drones.push_back({"cf" + std::to_string(i + 1), Vec2::Zero()});
  mission.control.rate_hz = options.rate_hz;
  mission.control.speed_limit_m_s = 0.3;
  mission.safety.separation_m = 0.2;
  mission.safety.wall_distance_m = 0.17;
  mission.simulation.duration_s = options.duration_s;
  return mission;
}

/// World frame: around the targets' centres in turn, all drones in step, so that none meets another.
inline Vec2 sample_place(std::size_t drone, std::size_t drones, double time_s) {
  const Vec2 centres[] = {{-0.75, 0.72}, {0.82, 0.27}, {-0.12, -0.82}};
  constexpr double kStay = 8.0;
  constexpr double kMove = 4.0;
  const double turn = time_s / (kStay + kMove) + 3.0 * static_cast<double>(drone) / static_cast<double>(drones);
  const auto leg = static_cast<std::size_t>(turn);
  const double done = turn - static_cast<double>(leg);
  const double moved = std::clamp((done * (kStay + kMove) - kStay) / kMove, 0.0, 1.0);
  const Vec2 middle = (1.0 - moved) * centres[leg % 3] + moved * centres[(leg + 1) % 3];
  return middle + (0.1 + 0.2 * std::abs(std::sin(0.37 * time_s))) * Vec2(std::cos(time_s), std::sin(time_s));
}

inline double sample_nearest(const runtime::RecordedFlight& flight, std::size_t tick) {
  double least = swarm::DroneObservation::kNever;
  for (std::size_t i = 0; i < flight.drones.size(); ++i) {
    for (std::size_t j = i + 1; j < flight.drones.size(); ++j) {
      if (!flight.is_active(tick, i) || !flight.is_active(tick, j)) continue;
      const auto& places = flight.rows.true_position_m;
      least = std::min(least, (places[flight.row(tick, i)] - places[flight.row(tick, j)]).norm());
    }
  }
  return least;
}

inline void add_sample_row(runtime::RecordedFlight& flight, const SampleOptions& options, std::size_t drone,
                           double time_s) {
  const bool is_down = drone == 1 && time_s >= options.landing_s;
  const Vec2 place = sample_place(drone, options.drones, is_down ? options.landing_s : time_s);
  const Vec2 ahead = sample_place(drone, options.drones, time_s + 0.01);
  Vec2 command = is_down ? Vec2(0.0, 0.0) : Vec2((ahead - place) / 0.01);
  if (command.norm() > 0.3) command *= 0.3 / command.norm();
  runtime::DroneColumns& rows = flight.rows;
  rows.mode.push_back(is_down ? swarm::VehicleMode::kLanding : swarm::VehicleMode::kFlying);
  rows.activity.push_back(is_down ? swarm::Activity::kLanding : swarm::Activity::kActive);
  rows.position_m.push_back(place);
  rows.height_m.push_back(0.5);
  rows.velocity_m_s.push_back(command);
  rows.age_s.push_back(0.0);
  rows.nominal_m_s.push_back(command);
  rows.action.push_back(is_down ? swarm::Action::kLand : swarm::Action::kVelocity);
  rows.command_m_s.push_back(command);
  rows.held_by.emplace_back();
  rows.fallback.push_back(0);
  rows.true_position_m.push_back(place);
  rows.true_height_m.push_back(is_down ? 0.0 : 0.5);
}

inline runtime::RecordedFlight sample_flight(const SampleOptions& options = {}) {
  runtime::RecordedFlight flight;
  for (std::size_t i = 0; i < options.drones; ++i) flight.drones.push_back("cf" + std::to_string(i + 1));
  const auto ticks = static_cast<std::size_t>(options.duration_s * options.rate_hz);
  for (std::size_t tick = 0; tick <= ticks; ++tick) {
    const double time_s = static_cast<double>(tick) / options.rate_hz;
    flight.ticks.time_s.push_back(time_s);
    flight.ticks.metric.push_back(0.08 / (1.0 + 0.9 * time_s));
    flight.ticks.metric_percent.push_back(100.0 / (1.0 + 0.9 * time_s));
    const bool is_lost = options.drones > 1 && time_s >= options.landing_s;
    flight.ticks.active.push_back(options.drones - (is_lost ? 1 : 0));
    flight.ticks.idle.push_back(swarm::Idle::kNone);
    flight.ticks.fallback.push_back(0);
    for (std::size_t i = 0; i < options.drones; ++i) add_sample_row(flight, options, i, time_s);
    const double nearest = sample_nearest(flight, tick);
    flight.ticks.clearances.push_back({.airborne_pair_m = nearest, .active_pair_m = nearest, .wall_m = 0.25});
  }
  const runtime::Mission mission = sample_mission(options);
  flight.targets.push_back({0.0, mission.targets.clusters, mission.targets.areas});
  if (options.landing_s <= options.duration_s)
    flight.events.push_back({options.landing_s, "mission", "land", "cf2", ""});
  return flight;
}

}  // namespace vigil::report
