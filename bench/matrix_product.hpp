#pragma once

#include "vigil/core/ergodic/instruction_set.hpp"

namespace vigil::bench {

/// c = a b by Eigen, with matrices of kProductSide x kProductSide numbers, column after column: what a processor can do
/// in double precision, more or less. Precondition: one of instruction_sets().
inline constexpr int kProductSide = 192;
inline constexpr double kProductFlop = 2.0 * kProductSide * kProductSide * kProductSide;
void multiply(ergodic::InstructionSet set, const double* a, const double* b, double* c);

// Each compiled for its instruction set, in the file of its name.
void multiply_portable(const double* a, const double* b, double* c);
void multiply_avx2(const double* a, const double* b, double* c);
void multiply_avx512(const double* a, const double* b, double* c);

}  // namespace vigil::bench
