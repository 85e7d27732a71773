#include "vigil/core/ergodic/gradient_controller.hpp"

#include <cmath>
#include <limits>

namespace vigil::ergodic {

Vec2 faded_direction(const Vec2& b, double u_max, double delta) noexcept {
  const double size = std::hypot(b.x(), b.y());
  if (size < std::numeric_limits<double>::min()) return Vec2::Zero();  // zero, or too few digits left for a direction
  return -u_max * (b / (size + delta));                                // (9)
}

// The gradients of different f_k are orthogonal on F, and the integral of |grad f_k|^2 is (k1 pi/L1)^2 + (k2 pi/L2)^2.
// So the mean of |grad V|^2 is the sum of (lambda_k phi_k)^2 times that, over the area of F.
double gradient_scale(const Basis& basis, const Coefficients& phi_k) noexcept {
  double integral = 0.0;
  for (int k2 = 0; k2 <= basis.max_index(); ++k2) {
    for (int k1 = 0; k1 <= basis.max_index(); ++k1) {
      const double slope_squared = std::pow(basis.wave_numbers_x()[k1], 2) + std::pow(basis.wave_numbers_y()[k2], 2);
      integral += std::pow(basis.weight()(k1, k2) * phi_k(k1, k2), 2) * slope_squared;
    }
  }
  return std::sqrt(integral / basis.field().area());
}

}  // namespace vigil::ergodic
