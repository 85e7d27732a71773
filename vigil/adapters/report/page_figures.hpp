#pragma once

#include <vector>

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/page.hpp"

namespace vigil::report {

/// Figures 4 to 8 with their titles, notes and findings; their drawings (svg) are empty.
[[nodiscard]] std::vector<PageFigure> page_figures(const FlightData& data, const CoverageMap& map);

}  // namespace vigil::report
