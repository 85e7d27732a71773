#pragma once

#include <optional>
#include <span>

#include "vigil/core/field/cell_cover.hpp"
#include "vigil/core/field/importance.hpp"
#include "vigil/core/field/midpoint_rule.hpp"

namespace vigil::field {

/// A density sampled at the midpoints of nx x ny equal cells of the field.
struct DensityGrid {
  Field field;
  /// values(ix, iy) at ((ix + 1/2) length_x / nx, (iy + 1/2) length_y / ny), 1/m^2. Zero or more.
  Eigen::ArrayXXd values;
  /// Quadrature weights of the midpoints along each axis, metres; they sum to the side's length. Not all alike: without
  /// corrected ends a density that does not vanish at the border costs the coefficients six digits (midpoint_rule.hpp).
  Eigen::VectorXd weights_x;
  Eigen::VectorXd weights_y;

  [[nodiscard]] Vec2 midpoint(Eigen::Index ix, Eigen::Index iy) const;
  /// The integral of the density over the field by the quadrature above.
  [[nodiscard]] double integral() const;
};

/// The shape that resolves both the smallest sigma of the map (clusters' narrowest axes, areas' soft edges) and a basis
/// of max_index K: 16 cells a sigma, 10 cells a half wave, between 128 and 1024 cells a side.
[[nodiscard]] GridShape grid_shape(const Field& field, const Importance& importance, int max_index);

/// The importance map (2), restricted to F minus the no-fly polygons and renormalised there as a whole, so that its
/// integral is 1. Empty where nothing is left to look at (no targets, or all their mass but a millionth outside the
/// allowed field). Without targets left, the uniform floor gets all attention, however small its share.
///
/// Each area is spread to unit mass over the field before its weight applies. In a cell that no-fly outlines cross, the
/// density is scaled by the allowed share of the cell's area: exact for each polygon; where several cross one cell
/// their shares are added, which is exact unless they overlap there, and then errs towards forbidden. A soft edge
/// narrower than half a cell is hard.
[[nodiscard]] std::optional<DensityGrid> rasterise(const Field& field, const Importance& importance, GridShape shape);

/// The part of rasterise() that is of protected clusters and areas; its integral is their share of all attention. Empty
/// where nothing is protected, or nothing of it is left.
[[nodiscard]] std::optional<DensityGrid> rasterise_protected(const Field& field, const Importance& importance,
                                                             GridShape shape);

/// The same as rasterise() for a given mixture of Gaussians (weights need not sum to 1), without areas, no-fly polygons
/// or floor. Precondition: as many weights as Gaussians, none negative; covariances positive definite.
[[nodiscard]] std::optional<DensityGrid> rasterise(const Field& field, std::span<const Gaussian> mixture,
                                                   std::span<const double> weights, GridShape shape);

}  // namespace vigil::field
