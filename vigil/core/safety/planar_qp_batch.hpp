#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "vigil/core/safety/pair_rows.hpp"
#include "vigil/core/safety/planar_qp.hpp"
#include "vigil/core/safety/planar_qp_columns.hpp"

namespace vigil::safety {

/// Eight problems (10), solved at once. A lane that is solved has the solution of solve() to the last bit, on every
/// instruction set. Not solved are problems without a solution, and such as are not plain: with numbers that are not
/// finite, huge or tiny, or with a zero normal. Work space and result: a few kilobytes; allocates nothing.
class PlanarQpBatch {
 public:
  using InstructionSet = PairRows::InstructionSet;
  static constexpr std::size_t kLanes = PlanarQpColumns::kLanes;
  static constexpr std::size_t kMostRows = PlanarQpColumns::kMostRows;

  explicit PlanarQpBatch(InstructionSet set = PairRows::best_instruction_set());

  /// Makes a lane a problem without rows.
  void begin(std::size_t lane, const Vec2& u_nom) noexcept {
    columns_.u_nom_x[lane] = u_nom.x();
    columns_.u_nom_y[lane] = u_nom.y();
    rows_[lane] = 0;
  }
  /// Precondition: fewer than kMostRows before. Its priority does not matter where the problem has a solution.
  void add(std::size_t lane, const HalfPlane& row) noexcept {
    const std::size_t at = rows_[lane]++;
    assert(at < kMostRows);
    columns_.normal_x[at][lane] = row.normal.x();
    columns_.normal_y[at][lane] = row.normal.y();
    columns_.offset[at][lane] = row.offset;
  }

  /// Solves all lanes. Precondition: radius >= 0.
  void solve(double radius) noexcept;

  [[nodiscard]] bool is_solved(std::size_t lane) const noexcept { return (columns_.is_solved >> lane & 1U) != 0; }
  /// Precondition: is_solved(lane).
  [[nodiscard]] PlanarQpSolution solution(std::size_t lane) const noexcept {
    PlanarQpSolution result;
    result.u = Vec2(columns_.u_x[lane], columns_.u_y[lane]);
    result.active = {static_cast<int>(columns_.line[lane]), static_cast<int>(columns_.end[lane])};
    result.on_disk = (columns_.on_disk >> lane & 1U) != 0;
    return result;
  }

 private:
  void level() noexcept;

  PlanarQpColumns columns_{};
  std::array<std::size_t, kLanes> rows_{};  ///< of each problem
  void (*solve_)(PlanarQpColumns& problems, double radius) noexcept;
};

}  // namespace vigil::safety
