#include "vigil/core/ergodic/instruction_set.hpp"

#include <array>
#include <cstddef>

namespace vigil::ergodic {
namespace {

struct Present {
  std::array<InstructionSet, 3> sets{InstructionSet::kPortable};
  std::size_t count = 1;
};

Present ask_processor() noexcept {
  Present present;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    present.sets.at(present.count++) = InstructionSet::kAvx2;
    if (__builtin_cpu_supports("avx512f")) present.sets.at(present.count++) = InstructionSet::kAvx512;
  }
#endif
  return present;
}

}  // namespace

std::span<const InstructionSet> instruction_sets() noexcept {
  static const Present present = ask_processor();
  return std::span(present.sets).first(present.count);
}

std::string_view name_of(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::kAvx2:
      return "AVX2";
    case InstructionSet::kAvx512:
      return "AVX-512";
    case InstructionSet::kPortable:
      break;
  }
  return "portable";
}

}  // namespace vigil::ergodic
