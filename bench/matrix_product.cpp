#include "bench/matrix_product.hpp"

namespace vigil::bench {

void multiply(ergodic::InstructionSet set, const double* a, const double* b, double* c) {
#if defined(__x86_64__)
  if (set == ergodic::InstructionSet::kAvx512) return multiply_avx512(a, b, c);
  if (set == ergodic::InstructionSet::kAvx2) return multiply_avx2(a, b, c);
#endif
  multiply_portable(a, b, c);
}

}  // namespace vigil::bench
