#pragma once

#include <memory>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// The mission's drones, simulated as its `simulation` section says.
[[nodiscard]] std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission);

}  // namespace vigil::apps
