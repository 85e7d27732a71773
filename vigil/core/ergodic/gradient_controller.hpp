#pragma once

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::ergodic {

/// u = -u_max b / (|b| + delta): (9), with a fade that keeps it from chattering where |b| is small; delta = 0 is (9) to
/// the letter, and b = 0 gives u = 0 then. |u| <= u_max but for rounding. Precondition: b finite, u_max >= 0, delta >=
/// 0.
[[nodiscard]] Vec2 faded_direction(const Vec2& b, double u_max, double delta) noexcept;

/// delta = fade x this: the root mean square over F of |grad V|, V = sum lambda_k phi_k f_k, the slope that an
/// unvisited target map has. In 1/m^3, the unit of b (lambda_k has none, phi_k has 1/m, grad f_k has 1/m^2).
[[nodiscard]] double gradient_scale(const Basis& basis, const Coefficients& phi_k) noexcept;

}  // namespace vigil::ergodic
