#pragma once

#include <Eigen/Core>

#include "vigil/core/ergodic/instruction_set.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/core/field/field.hpp"

namespace vigil::ergodic {

/// Numbers over the Fourier indices k = (k1, k2), k1, k2 = 0..K: entry (k1, k2), k1 fastest in memory.
using Coefficients = Eigen::MatrixXd;

/// The normalised Fourier basis (5), (6) on a field, with the weights lambda_k of the metric (4).
class Basis {
 public:
  static constexpr int kLargestIndex = 64;

  /// Precondition: positive sides, 1 <= max_index <= kLargestIndex, smoothness > 0 (the paper's s).
  Basis(const field::Field& field, int max_index, double smoothness);

  [[nodiscard]] const field::Field& field() const { return field_; }
  [[nodiscard]] int max_index() const { return max_index_; }  ///< K
  [[nodiscard]] int indices_per_axis() const { return max_index_ + 1; }
  /// k1 pi / L1 and k2 pi / L2 for the indices 0..K, 1/m.
  [[nodiscard]] const Eigen::VectorXd& wave_numbers_x() const { return wave_numbers_x_; }
  [[nodiscard]] const Eigen::VectorXd& wave_numbers_y() const { return wave_numbers_y_; }
  /// h_k of (6), metres.
  [[nodiscard]] const Coefficients& norm() const { return norm_; }
  /// lambda_k = (1 + k1^2 + k2^2)^-s.
  [[nodiscard]] const Coefficients& weight() const { return weight_; }

  /// f_k(q) of (5) for every k, 1/m. The slow literal kernel: std::cos in two loops. Any finite q: even and periodic
  /// beyond F.
  [[nodiscard]] Coefficients evaluate(const Vec2& q) const;

 private:
  field::Field field_;
  int max_index_;
  Eigen::VectorXd wave_numbers_x_;
  Eigen::VectorXd wave_numbers_y_;
  Coefficients norm_;
  Coefficients weight_;
};

/// phi_k (5): the integral over F of f_k phi, 1/m. By two small matrix products over the grid, summed in a fixed order:
/// the same to the last bit on every processor and with every instruction set. Allocates.
/// Precondition: the density is one of the basis's field; `set` is one of instruction_sets().
[[nodiscard]] Coefficients target_coefficients(const Basis& basis, const field::DensityGrid& density,
                                               InstructionSet set = fastest_instruction_set());

/// eps (4) = sum over k of lambda_k (c_k - phi_k)^2, 1/m^2. Precondition: both (K+1) x (K+1).
[[nodiscard]] double ergodic_metric(const Basis& basis, const Coefficients& c_k, const Coefficients& phi_k) noexcept;

}  // namespace vigil::ergodic
