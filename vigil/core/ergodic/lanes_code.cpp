#include "vigil/core/ergodic/lanes_code.hpp"

#include <algorithm>
#include <cassert>

namespace vigil::ergodic {

const LanesCode& lanes_code(InstructionSet set) noexcept {
  assert(std::ranges::find(instruction_sets(), set) != instruction_sets().end());
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return lanes_avx512();
  if (set == InstructionSet::kAvx2) return lanes_avx2();
#endif
  return lanes_portable();
}

}  // namespace vigil::ergodic
