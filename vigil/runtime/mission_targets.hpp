#pragma once

#include <vector>

#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// What a mission says of where to look and where not to fly: all that operators change in flight.
struct MissionTargets {
  TargetsSection targets;
  std::vector<NoFlyEntry> no_fly;
  friend bool operator==(const MissionTargets&, const MissionTargets&) = default;
};

[[nodiscard]] inline MissionTargets targets_of(const Mission& mission) { return {mission.targets, mission.no_fly}; }

}  // namespace vigil::runtime
