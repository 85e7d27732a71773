#pragma once

#include <limits>
#include <span>
#include <vector>

#include "vigil/core/field/cell_cover.hpp"
#include "vigil/core/field/field.hpp"

namespace vigil::field {

/// When each place of the field was seen last, on a grid of equal cells: a cell counts as seen when its middle is.
class SeenMap {
 public:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  /// Precondition: at least one cell.
  SeenMap(const Field& field, GridShape shape);

  /// A drone at `position` sees everything within `radius_m` at time now_s. Where it is outside of the field it sees
  /// what of the field it reaches. No allocation. Precondition: finite; now_s is never before the last call's.
  void see(const Vec2& position, double radius_m, double now_s) noexcept;
  /// A drone on its way from a, where it was at the last call, to b.
  void see_along(const Vec2& a, const Vec2& b, double radius_m, double now_s) noexcept;

  [[nodiscard]] const Field& field() const { return field_; }
  [[nodiscard]] GridShape shape() const { return shape_; }
  /// When cell (ix, iy) was seen last, at ix + nx iy; kNever for those that never were.
  [[nodiscard]] std::span<const double> seen_s() const { return seen_s_; }
  /// Takes up what seen_s() of a map of the same shape was; false, and nothing changed, for another size or NaN.
  [[nodiscard]] bool restore(std::span<const double> seen_s);

 private:
  Field field_;
  GridShape shape_;
  Vec2 cell_;  ///< its sides, metres
  std::vector<double> seen_s_;
};

/// Places on the way from a to b, so close that circles of radius_m around them leave nothing of the way's surroundings
/// unseen but 4 % of the radius; b is the last. At most 64, further apart where the way is that long.
[[nodiscard]] std::size_t steps_along(const Vec2& a, const Vec2& b, double radius_m) noexcept;
/// Appends these places.
void add_way(const Vec2& a, const Vec2& b, double radius_m, std::vector<Vec2>& places);

}  // namespace vigil::field
