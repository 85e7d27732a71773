#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "vigil/core/safety/filter.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/drone_id.hpp"
#include "vigil/swarm/fault.hpp"
#include "vigil/swarm/protection.hpp"

namespace vigil::swarm {

/// What one drone is asked to do until the next tick.
struct DroneOrder {
  Action action = Action::kNone;
  Vec2 velocity = Vec2::Zero();  ///< field frame, m/s; finite, |velocity| <= u_max; 0 unless action is kVelocity
};

/// What the controller believed and decided of one drone. Field frame.
struct DroneSnapshot {
  Vec2 position = Vec2::Zero();  ///< last known
  Vec2 velocity = Vec2::Zero();
  double height_m = 0.0;
  double age_s = 0.0;  ///< of the position
  double link_age_s = 0.0;
  double battery = 0.0;               ///< share of full; NaN: not reported
  std::optional<TimeLeft> time_left;  ///< in the air, until the battery is down at its reserve; none: not reported
  VehicleMode mode = VehicleMode::kUnknown;
  Activity activity = Activity::kNeverSeen;
  FaultReport fault;  ///< what the monitor found, with its evidence
  bool is_obstacle = false;
  Vec2 u_nom = Vec2::Zero();    ///< what coverage wanted
  DroneOrder order;             ///< what was asked of it
  safety::FilterReport filter;  ///< what held it
  std::int32_t pad = -1;        ///< that is kept for it, as it was sent there or stands there; -1: none
  /// When it is to be sent to a pad, s from now; 0 for who is away. Infinity: nobody plans that.
  double leaves_in_s = std::numeric_limits<double>::infinity();
  /// ... and how long it will take from then on, or from now where it is away, until it covers again. Infinity: never,
  /// as far as is known.
  double away_for_s = std::numeric_limits<double>::infinity();
};

/// Why no drone covers anything.
enum class Idle : std::uint8_t { kNone, kNoTargets, kNoActiveDrone };

enum class EventKind : std::uint8_t {
  kActivityChanged,
  kWishAccepted,
  kWishRefused,
  kTargetChanged,
  kStartedAfresh,
  kFaultNoticed,
  kStationFailed,  ///< it charges nobody, as drones there notice
  kStationWorks    ///< ... and again
};

struct Event {
  EventKind kind = EventKind::kActivityChanged;
  DroneId drone{};                         ///< of the first three kinds, and kFaultNoticed
  Activity before = Activity::kNeverSeen;  ///< kActivityChanged
  Activity after = Activity::kNeverSeen;   ///< kActivityChanged
  CommandKind wish = CommandKind::kHold;   ///< kWishAccepted, kWishRefused
  std::uint32_t station = 0;               ///< kStationFailed, kStationWorks
  Fault fault = Fault::kNone;              ///< of both; kFaultNoticed: a new one, and its activity stays
};

/// All that one tick decided, for recorders and displays. Sized once; a tick allocates nothing in it.
struct Snapshot {
  std::uint64_t tick = 0;       ///< counted from 0
  double time_s = 0.0;          ///< tick x dt
  bool has_metric = false;      ///< false before the first sample
  double metric = 0.0;          ///< eps of (4)
  double metric_percent = 0.0;  ///< of the first metric since the mission or coverage was started afresh
  std::size_t active = 0;       ///< |I_a(t)| of (13)
  ProtectedShare protection;    ///< what protected parts get of all attention
  Idle idle = Idle::kNone;
  bool fallback = false;  ///< for some drone no velocity satisfied every row
  std::vector<DroneSnapshot> drones;
  std::vector<Event> events;  ///< of this tick; those beyond the capacity are counted in lost_events
  std::size_t lost_events = 0;

  explicit Snapshot(std::size_t drone_count) : drones(drone_count) { events.reserve(4 * drone_count + 64); }
  void note(const Event& event) noexcept {
    if (events.size() < events.capacity())
      events.push_back(event);
    else
      ++lost_events;
  }
};

}  // namespace vigil::swarm
