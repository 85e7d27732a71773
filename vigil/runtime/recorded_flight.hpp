#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vigil/core/safety/filter.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorder.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// One value per kept tick in every column.
struct TickColumns {
  std::vector<double> time_s;          ///< strictly growing
  std::vector<double> metric;          ///< eps of (4); NaN before the first sample
  std::vector<double> metric_percent;  ///< of the first metric; NaN before the first sample
  std::vector<std::size_t> active;     ///< how many drones were active
  std::vector<swarm::Idle> idle;
  std::vector<std::uint8_t>
      fallback;  ///< 1: for some drone no velocity satisfied every row, since the kept tick before
  std::vector<Clearances> clearances;  ///< least since the kept tick before
};

/// One value per kept tick and drone in every column, drone by drone within a tick: RecordedFlight::row(). World frame.
/// NaN where nothing was known.
struct DroneColumns {
  std::vector<swarm::VehicleMode> mode;
  std::vector<swarm::Activity> activity;
  std::vector<Vec2> position_m;  ///< what the controller believed
  std::vector<double> height_m;
  std::vector<Vec2> velocity_m_s;
  std::vector<double> age_s;      ///< of the position; infinite: never seen
  std::vector<Vec2> nominal_m_s;  ///< what coverage wanted
  std::vector<swarm::Action> action;
  std::vector<Vec2> command_m_s;                           ///< what was asked of it
  std::vector<std::optional<safety::HoldingRow>> held_by;  ///< the nearest of what held it
  std::vector<std::uint8_t> fallback;
  std::vector<Vec2> true_position_m;  ///< NaN in a live flight
  std::vector<double> true_height_m;  ///< NaN in a live flight
};

/// What held from time_s on, until the next entry. World frame.
struct RecordedTargets {
  double time_s = 0.0;
  std::vector<ClusterEntry> clusters{};
  std::vector<AreaEntry> areas{};
  std::vector<NoFlyEntry> no_fly{};
  double uniform_floor = 0.0;
};

/// A flight as its recording tells it. World frame.
struct RecordedFlight {
  std::string mission_text;         ///< the effective mission file
  std::vector<std::string> drones;  ///< their ids, in the mission's order
  TickColumns ticks;
  DroneColumns rows;
  std::vector<RecordedTargets> targets;  ///< in the order of time
  std::vector<LoggedEvent> events;       ///< in the order of time
  /// Only every so manieth tick of the recording is here, and its last: see collect().
  std::size_t every = 1;
  bool is_complete = true;        ///< false: the recording was cut off; what is here was kept
  std::string incomplete_reason;  ///< for people; empty where is_complete

  [[nodiscard]] std::size_t tick_count() const { return ticks.time_s.size(); }
  [[nodiscard]] std::size_t row(std::size_t tick, std::size_t drone) const { return tick * drones.size() + drone; }
  [[nodiscard]] bool is_active(std::size_t tick, std::size_t drone) const {
    return rows.activity[row(tick, drone)] == swarm::Activity::kActive;
  }
};

}  // namespace vigil::runtime
