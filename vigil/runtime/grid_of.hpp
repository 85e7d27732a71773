#pragma once

#include <algorithm>
#include <cmath>

#include "vigil/core/field/cell_cover.hpp"
#include "vigil/core/field/field.hpp"

namespace vigil::runtime {

/// Cells that are nearly square, `longer` of them along the field's longer side, at least 4 along the other.
[[nodiscard]] inline field::GridShape grid_of(const field::Field& field, Eigen::Index longer) {
  const double cell = std::max(field.length_x, field.length_y) / static_cast<double>(longer);
  const auto cells = [&](double side) {
    return std::max<Eigen::Index>(4, static_cast<Eigen::Index>(std::lround(side / cell)));
  };
  return {cells(field.length_x), cells(field.length_y)};
}

}  // namespace vigil::runtime
