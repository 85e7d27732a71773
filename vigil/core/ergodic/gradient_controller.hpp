#pragma once

#include <span>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/ergodic/kernel.hpp"

namespace vigil::ergodic {

/// u = -u_max b / (|b| + delta): (9), with a fade that keeps it from chattering where |b| is small; delta = 0 is (9) to the
/// letter, and b = 0 gives u = 0 then. |u| <= u_max always.
[[nodiscard]] Vec2 faded_direction(const Vec2& b, double u_max, double delta) noexcept;

/// delta = fade x this: the root mean square over F of |grad V|, V = sum lambda_k phi_k f_k, the slope that an unvisited
/// target map has. 1/m^3... the same unit as b.
[[nodiscard]] double gradient_scale(const Basis& basis, const Coefficients& phi_k) noexcept;

}  // namespace vigil::ergodic
