#include "vigil/runtime/recorded_targets.hpp"

#include <algorithm>

namespace vigil::runtime {
namespace {

Mission with_targets(Mission mission, const RecordedTargets& now) {
  const TargetsSection before = mission.targets;
  mission.targets.clusters = now.clusters;
  for (ClusterEntry& cluster : mission.targets.clusters) {
    const auto known = std::ranges::find(before.clusters, cluster.name, &ClusterEntry::name);
    if (known != before.clusters.end()) cluster.revisit_s = known->revisit_s;
  }
  mission.targets.areas = now.areas;
  for (AreaEntry& area : mission.targets.areas) {
    const auto known = std::ranges::find(before.areas, area.name, &AreaEntry::name);
    if (known == before.areas.end()) continue;
    area.revisit_s = known->revisit_s;
    area.soft_edge_m = known->soft_edge_m;
  }
  return mission;
}

}  // namespace

std::size_t targets_until(std::span<const RecordedTargets> all, double time_s) {
  const auto after = std::ranges::upper_bound(all, time_s, {}, &RecordedTargets::time_s);
  return static_cast<std::size_t>(after - all.begin());
}

Mission mission_at(const Mission& mission, std::span<const RecordedTargets> all, double time_s) {
  const std::size_t count = targets_until(all, time_s);
  return count == 0 ? mission : with_targets(mission, all[count - 1]);
}

}  // namespace vigil::runtime
