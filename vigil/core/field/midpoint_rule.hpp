#pragma once

#include <Eigen/Core>

namespace vigil::field {

/// What a midpoint rule may assume of the integrand near the ends of the interval.
enum class EndRule {
  kSmooth,  ///< smooth up to the ends: high order, with some negative weights (between -12 and 16 spacings)
  kKinked   ///< it may jump or bend: low order, every weight between 0.88 and 1.1 spacings, so a jump near the end is
            ///< not blown up
};

/// Quadrature weights for the midpoints (j + 1/2) length / n of n equal parts of [0, length]; they sum to the length.
/// The plain midpoint rule but for a few corrected weights at either end, symmetric, which make it exact for
/// polynomials of degree below 16 (kSmooth, n >= 40) or 4 (kKinked, n >= 10), and of lower degree for fewer points.
/// Precondition: n >= 1, length > 0.
[[nodiscard]] Eigen::VectorXd midpoint_weights(Eigen::Index n, double length, EndRule rule);

}  // namespace vigil::field
