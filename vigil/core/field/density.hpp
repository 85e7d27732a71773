#pragma once

#include <optional>

#include "vigil/core/field/importance.hpp"

namespace vigil::field {

/// A density sampled at the midpoints of nx x ny equal cells of the field.
struct DensityGrid {
  Field field;
  /// values(ix, iy) at ((ix + 1/2) length_x / nx, (iy + 1/2) length_y / ny), 1/m^2. Zero or more.
  Eigen::ArrayXXd values;
  /// Quadrature weights of the midpoints along each axis, metres; they sum to the side's length. The plain midpoint rule
  /// but for a few corrected weights at either end, which make the rule exact for polynomials of high degree: without
  /// them a density that does not vanish at the border costs the coefficients six digits.
  Eigen::VectorXd weights_x;
  Eigen::VectorXd weights_y;

  [[nodiscard]] Vec2 midpoint(Eigen::Index ix, Eigen::Index iy) const;
  /// The integral of the density over the field by the quadrature above.
  [[nodiscard]] double integral() const;
};

struct GridShape {
  Eigen::Index nx = 0;
  Eigen::Index ny = 0;
};

/// Quadrature weights for n midpoints of [0, length]: see DensityGrid. Precondition: n >= 1, length > 0.
[[nodiscard]] Eigen::VectorXd midpoint_weights(Eigen::Index n, double length);

/// The shape that resolves both the smallest sigma of the map and a basis of max_index K: between 128 and 1024 cells a side.
[[nodiscard]] GridShape grid_shape(const Field& field, const Importance& importance, int max_index);

/// The importance map (2), restricted to F minus the no-fly polygons and renormalised there as a whole, so that its
/// integral is 1. Empty where nothing is left to look at (no targets, or all their mass outside the allowed field).
[[nodiscard]] std::optional<DensityGrid> rasterise(const Field& field, const Importance& importance, GridShape shape);

/// The same for a given mixture of Gaussians (weights need not sum to 1), without areas, no-fly polygons or floor.
[[nodiscard]] std::optional<DensityGrid> rasterise(const Field& field, std::span<const Gaussian> mixture,
                                                   std::span<const double> weights, GridShape shape);

}  // namespace vigil::field
