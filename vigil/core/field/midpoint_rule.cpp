#include "vigil/core/field/midpoint_rule.hpp"

#include <algorithm>
#include <cassert>

#include <Eigen/QR>

namespace vigil::field {
namespace {

// With spacing 1, the Euler-Maclaurin expansion of the midpoint rule at its left end is
//
//   integral of p - sum of p(j + 1/2) = sum over odd r of e_r p^(r)(0) + (the like at the right end),   e_r =
//   B_{r+1}(1/2) / (r+1)!
//
// which ends after finitely many terms for a polynomial. Corrections d_j of the first `corrected` weights make the rule
// exact for degrees below `order` if sum of d_j p(j + 1/2) equals the left end's part for all such p. With as many
// corrected weights as orders the solution is unique and wild (weights of +-270 for order 16); with a quarter more,
// the smallest solution is tame.
//
// As p we take Legendre polynomials of the corrected stretch [0, M], P_l(2x/M - 1): well conditioned, and with closed
// derivatives
//
//   P_l^(r) at x = 0 is (-1)^(l-r) (l+r)! / (r! (l-r)! M^r).

// e_r for r = 1, 3, 5, ...: element (r + 1) / 2, from the generating function (x/2) / sinh(x/2) = sum of B_n(1/2) x^n /
// n!.
Eigen::VectorXd euler_maclaurin(Eigen::Index count) {
  Eigen::VectorXd sinh_series(count);  // sinh(x/2) / (x/2) in powers of x^2
  sinh_series[0] = 1.0;
  for (Eigen::Index i = 1; i < count; ++i) {
    sinh_series[i] = sinh_series[i - 1] / static_cast<double>(4 * (2 * i) * (2 * i + 1));
  }
  Eigen::VectorXd reciprocal = Eigen::VectorXd::Zero(count);
  reciprocal[0] = 1.0;
  for (Eigen::Index n = 1; n < count; ++n) {
    for (Eigen::Index i = 1; i <= n; ++i) reciprocal[n] -= sinh_series[i] * reciprocal[n - i];
  }
  return reciprocal;
}

// What the corrections must add to the sum for each Legendre polynomial.
Eigen::VectorXd moments(Eigen::Index order, Eigen::Index corrected) {
  const Eigen::VectorXd e = euler_maclaurin(order / 2 + 1);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(order);
  for (Eigen::Index l = 0; l < order; ++l) {
    double derivative = 1.0;  // |P_l^(r)(0)|, from r = 0 upwards
    for (Eigen::Index r = 0; r <= l; ++r) {
      const double signed_derivative = (l - r) % 2 == 0 ? derivative : -derivative;
      if (r % 2 == 1) result[l] += e[(r + 1) / 2] * signed_derivative;
      derivative *= static_cast<double>((l + r + 1) * (l - r)) / static_cast<double>((r + 1) * corrected);
    }
  }
  return result;
}

// Row l: P_l at the midpoints of the corrected stretch, by Bonnet's recurrence.
Eigen::MatrixXd legendre(Eigen::Index order, Eigen::Index corrected) {
  Eigen::MatrixXd p(order, corrected);
  for (Eigen::Index j = 0; j < corrected; ++j) {
    const double x = static_cast<double>(2 * j + 1) / static_cast<double>(corrected) - 1.0;
    p(0, j) = 1.0;
    if (order > 1) p(1, j) = x;
    for (Eigen::Index l = 1; l + 1 < order; ++l) {
      const auto degree = static_cast<double>(l);
      p(l + 1, j) = ((2.0 * degree + 1.0) * x * p(l, j) - degree * p(l - 1, j)) / (degree + 1.0);
    }
  }
  return p;
}

Eigen::VectorXd end_correction(Eigen::Index corrected) {
  const Eigen::Index order = std::max<Eigen::Index>(1, 4 * corrected / 5);
  return legendre(order, corrected).completeOrthogonalDecomposition().solve(moments(order, corrected));
}

}  // namespace

Eigen::VectorXd midpoint_weights(Eigen::Index n, double length, EndRule rule) {
  assert(n >= 1 && length > 0.0);
  const Eigen::Index most = rule == EndRule::kSmooth ? 20 : 5;
  const Eigen::VectorXd correction = end_correction(std::clamp<Eigen::Index>(n / 2, 1, most));
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  weights.head(correction.size()) += correction;
  weights.tail(correction.size()) += correction.reverse();
  return length / static_cast<double>(n) * weights;
}

}  // namespace vigil::field
