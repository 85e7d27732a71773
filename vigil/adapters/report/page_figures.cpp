#include "vigil/adapters/report/page_figures.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "vigil/adapters/report/distances.hpp"
#include "vigil/adapters/report/figures.hpp"
#include "vigil/adapters/report/findings.hpp"

namespace vigil::report {
namespace {

std::string path_note(const FlightData& data) {
  if (data.draws_all())
    return shows_whole_trajectories(data) ? "Greens: each drone's way." : "Greens: the last part of each drone's way.";
  return fmt::format("Greens: the last part of the ways of {} of the {} drones, evenly chosen.", data.drawn.size(),
                     data.drones());
}

/// Whether some drone is not active at some kept tick.
bool has_inactive(const FlightData& data) {
  return std::any_of(data.flight.rows.activity.begin(), data.flight.rows.activity.end(),
                     [](swarm::Activity activity) { return activity != swarm::Activity::kActive; });
}

std::string input_note(const FlightData& data) {
  const bool has_grey = shows_each_input(data) && has_inactive(data);
  return std::string(has_grey ? "Grey: the drone is not active. " : "") + "Dashed: the velocity limit.";
}

/// How many drones are not active in that of the three maps where it is most.
std::size_t most_inactive(const FlightData& data) {
  std::size_t most = 0;
  for (const double time_s : snapshot_times(data))
    most = std::max(most, data.drones() - data.flight.ticks.active[data.tick_at(time_s)]);
  return most;
}

std::string snapshot_note(const FlightData& data) {
  const std::size_t inactive = most_inactive(data);
  const std::string crosses = inactive == 0 ? "" : "; crosses: drones that are not active";
  const std::string some = inactive > kMostDrawn ? fmt::format(", {} of them at most", kMostDrawn) : "";
  return fmt::format("Red: the importance map of that time. {} Dots: {}active drones{}{}.", path_note(data),
                     data.draws_all() ? "" : "those that are ", crosses, some);
}

std::string distance_note(const FlightData& data) {
  const bool has_pale = shows_each_pair(data) && has_inactive(data);
  return std::string("Dashed: R_s.") + (has_pale ? " Pale: one of the two is not active." : "");
}

}  // namespace

std::vector<PageFigure> page_figures(const FlightData& data, const CoverageMap& map) {
  return {{"fig4_metric",
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
          {"fig6_inputs", "Fig. 6: control inputs", input_note(data), {}, input_findings(data)},
          {"fig7_snapshots",
           "Fig. 7: trajectories up to three times",
           snapshot_note(data),
           {},
           snapshot_findings(data, map)},
          {"fig8_distances",
           "Fig. 8: distances between the drones",
           distance_note(data),
           {},
           distance_findings(data, closest_to_lost(data))}};
}

}  // namespace vigil::report
