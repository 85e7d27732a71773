#pragma once

#include <array>
#include <span>
#include <vector>

#include "vigil/core/ergodic/allowed_region.hpp"
#include "vigil/core/ergodic/coverage_statistics.hpp"

namespace vigil::ergodic {

/// What the swarm is to foresee: every drone's start and the velocities of its next pieces of path.
struct Paths {
  std::span<const Vec2> starts;      ///< one a drone, metres
  std::span<const Vec2> velocities;  ///< piece j of drone i at i x pieces + j, m/s
  double piece_s = 0.0;              ///< > 0: how long a piece lasts
};

/// How much the indices weigh in a forecast.
enum class Emphasis {
  kMetric,  ///< lambda_k, as in (4)
  kDetail   ///< lambda_k^0.85: high indices, which tell a small place from its surroundings, count for more
};

/// The coverage of the next seconds, if every drone flew its path, and how it changes with the paths:
///
///     J = sum over pieces j of sum over k of lambda_k D_jk^2,     D_j = T_j (c_k(t_j) - phi_k)
///
/// after piece j, each piece counting at its midpoint, by the same accounting and memory as the statistics. T_j does
/// not depend on the paths, so that D_j^2 is the metric (4) at t_j in a fixed unit. Paths are kept in the allowed
/// region: a piece that leads out of it slides along the border. Docs: docs/derivations/coverage.md, section 6.
///
/// Owns its work space; no call allocates. One thread at a time.
class Forecast {
 public:
  Forecast(const Basis& basis, std::size_t drones, int pieces);

  [[nodiscard]] int pieces() const noexcept { return static_cast<int>(excess_.size()); }

  /// What lambda_k stands for in the runs to come, and in their cost, slopes and curvature; at first kMetric.
  void set_emphasis(Emphasis emphasis) noexcept { emphasis_ = emphasis; }

  /// Precondition: at most `drones` starts, `pieces` velocities each; finite; the kernel and the statistics are of the
  /// same basis. Costs `pieces` calls each of Kernel::add_basis and Kernel::gradient for the drones.
  void run(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k, const AllowedRegion& region,
           const Paths& paths) noexcept;

  /// J of the last run.
  [[nodiscard]] double cost() const noexcept;
  /// dJ/dv in the order of Paths::velocities. Exact while no border holds the path; a held end has the slope that is
  /// left for sliding.
  [[nodiscard]] std::span<const Vec2> slopes() const noexcept { return slopes_; }
  /// About how much a slope changes with its velocity, d2J/dv2, where the gradients of all f_k have their mean size and
  /// a path moves as a whole: (pieces^2 gain piece_s)^2 / 10 times the mean over F of sum lambda_k |grad f_k|^2.
  [[nodiscard]] double curvature() const noexcept;

 private:
  void follow(const AllowedRegion& region, const Paths& paths) noexcept;
  void foresee(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
               double piece_s) noexcept;
  void look_back(Kernel& kernel, const CoverageStatistics& statistics, double piece_s) noexcept;
  void trace_back(double scale) noexcept;

  [[nodiscard]] std::size_t emphasis() const noexcept { return static_cast<std::size_t>(emphasis_); }

  std::array<Coefficients, 2> weight_;        ///< lambda_k with each emphasis
  std::array<double, 2> mean_squared_slope_;  ///< the mean over F of sum lambda_k |grad f_k|^2 with each, 1/m^4
  Emphasis emphasis_ = Emphasis::kMetric;
  std::vector<Coefficients> excess_;  ///< D_j
  Coefficients a_k_;
  std::size_t most_nodes_ = 0;  ///< of a run; a copy, which has not their room yet, makes it at its first run
  std::size_t drones_ = 0;      ///< of the last run
  double moment_s2_ = 0.0;      ///< of the last run: gain x piece_s
  // Piece j of drone i at j x drones_ + i: the kernel takes all drones of one piece at once.
  std::vector<Vec2> midpoints_;
  std::vector<Vec2> midpoint_slopes_;
  std::vector<KeptPoint> ends_;
  std::vector<Vec2> slopes_;
};

}  // namespace vigil::ergodic
