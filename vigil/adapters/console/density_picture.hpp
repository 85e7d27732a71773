#pragma once

#include <string>

#include <Eigen/Core>

#include "vigil/adapters/console/frames.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::console {

/// The density frame of a mission's targets, so many cells along the field's longer side. Some milliseconds.
[[nodiscard]] std::string density_picture(const runtime::Mission& mission, Eigen::Index cells,
                                          const DensityContext& context);

/// Cells of a picture that is shown until targets change.
inline constexpr Eigen::Index kDensityCells = 160;

}  // namespace vigil::console
