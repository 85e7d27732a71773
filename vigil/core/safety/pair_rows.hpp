#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/core/safety/pair_formula.hpp"

namespace vigil::safety {

/// One drone and some of the controlled bodies near it, side by side: what compute() of PairRows takes and gives.
struct PairBatch {
  static constexpr std::size_t kSize = 32;
  using Column = std::array<double, kSize>;

  // Given. Of the others; column i belongs to the i-th of them.
  alignas(64) Column point_x, point_y;  ///< barrier_point()
  alignas(64) Column position_x, position_y;
  alignas(64) Column velocity_x, velocity_y;
  alignas(64) Column age_s;

  // Computed.
  alignas(64) Column excess_m;    ///< how far beyond the range in which a pair has a row; > 0: it has none
  alignas(64) Column distance_m;  ///< between positions
  alignas(64) Column normal_x, normal_y, offset;
  alignas(64) Column lever;  ///< as in pair_formula::Row
};

/// The rows of pair_row() with separation_barrier(), for many others at once: the same bits, whatever instruction set
/// the machine has. Only for bodies that are controlled; the others' barriers differ from one to the next.
class PairRows {
 public:
  enum class InstructionSet : std::uint8_t { kPortable, kAvx2, kAvx512 };
  /// The widest that this machine has.
  [[nodiscard]] static InstructionSet best_instruction_set() noexcept;

  explicit PairRows(const BarrierParameters& parameters, InstructionSet set = best_instruction_set());

  /// Computes the first `count` columns of `batch` (and up to seven more, of whatever is there) for a drone at the
  /// barrier point z, all of whose pairs within `reach_m` matter. Precondition: count <= PairBatch::kSize, finite
  /// numbers.
  void compute(const Body& own, const Vec2& z, double reach_m, std::size_t count, PairBatch& batch) const noexcept {
    compute_(*this, own, z, reach_m, count, batch);
  }

 private:
  using Compute = void (*)(const PairRows& rule, const Body& own, const Vec2& z, double reach_m, std::size_t count,
                           PairBatch& batch) noexcept;
  friend struct PairLoops;

  Compute compute_;
  pair_formula::Rule rule_;
  double fresh_radius_m_;  ///< of the barrier, for drones that are seen as they are
  double set_range_m_;     ///< the sensing range that was set; 0 where none was
  double range_beyond_m_;  ///< the least range beyond the radius: infinite where no range was set
};

}  // namespace vigil::safety
