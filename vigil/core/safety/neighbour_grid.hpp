#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/parallel/workers.hpp"

namespace vigil::safety {

/// Points sorted into the cells of a grid over the field, to find those near a place without looking at all of them.
/// Points outside the field are in the cells at its border, points that are not finite in none. The cells of a row
/// follow each other, and the points of a cell: what is stored in the order of `sorted()` is near in memory where it is
/// near in the field. sort() takes time in proportion to the points and cells; nothing is allocated after construction.
class NeighbourGrid {
 public:
  /// `cell_m` > 0 is best the usual radius of a search; larger cells are taken where there would be more than about
  /// four per point. At most `capacity` points.
  NeighbourGrid(const field::Field& field, double cell_m, std::size_t capacity);

  /// Precondition: at most `capacity` points. They are copied. With workers part of it is done by several threads; the
  /// order is the same.
  void sort(std::span<const Vec2> points, parallel::Workers* workers = nullptr) noexcept {
    sort(points.size(), [&](std::size_t i) -> const Vec2& { return points[i]; }, workers);
  }

  /// The same for the points point_of(0) to point_of(count - 1), asked for in any order and by several threads.
  template <typename PointOf>
  void sort(std::size_t count, const PointOf& point_of, parallel::Workers* workers = nullptr) noexcept {
    count_ = count;
    parallel::for_each_part(workers, count, kPart, [&](std::size_t first, std::size_t last, std::size_t) {
      for (std::size_t i = first; i < last; ++i) {
        const auto& point = point_of(i);
        cells_[i] = static_cast<std::uint32_t>(point.allFinite() ? number_of(point) : columns_ * rows_);
      }
    });
    sort_cells();
  }

  /// The indices of all points: cell by cell from the lower left, in the order of their indices within one; then those
  /// that are in no cell.
  [[nodiscard]] std::span<const std::uint32_t> sorted() const { return std::span(sorted_).first(count_); }
  /// How many of the first of them are in cells.
  [[nodiscard]] std::size_t placed() const { return first_.back(); }

  /// Calls visit(first, last) for parts [first, last) of sorted() that together have every point within `radius` of
  /// `centre`, and some that are farther, in the order of sorted(). Precondition: finite centre, radius >= 0.
  template <typename Visit>
  void visit_parts(const Vec2& centre, double radius, Visit&& visit) const {
    const Cell low = cell_of(centre - Vec2(radius, radius));
    const Cell high = cell_of(centre + Vec2(radius, radius));
    for (std::size_t y = low.y; y <= high.y; ++y) {
      const std::size_t first = first_[y * columns_ + low.x];
      const std::size_t last = first_[y * columns_ + high.x + 1];
      if (first < last) visit(first, last);
    }
  }

  /// Calls visit(index) for each of these points.
  template <typename Visit>
  void visit_near(const Vec2& centre, double radius, Visit&& visit) const {
    visit_parts(centre, radius, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) visit(static_cast<std::size_t>(sorted_[k]));
    });
  }

 private:
  static constexpr std::size_t kPart = 2048;  ///< points
  void sort_cells() noexcept;

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
  std::size_t count_ = 0;
  std::vector<std::uint32_t> first_;   ///< where each cell begins in sorted_, and the end of the last
  std::vector<std::uint32_t> cells_;   ///< of each point; of one that is in none the number after the last
  std::vector<std::uint32_t> sorted_;  ///< indices of points, by cell
};

}  // namespace vigil::safety
