#pragma once

#include <optional>

#include "vigil/core/field/vec2.hpp"

namespace vigil::dynamics {

/// How a vehicle's velocity follows its command: v' = (u - v) / lag, |v'| <= acceleration limit. With lag 0 and no
/// limit it is the paper's single integrator (3), p' = u.
struct PlanarVehicle {
  double lag_s = 0.0;                             ///< tau >= 0
  std::optional<double> acceleration_limit_m_s2;  ///< > 0; needs lag_s > 0
};

/// Where a vehicle is and how it moves. Metres, metres per second.
struct PlanarState {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
};

/// The state after dt_s under the constant command u, exactly (no numerical integration): the error u - v keeps its
/// direction, shrinks at the acceleration limit while it is longer than limit x lag, exponentially after that.
/// Precondition: finite input, dt_s >= 0.
[[nodiscard]] PlanarState advance(const PlanarVehicle& vehicle, const PlanarState& state, const Vec2& u,
                                  double dt_s) noexcept;

}  // namespace vigil::dynamics
