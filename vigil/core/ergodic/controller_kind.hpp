#pragma once

#include <cstdint>

namespace vigil::ergodic {

/// What turns coverage into velocities.
enum class ControllerKind : std::uint8_t {
  kGradient,  ///< (9): down the gradient of the metric, here and now (gradient_controller.hpp)
  kLookAhead  ///< the first piece of paths that lower the metric over the next seconds (look_ahead.hpp)
};

}  // namespace vigil::ergodic
