#include "vigil/runtime/fault_tally.hpp"

#include <algorithm>
#include <limits>

#include "vigil/runtime/flight_script.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::Fault;

/// Whether a drone in it is lost to coverage though nobody wished it.
bool is_of_a_fault(Activity activity) {
  switch (activity) {
    case Activity::kTrackingLost:
    case Activity::kLinkLost:
    case Activity::kVehicleFailed:
    case Activity::kBatteryLow:
    case Activity::kNotFollowing:
    case Activity::kOutside:
      return true;
    default:
      return false;
  }
}

/// It does not end by itself.
bool is_for_good(EventKind kind) {
  return kind == EventKind::kFail || kind == EventKind::kLandByItself || kind == EventKind::kPilotUnasked;
}

bool is_of_a_station(EventKind kind) { return kind == EventKind::kFailStation || kind == EventKind::kRepairStation; }

std::optional<std::size_t> station_of(const Mission& mission, const EventEntry& event) {
  if (!is_of_a_station(event.what)) return std::nullopt;
  const auto found = std::ranges::find(mission.stations, event.station, &StationEntry::name);
  return static_cast<std::size_t>(found - mission.stations.begin());
}

/// What the swarm says where it finds out.
swarm::EventKind notice_of(std::string_view befell) {
  const bool has_failed = befell == name_of(EventKind::kFailStation);
  return has_failed ? swarm::EventKind::kStationFailed : swarm::EventKind::kStationWorks;
}

std::vector<std::size_t> drones_of(const Mission& mission, const EventEntry& event) {
  std::vector<std::size_t> drones;
  for (std::size_t i = 0; i < mission.drones.size(); ++i)
    if (mission.drones[i].id == event.drone || mission.drones[i].id == event.other) drones.push_back(i);
  return drones;
}

}  // namespace

std::string_view alarm_of(const swarm::Event& event) {
  if (event.kind == swarm::EventKind::kFaultNoticed) return name_of(event.fault);
  if (event.kind != swarm::EventKind::kActivityChanged) return {};
  const bool is_lost = is_of_a_fault(event.after);
  const bool is_by_itself = event.fault == Fault::kOwnMode && event.after != Activity::kGrounded;
  if (is_by_itself || (is_lost && event.fault != Fault::kNone)) return name_of(event.fault);
  return is_lost ? name_of(event.after) : std::string_view();
}

bool FaultTally::Happening::concerns(std::size_t drone) const {
  return !station && (drones.empty() || std::ranges::find(drones, drone) != drones.end());
}

FaultTally::FaultTally(const Mission& mission) : confuses_bodies_(mission.simulation.tracker.swaps_per_h > 0.0) {
  for (const EventEntry& event : mission.simulation.events) {
    if (!is_of_the_world(event.what)) continue;
    const bool is_endless = is_for_good(event.what) || is_of_a_station(event.what);
    const double end_s = is_endless ? std::numeric_limits<double>::infinity() : event.at_s + event.for_s;
    Detection detection{event.at_s, std::string(name_of(event.what)), event.drone, event.station, "", {}};
    happenings_.push_back({std::move(detection), drones_of(mission, event), station_of(mission, event), end_s});
  }
}

void FaultTally::begin_at(double from_s) {
  std::erase_if(happenings_, [&](const Happening& happening) { return happening.detection.at_s < from_s; });
}

void FaultTally::add(const swarm::Snapshot& snapshot) {
  while (begun_ < happenings_.size() && happenings_[begun_].detection.at_s <= snapshot.time_s) ++begun_;
  for (const swarm::Event& event : snapshot.events) {
    if (const std::string_view word = alarm_of(event); !word.empty()) take(event, word, snapshot.time_s);
    take_station(event, snapshot.time_s);
  }
}

/// The oldest that was not noticed yet and is of that kind.
void FaultTally::take_station(const swarm::Event& event, double now_s) {
  const bool has_failed = event.kind == swarm::EventKind::kStationFailed;
  if (!has_failed && event.kind != swarm::EventKind::kStationWorks) return;
  for (std::size_t i = 0; i < begun_; ++i) {
    Happening& happening = happenings_[i];
    Detection& detection = happening.detection;
    if (happening.station != event.station || notice_of(detection.befell) != event.kind || detection.noticed_s)
      continue;
    detection.noticed_s = now_s - detection.at_s;
    detection.noticed_as = has_failed ? "station_failed" : "station_works";
    return;
  }
}

void FaultTally::take(const swarm::Event& event, std::string_view word, double now_s) {
  count(word);
  bool is_explained = false;
  for (std::size_t i = 0; i < begun_; ++i) {
    Happening& happening = happenings_[i];
    if (now_s > happening.end_s + kAfterwardsS || !happening.concerns(event.drone.index())) continue;
    is_explained = true;
    if (happening.detection.noticed_s) continue;
    happening.detection.noticed_s = now_s - happening.detection.at_s;
    happening.detection.noticed_as = word;
  }
  const bool is_a_confusion = confuses_bodies_ && (event.fault == Fault::kSwapped || event.fault == Fault::kJumped);
  if (event.fault != Fault::kNone && !is_explained && !is_a_confusion) ++false_alarms_;
}

void FaultTally::count(std::string_view word) {
  const auto known = std::ranges::find(alarms_, word, &std::pair<std::string, std::uint64_t>::first);
  if (known == alarms_.end())
    alarms_.emplace_back(word, 1);
  else
    ++known->second;
}

std::vector<Detection> FaultTally::detections() const {
  std::vector<Detection> detections;
  for (std::size_t i = 0; i < begun_; ++i) detections.push_back(happenings_[i].detection);
  return detections;
}

}  // namespace vigil::runtime
