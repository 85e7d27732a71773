#include "vigil/adapters/report/page_figures.hpp"

#include <fmt/format.h>

#include "vigil/adapters/report/distances.hpp"
#include "vigil/adapters/report/figures.hpp"
#include "vigil/adapters/report/findings.hpp"

namespace vigil::report {
namespace {

const char* path_note(const FlightData& data) {
  return shows_whole_trajectories(data) ? "Greens: each drone's way." : "Greens: the last part of each drone's way.";
}

}  // namespace

std::vector<PageFigure> page_figures(const FlightData& data, const CoverageMap& map) {
  return {
      {"fig4_metric",
       "Fig. 4: the metric in percent of its first value",
       "The same curve twice, so that its small end can be read.",
       {},
       metric_findings(data)},
      {"fig5_density",
       "Fig. 5: where the swarm should be, and where it was",
       fmt::format("Left: the importance map at the end, with targets (circles). {} Right: the active drones' "
                   "time, smoothed with "
                   "sigma = {:.3g} m. One scale for both.",
                   path_note(data), map.smoothing_m),
       {},
       density_findings(map)},
      {"fig6_inputs",
       "Fig. 6: control inputs",
       "Grey: the drone is not active. Dashed: the velocity limit.",
       {},
       input_findings(data)},
      {"fig7_snapshots",
       "Fig. 7: trajectories up to three times",
       fmt::format("Red: the importance map of that time. {} Dots: active drones; crosses: drones that are not active.",
                   path_note(data)),
       {},
       snapshot_findings(data, map)},
      {"fig8_distances",
       "Fig. 8: distances between the drones",
       "Dashed: R_s. Pale: one of the two is not active.",
       {},
       distance_findings(data, closest_to_lost(data))}};
}

}  // namespace vigil::report
