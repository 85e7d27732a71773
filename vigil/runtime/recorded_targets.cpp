#include "vigil/runtime/recorded_targets.hpp"

#include <algorithm>
#include <utility>

namespace vigil::runtime {

std::size_t targets_until(std::span<const RecordedTargets> all, double time_s) {
  const auto after = std::ranges::upper_bound(all, time_s, {}, &RecordedTargets::time_s);
  return static_cast<std::size_t>(after - all.begin());
}

MissionTargets with(MissionTargets targets, const RecordedTargets& now) {
  targets.targets.clusters = now.clusters;
  targets.targets.areas = now.areas;
  targets.targets.uniform_floor = now.uniform_floor;
  targets.no_fly = now.no_fly;
  return targets;
}

Mission mission_at(Mission mission, std::span<const RecordedTargets> all, double time_s) {
  const std::size_t count = targets_until(all, time_s);
  if (count == 0) return mission;
  MissionTargets targets = with(targets_of(mission), all[count - 1]);
  mission.targets = std::move(targets.targets);
  mission.no_fly = std::move(targets.no_fly);
  return mission;
}

}  // namespace vigil::runtime
