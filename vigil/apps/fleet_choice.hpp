#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "vigil/core/parallel/workers.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// The mission's drones, simulated as its `simulation` section says; by the workers, where there are any, who outlive
/// the fleet.
[[nodiscard]] std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission,
                                                                     parallel::Workers* workers = nullptr);

/// The mission's drones as Crazyswarm flies them. Needs a ros_bridge::Session. `tell`: told what did not work.
[[nodiscard]] std::unique_ptr<runtime::Fleet> crazyswarm_fleet(const runtime::Mission& mission, bool positions_by_tf,
                                                               std::function<void(const std::string&)> tell);

/// Where a drone begins, whatever the mission says.
struct DroneStart {
  Vec2 place_m = Vec2::Zero();  ///< field frame
  bool is_down = false;
};

/// The same, begun elsewhere. Precondition: as many starts as drones.
[[nodiscard]] std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission,
                                                                     std::span<const DroneStart> starts,
                                                                     parallel::Workers* workers = nullptr);

}  // namespace vigil::apps
