#pragma once

#include <span>

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::ergodic {

/// Sums and gradients of the basis over many drones. Separable: cosine tables by recurrence for a block of drones at a
/// time, then two small products, with the drones side by side in the vector registers. A drone's gradient is the same
/// to the last bit whatever its place among the others, and nothing depends on how the caller's data are aligned.
///
/// Owns its work space (5 KiB for K = 10, 83 KiB for K = 64), which holds nothing from one call to the next: a copy
/// costs as much and works alike. No call allocates. One thread at a time. The oracle is in literal_kernel.hpp.
class Kernel {
 public:
  explicit Kernel(const Basis& basis);

  /// sum_k += sum over i of weight_i f_k(p_i). Precondition: as many weights as positions, finite; sum_k is (K+1) x
  /// (K+1).
  void add_basis(std::span<const Vec2> positions, std::span<const double> weights, Coefficients& sum_k) noexcept;

  /// out_i = sum over k of a_k grad f_k(p_i): with a_k = lambda_k (c_k - phi_k) the b_i of (7), (8), whose second
  /// component has L2 where the paper prints L1. Precondition: as many outputs as positions; positions finite; a_k is
  /// (K+1) x (K+1).
  void gradient(std::span<const Vec2> positions, const Coefficients& a_k, std::span<Vec2> out) noexcept;

 private:
  static constexpr int kBlock = 8;
  using Lanes = Eigen::Array<double, kBlock, 1>;               ///< one number for each drone of a block
  using Table = Eigen::Array<double, kBlock, Eigen::Dynamic>;  ///< column k: index k for each drone of a block

  // Fills the tables for the first kBlock of the positions; drones that are missing sit at (0, 0).
  void load(std::span<const Vec2> positions) noexcept;

  Eigen::VectorXd wave_numbers_x_;
  Eigen::VectorXd wave_numbers_y_;
  Coefficients inverse_norm_;
  Coefficients scaled_a_;  ///< a_k / h_k, entry (k2, k1): transposed, since the products run along k2
  Table cos_x_;            ///< cos(k1 pi x / L1)
  Table cos_y_;
  Table slope_x_;  ///< the derivative of cos(k1 pi x / L1) by x
  Table slope_y_;
};

}  // namespace vigil::ergodic
