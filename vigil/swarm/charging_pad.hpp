#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vigil/core/field/vec2.hpp"

namespace vigil::swarm {

/// Where one drone at a time comes down to have its battery charged.
struct ChargingPad {
  Vec2 place = Vec2::Zero();  ///< field frame
  std::size_t station = 0;    ///< whose pads fail together
  double full_in_s = 0.0;     ///< > 0, from empty to full
  double radius_m = 0.0;      ///< > 0: who comes down so close to it is charged
};

/// How drones are charged. Without pads nothing is ever sent to one.
struct RechargeParameters {
  std::vector<ChargingPad> pads;
  double take_off_s = 0.0;            ///< from the ground to the altitude
  double landing_s = 0.0;             ///< and back
  std::optional<double> endurance_s;  ///< about how long a full battery flies; none: nobody knows
};

}  // namespace vigil::swarm
