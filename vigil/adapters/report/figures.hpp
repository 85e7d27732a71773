#pragma once

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/distances.hpp"
#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/gnuplot.hpp"

/// The paper's figures of one flight. Every curve of data is one plot element; legible and small for any number of
/// drones.
namespace vigil::report {

/// Fig. 4: the metric in percent of its first value, on a linear and on a logarithmic scale.
[[nodiscard]] Figure metric_figure(const FlightData& data);
/// Fig. 5: the importance map with the trajectories, beside the swarm's empirical distribution on the same scale.
[[nodiscard]] Figure density_figure(const FlightData& data, const CoverageMap& map);
/// Fig. 6: what was asked of the drones: both components for up to six of them, the distribution of |u| for more.
[[nodiscard]] Figure input_figure(const FlightData& data);
/// Fig. 7: trajectories up to snapshot_times(), each over the importance map of its time on the map's grid.
[[nodiscard]] Figure snapshot_figure(const FlightData& data, const CoverageMap& map,
                                     const std::vector<Eigen::ArrayXXd>& wanted);
/// Fig. 8: every pair's distance for up to four drones, the distances to nearest neighbours for more, with R_s.
[[nodiscard]] Figure distance_figure(const FlightData& data);

/// The times that Fig. 7 shows, ascending: a drone's loss (or 20 %), 33 % and 50 % of the flight.
[[nodiscard]] std::vector<double> snapshot_times(const FlightData& data);
/// Fig. 7 and Fig. 5 show FlightData::drawn, and only the last part of each drone's way where there are very many.
[[nodiscard]] bool shows_whole_trajectories(const FlightData& data);

/// Fig. 6 has a panel for each drone, with the times shaded at which it is not active.
[[nodiscard]] bool shows_each_input(const FlightData& data);
/// Fig. 8 has a panel for each pair, with a pale line where one of the two is not active.
[[nodiscard]] bool shows_each_pair(const FlightData& data);

}  // namespace vigil::report
