#include "vigil/core/ergodic/kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vigil::ergodic {
namespace {

// cos(k theta) and their derivatives -kappa_k sin(k theta) for k = 0..K, theta = kappa_1 x: each index is the one
// before turned by theta. The error grows by a rounding a step: some 1e-14 at k = 64.
template <typename Lanes, typename Table>
void tabulate(const Lanes& x, const Eigen::VectorXd& kappa, Table& cosines, Table& slopes) noexcept {
  Lanes cos_theta;
  Lanes sin_theta;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    cos_theta[i] = std::cos(kappa[1] * x[i]);
    sin_theta[i] = std::sin(kappa[1] * x[i]);
  }
  Lanes cosine = Lanes::Ones();
  Lanes sine = Lanes::Zero();
  for (Eigen::Index k = 0; k < kappa.size(); ++k) {
    cosines.col(k) = cosine;
    slopes.col(k) = -kappa[k] * sine;
    const Lanes turned_cosine = cosine * cos_theta - sine * sin_theta;
    sine = sine * cos_theta + cosine * sin_theta;
    cosine = turned_cosine;
  }
}

}  // namespace

Kernel::Kernel(const Basis& basis)
    : wave_numbers_x_(basis.wave_numbers_x()),
      wave_numbers_y_(basis.wave_numbers_y()),
      inverse_norm_(basis.norm().cwiseInverse()),
      scaled_a_(basis.indices_per_axis(), basis.indices_per_axis()),
      cos_x_(kBlock, basis.indices_per_axis()),
      cos_y_(kBlock, basis.indices_per_axis()),
      slope_x_(kBlock, basis.indices_per_axis()),
      slope_y_(kBlock, basis.indices_per_axis()) {}

void Kernel::load(std::span<const Vec2> positions) noexcept {
  Lanes x = Lanes::Zero();
  Lanes y = Lanes::Zero();
  const std::size_t present = std::min<std::size_t>(positions.size(), kBlock);
  for (std::size_t i = 0; i < present; ++i) {
    x[static_cast<Eigen::Index>(i)] = positions[i].x();
    y[static_cast<Eigen::Index>(i)] = positions[i].y();
  }
  tabulate(x, wave_numbers_x_, cos_x_, slope_x_);
  tabulate(y, wave_numbers_y_, cos_y_, slope_y_);
}

void Kernel::add_basis(std::span<const Vec2> positions, std::span<const double> weights, Coefficients& sum_k) noexcept {
  assert(positions.size() == weights.size());
  assert(sum_k.rows() == inverse_norm_.rows() && sum_k.cols() == inverse_norm_.cols());
  for (std::size_t first = 0; first < positions.size(); first += kBlock) {
    load(positions.subspan(first));
    Lanes weight = Lanes::Zero();
    const std::size_t present = std::min<std::size_t>(positions.size() - first, kBlock);
    for (std::size_t i = 0; i < present; ++i) weight[static_cast<Eigen::Index>(i)] = weights[first + i];

    // sum_k += 1/h_k sum over i of weight_i cos(k1 pi x_i / L1) cos(k2 pi y_i / L2): (5)
    for (Eigen::Index k2 = 0; k2 < sum_k.cols(); ++k2) {
      const Lanes weighted_cos_y = weight * cos_y_.col(k2);
      for (Eigen::Index k1 = 0; k1 < sum_k.rows(); ++k1) {
        sum_k(k1, k2) += inverse_norm_(k1, k2) * (cos_x_.col(k1) * weighted_cos_y).sum();
      }
    }
  }
}

void Kernel::gradient(std::span<const Vec2> positions, const Coefficients& a_k, std::span<Vec2> out) noexcept {
  assert(positions.size() == out.size());
  assert(a_k.rows() == inverse_norm_.rows() && a_k.cols() == inverse_norm_.cols());
  scaled_a_ = a_k.cwiseProduct(inverse_norm_).transpose();
  for (std::size_t first = 0; first < positions.size(); first += kBlock) {
    load(positions.subspan(first));

    // b = sum over k1 of [slope_x(k1) sum over k2 of a_k/h_k cos_y(k2),  cos_x(k1) sum over k2 of a_k/h_k slope_y(k2)]:
    // (7), (8)
    Lanes b_x = Lanes::Zero();
    Lanes b_y = Lanes::Zero();
    for (Eigen::Index k1 = 0; k1 < scaled_a_.cols(); ++k1) {
      Lanes along_cos_y = Lanes::Zero();
      Lanes along_slope_y = Lanes::Zero();
      for (Eigen::Index k2 = 0; k2 < scaled_a_.rows(); ++k2) {
        along_cos_y += scaled_a_(k2, k1) * cos_y_.col(k2);
        along_slope_y += scaled_a_(k2, k1) * slope_y_.col(k2);
      }
      b_x += slope_x_.col(k1) * along_cos_y;
      b_y += cos_x_.col(k1) * along_slope_y;
    }

    const std::size_t present = std::min<std::size_t>(positions.size() - first, kBlock);
    for (std::size_t i = 0; i < present; ++i) {
      out[first + i] = Vec2(b_x[static_cast<Eigen::Index>(i)], b_y[static_cast<Eigen::Index>(i)]);
    }
  }
}

}  // namespace vigil::ergodic
