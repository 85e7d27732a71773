#pragma once

#include <memory>
#include <span>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// The mission's drones, simulated as its `simulation` section says.
[[nodiscard]] std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission);

/// Where a drone begins, whatever the mission says.
struct DroneStart {
  Vec2 place_m = Vec2::Zero();  ///< field frame
  bool is_down = false;
};

/// The same, begun elsewhere. Precondition: as many starts as drones.
[[nodiscard]] std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission,
                                                                     std::span<const DroneStart> starts);

}  // namespace vigil::apps
