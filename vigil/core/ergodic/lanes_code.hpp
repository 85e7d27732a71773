#pragma once

#include <cstddef>

#include "vigil/core/ergodic/instruction_set.hpp"

namespace vigil::ergodic {

inline constexpr std::size_t kLanes = 8;            ///< numbers that are worked on side by side
inline constexpr std::size_t kLanesAlignment = 64;  ///< bytes; where memory should begin that is read in lanes

/// A basis as the vector code sees it: plain numbers, so that nothing of Eigen is compiled for one instruction set.
struct BasisNumbers {
  std::size_t indices = 0;  ///< K + 1
  double length_x = 0.0;
  double length_y = 0.0;
  const double* wave_numbers_x = nullptr;  ///< `indices` of them
  const double* wave_numbers_y = nullptr;
  const double* inverse_norm = nullptr;  ///< 1/h_k, entry (k1, k2) at k1 + indices k2, as of all coefficients
  double* work = nullptr;                ///< lanes_work_size(indices) numbers, aligned: contents do not matter
};

/// out(r, c) = sum over j of rows(r, j) columns(c, j).
struct RowProducts {
  const double* rows = nullptr;     ///< entry (r, j) at r stride + j
  const double* columns = nullptr;  ///< entry (c, j) at c stride + j
  std::size_t row_count = 0;
  std::size_t column_count = 0;
  std::size_t stride = 0;  ///< a multiple of kLanes, and the length of the sums: what is left of it has to be zero
  double* out = nullptr;
  std::size_t out_row_stride = 0;
  std::size_t out_column_stride = 0;
};

/// How many drones are summed up before their sum is added to the result: what fits into the first cache for K = 20,
/// and makes light of the sums across the lanes.
inline constexpr std::size_t kChunk = 128;

[[nodiscard]] constexpr std::size_t lanes_work_size(std::size_t indices) noexcept {
  return 2 * indices * kChunk + indices * indices;
}

/// The inner loops, compiled once for each instruction set. Every operation is spelt out, fused multiply-adds among
/// them, and every sum has its order: they all give the same bits. docs/decisions/0007-one-result-on-every-processor.md
struct LanesCode {
  /// Kernel::add_basis(). xy: x and y of one drone after the other.
  void (*add_basis)(const BasisNumbers& basis, const double* xy, const double* weights, std::size_t drones,
                    double* sum_k) noexcept;
  /// Kernel::gradient(), with a_k/h_k.
  void (*gradient)(const BasisNumbers& basis, const double* xy, std::size_t drones, const double* scaled_a,
                   double* out_xy) noexcept;
  /// Lane i sums j = i, i + kLanes, ... in that order; then the lanes are added: ((0+4)+(2+6)) + ((1+5)+(3+7)).
  void (*row_products)(const RowProducts& products) noexcept;
  /// sin(pi t), cos(pi t) of kLanes numbers, each within 4e-16 of the truth for any finite t.
  void (*sine_cosine)(const double* half_turns, double* sine, double* cosine) noexcept;
};

// Each in the file of its name, the latter two on x86-64 only.
[[nodiscard]] const LanesCode& lanes_portable() noexcept;
[[nodiscard]] const LanesCode& lanes_avx2() noexcept;
[[nodiscard]] const LanesCode& lanes_avx512() noexcept;

/// Precondition: one of instruction_sets().
[[nodiscard]] const LanesCode& lanes_code(InstructionSet set) noexcept;

}  // namespace vigil::ergodic
