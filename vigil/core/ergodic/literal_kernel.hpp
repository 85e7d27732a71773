#pragma once

#include <span>

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::ergodic {

/// What Kernel computes, written down as the paper has it: a loop over k with std::cos and std::sin for every drone.
/// Slow; the oracle of tests and benchmarks. The contracts are those of Kernel's members.
void add_basis_literally(const Basis& basis, std::span<const Vec2> positions, std::span<const double> weights,
                         Coefficients& sum_k);

void gradient_literally(const Basis& basis, std::span<const Vec2> positions, const Coefficients& a_k,
                        std::span<Vec2> out);

}  // namespace vigil::ergodic
