#pragma once

#include "vigil/core/field/density.hpp"
#include "vigil/core/field/importance.hpp"

namespace vigil::field {

/// values += weight times the Gaussian (1), at the midpoints of all cells. What is farther from its mean than nine
/// standard deviations, less than 3e-18 of its peak, is left out where its narrowest sigma is at least a cell. Relative
/// error of the rest at most 1e-13. Precondition: covariance positive definite, weight >= 0.
void add_gaussian(const Gaussian& gaussian, double weight, DensityGrid& grid);

/// The least standard deviation, along whichever axis.
[[nodiscard]] double narrowest_sigma(const Gaussian& gaussian);

}  // namespace vigil::field
