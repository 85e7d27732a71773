#include "vigil/core/safety/neighbour_grid.hpp"

#include <cassert>
#include <cmath>

namespace vigil::safety {
namespace {

std::size_t cells_along(double length, double cell, std::size_t most) {
  const double count = std::floor(length / cell);
  return count >= 1.0 ? static_cast<std::size_t>(std::min(count, static_cast<double>(most))) : 1;
}

}  // namespace

NeighbourGrid::NeighbourGrid(const field::Field& field, double cell_m, std::size_t capacity)
    : cells_(capacity), sorted_(capacity) {
  const auto points = static_cast<double>(std::max<std::size_t>(1, capacity));
  const double cell = std::max(cell_m, std::sqrt(field.area() / (4.0 * points)));
  const std::size_t most = 4 * std::max<std::size_t>(1, capacity);
  columns_ = cells_along(field.length_x, cell, most);
  rows_ = cells_along(field.length_y, cell, most);
  columns_per_m_ = static_cast<double>(columns_) / field.length_x;
  rows_per_m_ = static_cast<double>(rows_) / field.length_y;
  first_.resize(columns_ * rows_ + 1);
}

void NeighbourGrid::sort_cells() noexcept {
  assert(count_ <= sorted_.size());
  std::fill(first_.begin(), first_.end(), 0u);
  for (std::size_t i = 0; i < count_; ++i) ++first_[cells_[i]];
  std::uint32_t end = 0;
  for (std::uint32_t& cell : first_) cell = end += cell;  // now where each cell ends
  for (std::size_t i = count_; i-- > 0;) sorted_[--first_[cells_[i]]] = static_cast<std::uint32_t>(i);
}

}  // namespace vigil::safety
