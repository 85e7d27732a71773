#pragma once

#include <string>
#include <vector>

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/distances.hpp"
#include "vigil/adapters/report/flight_data.hpp"

namespace vigil::report {

/// What a recording says of a claim.
enum class Verdict {
  kHolds,
  kDiffers,
  kNotTested  ///< nothing in this flight could show it
};

/// Whose words a claim is.
enum class Source {
  kPaper,
  kMission  ///< the mission asks for it, or safety does; the paper does not speak of it
};

/// One claim, held against one recording.
struct Finding {
  std::string claim;     ///< in our own words
  std::string measured;  ///< in this recording's numbers, with the bound that decides
  Verdict verdict = Verdict::kNotTested;
  Source source = Source::kPaper;
};

/// Fig. 4: the metric goes to (nearly) zero, also after a drone is lost.
[[nodiscard]] std::vector<Finding> metric_findings(const FlightData& data);
/// Fig. 5: the swarm's time is spread as the map asks.
[[nodiscard]] std::vector<Finding> density_findings(const CoverageMap& map);
/// Fig. 6: velocities within the limit; the survivors go on.
[[nodiscard]] std::vector<Finding> input_findings(const FlightData& data);
/// Fig. 7: the swarm goes where the targets are and keeps away from the border.
[[nodiscard]] std::vector<Finding> snapshot_findings(const FlightData& data, const CoverageMap& map);
/// Fig. 8: active drones keep R_s, and so must all that are in the air; lost ones that are down may be passed closer.
[[nodiscard]] std::vector<Finding> distance_findings(const FlightData& data, const ClosestToLost& closest);

/// Which accounting was used, what it means and, for (14) as printed, what it did here. One paragraph each.
[[nodiscard]] std::vector<std::string> accounting_notes(const FlightData& data, const CoverageMap& map);

}  // namespace vigil::report
