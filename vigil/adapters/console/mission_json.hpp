#pragma once

#include <nlohmann/json.hpp>

#include "vigil/runtime/mission.hpp"

namespace vigil::console {

/// A mission with the keys of a mission file, defaults too; a drone_grid is resolved to its drones. World frame.
[[nodiscard]] nlohmann::ordered_json mission_json(const runtime::Mission& mission);

/// The factors of real time that the clock may be set to; one alone where it cannot.
struct SpeedRange {
  double least = 1.0;
  double most = 1.0;
};

/// The values that defaults resolve to and a display needs: `display` of protocol/README.md.
[[nodiscard]] nlohmann::ordered_json display_json(const runtime::Mission& mission, const SpeedRange& speeds);

}  // namespace vigil::console
