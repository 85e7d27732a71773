#include "vigil/core/safety/planar_qp_batch.hpp"

#include <algorithm>

namespace vigil::safety {
namespace {

/// Of speeds; others are for the solver that takes its time.
constexpr double kLargest = 1e20;
constexpr double kSmallest = 1e-20;

auto code_of(PairRows::InstructionSet set) {
#if defined(__x86_64__)
  if (set == PairRows::InstructionSet::kAvx512) return solve_avx512;
  if (set == PairRows::InstructionSet::kAvx2) return solve_avx2;
#endif
  return set == PairRows::InstructionSet::kPortable ? solve_portable : nullptr;
}

}  // namespace

PlanarQpBatch::PlanarQpBatch(InstructionSet set) : solve_(code_of(set)) {}

/// Rows that always hold bring all problems to the same number of them.
void PlanarQpBatch::level() noexcept {
  columns_.rows = *std::max_element(rows_.begin(), rows_.end());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t row = rows_[lane]; row < columns_.rows; ++row) {
      columns_.normal_x[row][lane] = 1.0;
      columns_.normal_y[row][lane] = 0.0;
      columns_.offset[row][lane] = -2.0 * kLargest;
    }
  }
}

void PlanarQpBatch::solve(double radius) noexcept {
  columns_.is_solved = 0;
  if (!(radius > kSmallest && radius < kLargest)) return;
  level();
  solve_(columns_, radius);
}

}  // namespace vigil::safety
