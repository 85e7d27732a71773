#pragma once

#include <algorithm>

#include "vigil/runtime/recorder.hpp"

namespace vigil::runtime {

/// What is kept of two ticks' clearances where one tick stands for both.
[[nodiscard]] inline Clearances least(const Clearances& a, const Clearances& b) {
  return {std::min(a.airborne_pair_m, b.airborne_pair_m), std::min(a.active_pair_m, b.active_pair_m),
          std::min(a.wall_m, b.wall_m), std::min(a.no_fly_m, b.no_fly_m)};
}

}  // namespace vigil::runtime
