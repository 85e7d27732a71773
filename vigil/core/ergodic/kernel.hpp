#pragma once

#include <span>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/ergodic/lanes_code.hpp"

namespace vigil::ergodic {

/// Sums and gradients of the basis over many drones. Separable: cosine tables by recurrence, then small products, with
/// the drones side by side in the vector registers. The results are the same to the last bit on every processor, and
/// with every instruction set that it may have (lanes_code.hpp). A drone's gradient is the same to the last bit
/// whatever its place among the others, and nothing depends on how the caller's data are aligned.
///
/// Owns its work space (24 KiB for K = 10, 46 KiB for K = 20, 163 KiB for K = 64), which holds nothing from one call to
/// the next: a copy costs as much and works alike. No call allocates. One thread at a time. The oracle is in
/// literal_kernel.hpp.
class Kernel {
 public:
  /// add_basis() sums up so many drones before it adds their sum to the result. Adding portions of so many, one call
  /// after the other, or each to zeros and then their sums in order, gives the bits of one call for all.
  static constexpr std::size_t kPortion = kChunk;

  /// Precondition: `set` is one of instruction_sets().
  explicit Kernel(const Basis& basis, InstructionSet set = fastest_instruction_set());

  /// sum_k += sum over i of weight_i f_k(p_i). Precondition: as many weights as positions, finite; sum_k is (K+1) x
  /// (K+1).
  void add_basis(std::span<const Vec2> positions, std::span<const double> weights, Coefficients& sum_k) noexcept;

  /// out_i = sum over k of a_k grad f_k(p_i): with a_k = lambda_k (c_k - phi_k) the b_i of (7), (8), whose second
  /// component has L2 where the paper prints L1. Precondition: as many outputs as positions; positions finite; a_k is
  /// (K+1) x (K+1).
  void gradient(std::span<const Vec2> positions, const Coefficients& a_k, std::span<Vec2> out) noexcept;

 private:
  [[nodiscard]] BasisNumbers numbers() noexcept;

  const LanesCode* code_;  ///< of static storage
  field::Field field_;
  Eigen::VectorXd wave_numbers_x_;
  Eigen::VectorXd wave_numbers_y_;
  Coefficients inverse_norm_;
  Coefficients scaled_a_;  ///< a_k / h_k
  std::vector<double> work_;
};

}  // namespace vigil::ergodic
