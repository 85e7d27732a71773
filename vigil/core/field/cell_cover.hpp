#pragma once

#include <Eigen/Core>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"

namespace vigil::field {

/// How many equal cells the field is cut into along each axis.
struct GridShape {
  Eigen::Index nx = 0;
  Eigen::Index ny = 0;
};

/// The share of each cell's area that lies inside the polygon, in [0, 1]: entry (ix, iy) for the cell that begins at
/// (ix length_x / nx, iy length_y / ny). Exact up to rounding; cells wholly inside or outside have exactly 1 or 0.
/// Precondition: the polygon is simple; at least one cell.
[[nodiscard]] Eigen::ArrayXXd covered_share(const Polygon& polygon, const Field& field, GridShape shape);

}  // namespace vigil::field
