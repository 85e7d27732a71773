#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "vigil/core/field/vec2.hpp"

namespace vigil::safety {

/// What gives way first when not everything can be had: the later, the earlier it is relaxed (control.md 5, fact 5).
/// The disk |u| <= u_max is above all of them and never relaxed.
enum class Priority : std::uint8_t {
  kPhysicalRadius,  ///< bodies that would touch
  kSeparation,      ///< R_s
  kWall,            ///< R_wall and the no-fly buffer
  kMargin,          ///< what is kept beyond these for noise, wind and limits, which are always there
  kDoubt            ///< and beyond that, for what lost and failed drones might do
};
inline constexpr std::size_t kPriorities = 5;

/// The half-plane normal . u >= offset. The normal need not be of unit length (rows are normalised inside, so that a
/// violation is a speed); a zero normal is a row that says only 0 >= offset:
/// it is reported like any other, but no u changes it, and no other row is relaxed for it.
struct HalfPlane {
  Vec2 normal = Vec2::Zero();
  double offset = 0.0;
  Priority priority = Priority::kSeparation;
};

/// Most rows that a problem may have; the filter keeps the most pressing ones.
inline constexpr std::size_t kMaxRows = 192;

struct PlanarQpSolution {
  Vec2 u = Vec2::Zero();  ///< finite, |u| <= radius always
  bool feasible = true;   ///< every row holds
  /// Per priority the least possible largest violation of its normalised rows, given those of the priorities before it.
  /// All 0 where feasible: rows that only rounding breaks hold.
  std::array<double, kPriorities> violation{};
  /// Rows that hold u where it is (at most two), -1 for none; of the relaxed problem where that was needed.
  std::array<int, 2> active{-1, -1};
  bool on_disk = false;  ///< the speed limit holds u where it is
};

/// Exactly minimises |u - u_nom|^2 subject to the rows and |u| <= radius (10). Where the rows contradict each other,
/// the priorities are relaxed from the last: lexicographically, each one's largest violation is the least possible;
/// among the u that reach it, the one closest to u_nom. Result within 1e-9 (for data of the size of 1), never NaN.
/// Precondition: finite input, radius >= 0, at most kMaxRows rows. No allocation.
[[nodiscard]] PlanarQpSolution solve(const Vec2& u_nom, std::span<const HalfPlane> rows, double radius) noexcept;

}  // namespace vigil::safety
