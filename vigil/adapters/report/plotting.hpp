#pragma once

#include <string>
#include <string_view>

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/series.hpp"

/// The parts that the figures share: colours, axes, event marks, maps and trajectories in gnuplot's words.
namespace vigil::report {

inline constexpr const char* kRed = "#D7263D";
inline constexpr const char* kBlue = "#2468CB";
inline constexpr const char* kOrange = "#C8641B";
inline constexpr const char* kGreen = "#12804A";
inline constexpr const char* kViolet = "#8459C9";
inline constexpr const char* kGrey = "#8A8F98";

inline constexpr std::size_t kFewDrones = 12;  ///< up to here each has its name in maps

/// Seconds for short flights, minutes for long ones.
struct TimeUnit {
  double per_s = 1.0;
  const char* name = "s";
};
[[nodiscard]] TimeUnit time_unit(const FlightData& data);

/// A named block of lines "x y"; a break in the curve is an empty line.
[[nodiscard]] std::string block(std::string_view name, const Curve& curve);

/// Grid, tics and font that all panels have.
[[nodiscard]] std::string panel_style();
/// The x axis of time over the whole flight; its numbers and name only for the lowest panel.
[[nodiscard]] std::string time_axis(const FlightData& data, bool is_lowest);
/// A panel's place: fractions of the canvas, y upward.
[[nodiscard]] std::string place(double left, double right, double bottom, double top);
/// A thin dashed line across the panel at each change of the active drones; with what happened above those that have
/// room.
[[nodiscard]] std::string event_marks(const FlightData& data, bool with_labels);
/// Grey background where a drone was not active.
[[nodiscard]] std::string inactive_shade(const FlightData& data, std::size_t drone);

/// Axes of the field, equal scales, and the no-fly outlines.
[[nodiscard]] std::string field_axes(const FlightData& data, bool with_y_numbers);
/// Blocks $name (the grid) and, after contour_commands(), $name_contours.
[[nodiscard]] std::string density_block(std::string_view name, const Eigen::ArrayXXd& density, const CoverageMap& map);
[[nodiscard]] std::string contour_commands(std::string_view name, double peak);
/// Plot elements: the density as a colour (0xRRGGBB) that grows opaque towards `peak`, and its contours.
[[nodiscard]] std::string density_plot(std::string_view name, unsigned colour, double peak);

/// The drones that are not active at a tick: all, or kMostDrawn of them.
[[nodiscard]] std::vector<std::size_t> shown_inactive(const FlightData& data, std::size_t tick);

/// Each drawn drone's way between two times, and its place at the later one: a dot where it is active, a cross where
/// not. Crosses are of shown_inactive().
struct Trajectories {
  std::string data;    ///< blocks, whose names begin with `name`
  std::string plot;    ///< plot elements, each after a comma
  std::string legend;  ///< plot elements of nothing with the drones' names; empty for many drones
  std::string labels;  ///< commands that name the drones where they are; empty for many drones
};
[[nodiscard]] Trajectories trajectories(const FlightData& data, std::string_view name, double from_s, double to_s);

}  // namespace vigil::report
