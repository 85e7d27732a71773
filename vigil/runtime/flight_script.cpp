#include "vigil/runtime/flight_script.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using swarm::CommandKind;
using swarm::DroneId;

/// The operator's command that an event stands for, where it stands for one.
std::optional<CommandKind> command_of(EventKind kind) {
  switch (kind) {
    case EventKind::kTakeOff:
      return CommandKind::kTakeOff;
    case EventKind::kLand:
      return CommandKind::kLand;
    case EventKind::kHold:
      return CommandKind::kHold;
    case EventKind::kGoTo:
      return CommandKind::kGoTo;
    case EventKind::kResume:
      return CommandKind::kResume;
    case EventKind::kMarkFailed:
      return CommandKind::kMarkFailed;
    case EventKind::kEmergencyStop:
      return CommandKind::kEmergencyStop;
    case EventKind::kOverride:
      return CommandKind::kOverride;
    case EventKind::kGiveBack:
      return CommandKind::kGiveBack;
    default:
      return std::nullopt;
  }
}

/// What an event lets befall a drone.
std::optional<MishapKind> mishap_of(EventKind kind) {
  switch (kind) {
    case EventKind::kFreezeTracking:
      return MishapKind::kFreezeTracking;
    case EventKind::kShiftTracking:
      return MishapKind::kShiftTracking;
    case EventKind::kSwapTracking:
      return MishapKind::kSwapTracking;
    case EventKind::kSkewVelocity:
      return MishapKind::kSkewVelocity;
    case EventKind::kIgnoreOrders:
      return MishapKind::kIgnoreOrders;
    case EventKind::kDrift:
      return MishapKind::kDrift;
    case EventKind::kLandByItself:
      return MishapKind::kLandByItself;
    case EventKind::kPilotUnasked:
      return MishapKind::kTakenByPilot;
    default:
      return std::nullopt;
  }
}

bool concerns_station(EventKind kind) { return kind == EventKind::kFailStation || kind == EventKind::kRepairStation; }

template <typename Entries>
auto find_named(Entries& entries, const std::string& name) {
  return std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
}

ClusterEntry& cluster_named(TargetsSection& targets, const std::string& name) {
  const auto found = find_named(targets.clusters, name);
  if (found != targets.clusters.end()) return *found;
  ClusterEntry fresh;
  fresh.name = name;
  return targets.clusters.emplace_back(std::move(fresh));
}

void set_weight(TargetsSection& targets, const EventEntry& event) {
  if (const auto cluster = find_named(targets.clusters, event.cluster); cluster != targets.clusters.end())
    cluster->weight = event.weight;
  else if (const auto area = find_named(targets.areas, event.cluster); area != targets.areas.end())
    area->weight = event.weight;
}

std::string describe_edit(const EventEntry& event) {
  switch (event.what) {
    case EventKind::kAddTarget:
      return fmt::format("{}: new target at ({}, {}) m", event.cluster, event.point_m.x(), event.point_m.y());
    case EventKind::kMoveTarget:
      return fmt::format("{}: target {} to ({}, {}) m", event.cluster, event.target, event.point_m.x(),
                         event.point_m.y());
    case EventKind::kRemoveTarget:
      return fmt::format("{}: target {} removed", event.cluster, event.target);
    default:
      return fmt::format("{}: weight {}", event.cluster, event.weight);
  }
}

}  // namespace

bool edits_targets(EventKind kind) {
  return kind == EventKind::kAddTarget || kind == EventKind::kMoveTarget || kind == EventKind::kRemoveTarget ||
         kind == EventKind::kSetWeight;
}

bool is_of_the_world(EventKind kind) {
  return kind == EventKind::kFail || kind == EventKind::kLoseTracking || kind == EventKind::kLoseLink ||
         concerns_station(kind) || mishap_of(kind).has_value();
}

