#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"

namespace vigil::safety {

/// Points sorted into the cells of a grid over the field, to find those near a place without looking at all of them.
/// Points outside the field are in the cells at its border, points that are not finite in none.
/// sort() takes time in proportion to the points and cells; nothing is allocated after construction.
class NeighbourGrid {
 public:
  /// `cell_m` > 0 is best the usual radius of a search; larger cells are taken where there would be more than about
  /// four per point. At most `capacity` points.
  NeighbourGrid(const field::Field& field, double cell_m, std::size_t capacity);

  /// Precondition: at most `capacity` points. They are copied.
  void sort(std::span<const Vec2> points) noexcept;

  /// Calls visit(index) for every point within `radius` of `centre`, and for some that are farther: cell by cell from
  /// the lower left, in the order of their indices within one. Precondition: finite centre, radius >= 0.
  template <typename Visit>
  void visit_near(const Vec2& centre, double radius, Visit&& visit) const {
    const Cell low = cell_of(centre - Vec2(radius, radius));
    const Cell high = cell_of(centre + Vec2(radius, radius));
    for (std::size_t y = low.y; y <= high.y; ++y) {
      const std::size_t end = first_[y * columns_ + high.x + 1];  // the cells of a row follow each other
      for (std::size_t k = first_[y * columns_ + low.x]; k < end; ++k) visit(static_cast<std::size_t>(sorted_[k]));
    }
  }

 private:
  struct Cell {
    std::size_t x = 0;
    std::size_t y = 0;
  };
  [[nodiscard]] static std::size_t along(double position, double cells_per_m, std::size_t count) {
    const double cell = position * cells_per_m;
    return cell > 0.0 ? static_cast<std::size_t>(std::min(cell, static_cast<double>(count - 1))) : 0;
  }
  [[nodiscard]] Cell cell_of(const Vec2& p) const {
    return {along(p.x(), columns_per_m_, columns_), along(p.y(), rows_per_m_, rows_)};
  }
  [[nodiscard]] std::size_t number_of(const Vec2& p) const {
    const Cell cell = cell_of(p);
    return cell.y * columns_ + cell.x;
  }

  std::size_t columns_;
  std::size_t rows_;
  double columns_per_m_;
  double rows_per_m_;
  std::vector<std::uint32_t> first_;   ///< where each cell begins in sorted_, and the end
  std::vector<std::uint32_t> sorted_;  ///< indices of points, by cell
};

}  // namespace vigil::safety
