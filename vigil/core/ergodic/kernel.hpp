#pragma once

#include <span>

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::ergodic {

/// Sums and gradients of the basis over many drones. Separable: cosine tables by recurrence, then small matrix products over
/// blocks of drones. Owns its work space; no call allocates. One thread at a time. The oracle is in literal_kernel.hpp.
class Kernel {
 public:
  explicit Kernel(const Basis& basis);

  /// sum_k += sum over i of weight_i f_k(p_i). Precondition: as many weights as positions, finite; sum_k is (K+1) x (K+1).
  void add_basis(std::span<const Vec2> positions, std::span<const double> weights, Coefficients& sum_k) noexcept;

  /// out_i = sum over k of a_k grad f_k(p_i): with a_k = lambda_k (c_k - phi_k) the b_i of (7), (8), whose second component
  /// has L2 where the paper prints L1. Precondition: as many outputs as positions; positions finite.
  void gradient(std::span<const Vec2> positions, const Coefficients& a_k, std::span<Vec2> out) noexcept;

 private:
  // (the implementer completes this)
};

}  // namespace vigil::ergodic