void apply_edit(TargetsSection& targets, const EventEntry& event) {
  if (event.what == EventKind::kSetWeight) return set_weight(targets, event);
  ClusterEntry& cluster = cluster_named(targets, event.cluster);
  const std::ptrdiff_t index = event.target - 1;  // people count from 1
  switch (event.what) {
    case EventKind::kAddTarget:
      cluster.points_m.push_back(event.point_m);
      break;
    case EventKind::kMoveTarget:
      cluster.points_m.at(static_cast<std::size_t>(index)) = event.point_m;
      break;
    case EventKind::kRemoveTarget:
      cluster.points_m.erase(cluster.points_m.begin() + index);
      break;
    default:
      break;
  }
  if (cluster.points_m.empty()) targets.clusters.erase(find_named(targets.clusters, event.cluster));
}

FlightScript::FlightScript(const Mission& mission, VirtualFleet& fleet) : mission_(mission), fleet_(fleet) {}

DueEvents FlightScript::play(double time_s) {
  // Times of ticks are products of rounded numbers; an event at 23 s belongs to the tick at 22.999999999999996 s.
  constexpr double kRounding = 1e-9;
  DueEvents due;
  const std::vector<EventEntry>& events = mission_.simulation.events;
  for (; next_ < events.size() && events[next_].at_s <= time_s + kRounding; ++next_) {
    const EventEntry& event = events[next_];
    due.log.push_back(
        {time_s, is_of_the_world(event.what) ? "world" : "mission", std::string(name_of(event.what)), event.drone, {}});
    play_event(event, due);
  }
  return due;
}

void FlightScript::play_event(const EventEntry& event, DueEvents& due) {
  if (edits_targets(event.what)) {
    due.target_edits.push_back(event);
    due.log.back().detail = describe_edit(event);
  } else if (event.what == EventKind::kStartAfresh) {
    due.commands.push_back({.kind = CommandKind::kStartAfresh, .drone = {}, .target = {}});
  } else if (concerns_station(event.what)) {
    const auto station = find_named(mission_.stations, event.station);
    due.log.back().detail = event.station;
    if (station == mission_.stations.end()) return;
    fleet_.set_station(static_cast<std::size_t>(station - mission_.stations.begin()),
                       event.what == EventKind::kRepairStation);
  } else {
    play_for_drones(event, due);
  }
}

Mishap FlightScript::mishap_from(const EventEntry& event, MishapKind kind) const {
  const auto& drones = mission_.drones;
  const auto other = std::ranges::find(drones, event.other, &DroneEntry::id);
  const Vec2 value_W = kind == MishapKind::kShiftTracking ? event.shift_m : event.velocity_m_s;
  return {.kind = kind,
          .for_s = event.for_s,
          .value = world_frame(mission_).vector_to_field(value_W),
          .other = DroneId(static_cast<std::size_t>(other == drones.end() ? 0 : other - drones.begin()))};
}

void FlightScript::play_for_drones(const EventEntry& event, DueEvents& due) {
  const Vec2 velocity = world_frame(mission_).vector_to_field(event.velocity_m_s);
  const Vec2 place = world_frame(mission_).point_to_field(event.point_m);
  for (std::size_t index = 0; index < mission_.drones.size(); ++index) {
    if (event.drone != "all" && event.drone != mission_.drones[index].id) continue;
    const DroneId drone(index);
    if (const auto command = command_of(event.what))
      due.commands.push_back({.kind = *command, .drone = drone, .place = place, .target = {}});
    if (const auto mishap = mishap_of(event.what)) fleet_.befall(drone, mishap_from(event, *mishap));
    switch (event.what) {
      case EventKind::kFail:
        fleet_.fail(drone);
        break;
      case EventKind::kOverride:
        fleet_.take_over(drone, velocity);
        break;
      case EventKind::kGiveBack:
        fleet_.give_back(drone);
        break;
      case EventKind::kLoseTracking:
        fleet_.hide(drone, event.for_s);
        break;
      case EventKind::kLoseLink:
        fleet_.cut_link(drone, event.for_s);
        break;
      default:
        break;
    }
  }
}

void FlightScript::skip_to(double time_s) noexcept {
  const std::vector<EventEntry>& events = mission_.simulation.events;
  while (next_ < events.size() && events[next_].at_s < time_s) ++next_;
}

}  // namespace vigil::runtime
