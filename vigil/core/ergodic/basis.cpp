#include "vigil/core/ergodic/basis.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace vigil::ergodic {
namespace {

Eigen::VectorXd wave_numbers(int max_index, double length) {
  Eigen::VectorXd result(max_index + 1);
  for (int k = 0; k <= max_index; ++k) result[k] = k * std::numbers::pi / length;
  return result;
}

// Row k, column j: cos(k pi (j + 1/2) / n) times the weight of midpoint j.
Eigen::MatrixXd weighted_cosines(int max_index, const Eigen::VectorXd& weights) {
  Eigen::MatrixXd table(max_index + 1, weights.size());
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    const double phase = std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(weights.size());
    for (int k = 0; k <= max_index; ++k) table(k, j) = weights[j] * std::cos(k * phase);
  }
  return table;
}

}  // namespace

Basis::Basis(const field::Field& field, int max_index, double smoothness)
    : field_(field),
      max_index_(max_index),
      wave_numbers_x_(wave_numbers(max_index, field.length_x)),
      wave_numbers_y_(wave_numbers(max_index, field.length_y)),
      norm_(max_index + 1, max_index + 1),
      weight_(max_index + 1, max_index + 1) {
  assert(field.length_x > 0.0 && field.length_y > 0.0);
  assert(max_index >= 1 && max_index <= kLargestIndex && smoothness > 0.0);
  for (int k1 = 0; k1 <= max_index; ++k1) {
    for (int k2 = 0; k2 <= max_index; ++k2) {
      // (6): the integral of cos^2 over a side is the side's length for index 0, half of it for any other.
      norm_(k1, k2) = std::sqrt(field.area() * (k1 == 0 ? 1.0 : 0.5) * (k2 == 0 ? 1.0 : 0.5));
      weight_(k1, k2) = std::pow(1.0 + k1 * k1 + k2 * k2, -smoothness);
    }
  }
}

Coefficients Basis::evaluate(const Vec2& q) const {
  Coefficients f_k(indices_per_axis(), indices_per_axis());
  for (int k1 = 0; k1 <= max_index_; ++k1) {
    for (int k2 = 0; k2 <= max_index_; ++k2) {
      f_k(k1, k2) =
          std::cos(wave_numbers_x_[k1] * q.x()) * std::cos(wave_numbers_y_[k2] * q.y()) / norm_(k1, k2);  // (5)
    }
  }
  return f_k;
}

Coefficients target_coefficients(const Basis& basis, const field::DensityGrid& density) {
  const Eigen::MatrixXd cos_x = weighted_cosines(basis.max_index(), density.weights_x);
  const Eigen::MatrixXd cos_y = weighted_cosines(basis.max_index(), density.weights_y);

  // The products are spelt out: a library's would sum in an order that depends on the machine's caches.
  Coefficients sums = Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis());
  Eigen::VectorXd row(basis.indices_per_axis());  // for one y: the integral over x for every k1
  for (Eigen::Index iy = 0; iy < density.values.cols(); ++iy) {
    row.setZero();
    for (Eigen::Index ix = 0; ix < density.values.rows(); ++ix) row += density.values(ix, iy) * cos_x.col(ix);
    for (Eigen::Index k2 = 0; k2 < sums.cols(); ++k2) sums.col(k2) += cos_y(k2, iy) * row;
  }
  return sums.cwiseQuotient(basis.norm());
}

double ergodic_metric(const Basis& basis, const Coefficients& c_k, const Coefficients& phi_k) noexcept {
  return (basis.weight().array() * (c_k - phi_k).array().square()).sum();  // (4)
}

}  // namespace vigil::ergodic
