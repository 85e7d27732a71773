#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "vigil/runtime/mission_checks.hpp"

namespace vigil::runtime {
namespace {

constexpr std::size_t kMostClusters = 1000;
constexpr std::size_t kMostTargets = 10'000;

/// Follows the names that events may use through the course of a mission.
class Course {
 public:
  Course(const Mission& mission, const MissionSource& source) : mission_(mission), source_(source) {
    for (const DroneEntry& drone : mission.drones) drones_.insert(drone.id);
    for (const ClusterEntry& cluster : mission.targets.clusters) targets_[cluster.name] = cluster.points_m.size();
    for (const AreaEntry& area : mission.targets.areas) areas_.insert(area.name);
  }

  void take(std::size_t number) {
    number_ = number;
    const EventEntry& event = mission_.simulation.events[number];
    check_time(event);
    switch (event.what) {
      case EventKind::kTakeOff:
      case EventKind::kLand:
      case EventKind::kHold:
      case EventKind::kResume:
      case EventKind::kMarkFailed:
      case EventKind::kEmergencyStop:
      case EventKind::kFail:
      case EventKind::kOverride:
      case EventKind::kGiveBack:
      case EventKind::kLoseTracking:
      case EventKind::kLoseLink:
      case EventKind::kFreezeTracking:
      case EventKind::kShiftTracking:
      case EventKind::kSkewVelocity:
      case EventKind::kIgnoreOrders:
      case EventKind::kDrift:
      case EventKind::kLandByItself:
      case EventKind::kPilotUnasked:
      case EventKind::kGoTo:
        return check_drone(event);
      case EventKind::kSwapTracking:
        return check_two_drones(event);
      case EventKind::kAddTarget:
        return add_target(event);
      case EventKind::kMoveTarget:
        return check_target(event);
      case EventKind::kRemoveTarget:
        return remove_target(event);
      case EventKind::kSetWeight:
        return check_name(event);
      case EventKind::kStartAfresh:
        return;
      case EventKind::kFailStation:
      case EventKind::kRepairStation:
        return check_station(event);
    }
  }

 private:
  [[noreturn]] void refuse(std::string_view key, std::string problem, std::string valid, std::string advice) const {
    source_.refuse({.place = "",
                    .key = fmt::format("simulation.events[{}].{}", number_, key),
                    .value = "",
                    .problem = std::move(problem),
                    .valid = std::move(valid),
                    .advice = std::move(advice)});
  }

  void check_time(const EventEntry& event) const {
    const double duration = mission_.simulation.duration_s;
    if (event.at_s > duration) {
      refuse("at_s", "is after the end", fmt::format("must be in [0, {}] s, simulation.duration_s", duration),
             "take an earlier time or a longer duration");
    }
    if (number_ == 0) return;
    const double before = mission_.simulation.events[number_ - 1].at_s;
    if (event.at_s < before) {
      refuse("at_s", fmt::format("is before the event above it, at {} s", before), "must be in the order of time",
             "sort the events by at_s");
    }
  }

  void check_drone(const EventEntry& event) const {
    if (event.drone == "all" || drones_.contains(event.drone)) return;
    refuse("drone", "is no drone of this mission",
           fmt::format("must be all or an id, such as {}", mission_.drones.front().id), "check the id");
  }

  void check_station(const EventEntry& event) const {
    const bool is_known = std::ranges::any_of(
        mission_.stations, [&](const StationEntry& station) { return station.name == event.station; });
    if (is_known) return;
    refuse("station", "is no station of this mission", "must be the name of one of its stations", "check the name");
  }

  void check_two_drones(const EventEntry& event) const {
    if (event.drone == "all")
      refuse("drone", "is every drone", "must be the id of one drone", "give the two drones that are exchanged");
    check_drone(event);
    if (event.other == event.drone || !drones_.contains(event.other))
      refuse("other", "is no other drone of this mission",
             fmt::format("must be the id of a drone that is not {}", event.drone),
             "give the two drones that are exchanged");
  }

  std::size_t& targets_of(const EventEntry& event) {
    const auto found = targets_.find(event.cluster);
    if (found != targets_.end()) return found->second;
    refuse("cluster", "is no cluster at that time", "must be the name of a cluster with targets",
           "check the name, or add a target first");
  }

  void add_target(const EventEntry& event) {
    if (areas_.contains(event.cluster)) {
      refuse("cluster", "is the name of an area", "must be the name of a cluster or a new one", "take another name");
    }
    std::size_t& targets = targets_[event.cluster];
    ++targets;
    if (targets <= kMostTargets && targets_.size() <= kMostClusters) return;
    refuse("cluster", "has no room for another target",
           fmt::format("must be at most {} targets a cluster and {} clusters", kMostTargets, kMostClusters),
           "remove targets first");
  }

  void check_target(const EventEntry& event) {
    const std::size_t targets = targets_of(event);
    if (static_cast<std::size_t>(event.target) <= targets) return;
    refuse("target", fmt::format("is no target of {} at that time", event.cluster),
           fmt::format("must be in [1, {}]", targets), "count the cluster's points from 1");
  }

  void remove_target(const EventEntry& event) {
    check_target(event);
    if (--targets_of(event) == 0) targets_.erase(event.cluster);
  }

  void check_name(const EventEntry& event) {
    if (!areas_.contains(event.cluster)) static_cast<void>(targets_of(event));
  }

  const Mission& mission_;
  const MissionSource& source_;
  std::size_t number_ = 0;
  std::set<std::string_view> drones_;
  std::set<std::string_view> areas_;
  std::map<std::string, std::size_t, std::less<>> targets_;
};

}  // namespace

void check_events(const Mission& mission, const MissionSource& source) {
  Course course(mission, source);
  for (std::size_t i = 0; i < mission.simulation.events.size(); ++i) course.take(i);
}

}  // namespace vigil::runtime
