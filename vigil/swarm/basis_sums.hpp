#pragma once

#include <span>
#include <vector>

#include "vigil/core/ergodic/kernel.hpp"
#include "vigil/core/parallel/workers.hpp"

namespace vigil::swarm {

/// The sums of the basis over many drones, shared out among threads. Each portion that a kernel sums up by itself has a
/// place of its own; the portions are added in order, so that any number of threads gives the bits of one. A value; it
/// holds nothing from one call to the next.
class BasisSums {
 public:
  /// For so many drones at most. Work space for a few thousand of them at a time: 64 (K+1)^2 numbers.
  BasisSums(const ergodic::Basis& basis, std::size_t drones);

  /// sum_k += weight times the sum over i of f_k(p_i). Allocates nothing. Precondition: a kernel of the basis for each
  /// thread; sum_k is (K+1) x (K+1).
  void add(std::span<ergodic::Kernel> kernels, std::span<const Vec2> positions, double weight,
           ergodic::Coefficients& sum_k, parallel::Workers* workers) noexcept;

 private:
  std::vector<ergodic::Coefficients> portions_;
};

}  // namespace vigil::swarm
