#pragma once

#include <nlohmann/json.hpp>

#include "vigil/runtime/mission.hpp"

namespace vigil::console {

/// A mission with the keys of a mission file, defaults too; a drone_grid is resolved to its drones. World frame.
[[nodiscard]] nlohmann::ordered_json mission_json(const runtime::Mission& mission);

/// The values that defaults resolve to and a display needs: `display` of protocol/README.md.
[[nodiscard]] nlohmann::ordered_json display_json(const runtime::Mission& mission, double most_speed);

}  // namespace vigil::console
