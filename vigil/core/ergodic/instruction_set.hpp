#pragma once

#include <span>
#include <string_view>

namespace vigil::ergodic {

/// What the vector code is compiled for. All compute the same, to the last bit.
enum class InstructionSet {
  kPortable,  ///< whatever the whole program is compiled for
  kAvx2,      ///< x86-64 with AVX2 and FMA
  kAvx512,    ///< x86-64 with AVX-512 F
};

/// Those that were compiled and that this processor and its operating system have, the fastest last; never empty. Asks
/// the processor once. Any thread.
[[nodiscard]] std::span<const InstructionSet> instruction_sets() noexcept;

[[nodiscard]] inline InstructionSet fastest_instruction_set() noexcept { return instruction_sets().back(); }

[[nodiscard]] std::string_view name_of(InstructionSet set) noexcept;

}  // namespace vigil::ergodic
