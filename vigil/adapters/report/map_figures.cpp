#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "vigil/adapters/report/figures.hpp"
#include "vigil/adapters/report/plotting.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

constexpr unsigned kWantedColour = 0xD7263D;
constexpr unsigned kFlownColour = 0x1B5FC1;
constexpr double kMostOpaque = 235.0;  // of 255
constexpr double kOpacityGrowth = 0.75;
constexpr const char* kTargetStyle = "with points pt 6 ps 0.7 lw 1.4 lc rgb '#B0122A'";
constexpr const char* kOutlineStyle = "with lines lw 1.2 dt (6,5) lc rgb '#B0122A'";
constexpr std::size_t kWholeTrajectories = 60;  // drones; with more only the ends of their ways are drawn

/// Panels of the field side by side, all of one size, in pixels.
struct Row {
  int panels = 2;
  double right_px = 16.0;
  double panel_width_px = 0.0;
  double panel_height_px = 0.0;

  static constexpr double kLeft = 66.0;
  static constexpr double kGap = 22.0;
  static constexpr double kTop = 52.0;
  static constexpr double kBottom = 58.0;

  [[nodiscard]] double width_px() const { return kLeft + right_px + panels * panel_width_px + (panels - 1) * kGap; }
  [[nodiscard]] double height_px() const { return kTop + kBottom + panel_height_px; }
  [[nodiscard]] double left(int panel) const { return kLeft + panel * (panel_width_px + kGap); }
  [[nodiscard]] std::string at(int panel) const { return at_px(left(panel), left(panel) + panel_width_px); }
  [[nodiscard]] std::string at_px(double from, double to) const {
    return place(from / width_px(), to / width_px(), kBottom / height_px(), 1.0 - kTop / height_px());
  }
};

Row row_of(const field::Field& field, int panels, double right_px) {
  constexpr double kWidth = 960.0;
  constexpr double kMostHeight = 520.0;
  Row row{panels, right_px, 0.0, 0.0};
  row.panel_width_px = (kWidth - Row::kLeft - right_px - (panels - 1) * Row::kGap) / panels;
  row.panel_height_px = row.panel_width_px * field.length_y / field.length_x;
  if (row.panel_height_px > kMostHeight) {
    row.panel_width_px *= kMostHeight / row.panel_height_px;
    row.panel_height_px = kMostHeight;
  }
  return row;
}

Figure sized(std::string name, const Row& row) {
  return {std::move(name),
          static_cast<int>(std::lround(row.width_px())),
          static_cast<int>(std::lround(row.height_px())),
          {},
          {}};
}

std::string target_points(const FlightData& data) {
  Curve points;
  for (const runtime::ClusterEntry& cluster : data.mission.targets.clusters) {
    for (const Vec2& p : cluster.points_m) points.push_back(runtime::target_in_field(data.mission, p));
  }
  return points.empty() ? "" : block("target_points", points);
}

double opacity(double share) { return kMostOpaque * std::pow(share, kOpacityGrowth); }

/// The outlines of drawn areas, closed, one after the other.
std::string target_outlines(const FlightData& data) {
  Curve outlines;
  for (const runtime::AreaEntry& area : data.mission.targets.areas) {
    const std::vector<Vec2> vertices = runtime::polygon_in_field(data.mission, area.outline_m).vertices;
    if (!outlines.empty()) outlines.push_back(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
    outlines.insert(outlines.end(), vertices.begin(), vertices.end());
    outlines.push_back(vertices.front());
  }
  return outlines.empty() ? "" : block("target_outlines", outlines);
}

std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + ", " + b; }

/// A strip along the canvas' top that holds nothing but the legend; `entries` are plot elements of NaN with titles.
std::string legend(const Row& row, const std::string& entries) {
  if (entries.empty()) return "";
  return fmt::format(
      "{}unset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset y2label\nset size noratio\nset "
      "xrange [0:1]\nset "
      "yrange [0:1]\n"
      "set key at screen {:.4f}, screen 0.995 left top horizontal maxrows 1\nplot {}\nunset key\nset tics nomirror out "
      "scale 0.6\n",
      place(0.02, 0.98, 0.9, 0.99), Row::kLeft / row.width_px(), entries);
}

/// Large fields have small densities: per hectare or square kilometre then.
struct DensityUnit {
  double per_m2 = 1.0;
  const char* name = "1/m²";
};

DensityUnit density_unit(double peak) {
  if (peak >= 1e-2) return {};
  if (peak >= 1e-6) return {1e4, "1/ha"};
  return {1e6, "1/km²"};
}

/// Colours of both maps with one scale of numbers between them.
std::string colour_bar(const Row& row, double peak) {
  const DensityUnit unit = density_unit(peak);
  const double from = row.left(row.panels - 1) + row.panel_width_px + 28.0;
  return fmt::format(
      "{}unset arrow\nunset label\nunset object\nset size noratio\nunset xtics\nunset xlabel\nunset ytics\nset y2tics "
      "out nomirror scale 0.5 format '%g'\n"
      "set xrange [0:2]\nset yrange [0:{:.6g}]\nset y2range [0:{:.6g}]\nset y2label 'density [{}]' offset "
      "-0.6,0\nunset "
      "title\nset samples 2\n"
      "plot $scale using 1:2:($1<1?215:27):($1<1?38:95):($1<1?61:193):3 with rgbalpha notitle\n",
      row.at_px(from, from + 26.0), unit.per_m2 * peak, unit.per_m2 * peak, unit.name);
}

std::string scale_block(double peak) {
  std::string text = "$scale << EOD\n";
  constexpr int kSteps = 64;
  constexpr int kColumns = 16;  // many, so that viewers that smooth pictures keep red and blue apart
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps;
    for (int column = 0; column < kColumns; ++column) {
      text += fmt::format("{:.5g} {:.6g} {:.1f}\n", 2.0 * (column + 0.5) / kColumns, share * peak, opacity(share));
    }
    text += '\n';
  }
  return text + "EOD\n";
}

double peak_of(const CoverageMap& map) {
  const double wanted = map.has_targets() ? map.wanted.maxCoeff() : 0.0;
  const double peak = std::max(wanted, map.flown.maxCoeff());
  return peak > 0.0 ? peak : 1.0;
}

double first_shown_s(const FlightData& data, double to_s) {
  constexpr double kTrail = 0.05;
  return shows_whole_trajectories(data) ? data.time_s(0) : std::max(data.time_s(0), to_s - kTrail * data.end_s());
}

std::string title(const std::string& text) { return fmt::format("set title {} offset 0,-0.5\n", literal(text)); }

}  // namespace

bool shows_whole_trajectories(const FlightData& data) { return data.drones() <= kWholeTrajectories; }

std::vector<double> snapshot_times(const FlightData& data) {
  const ActiveChange* loss = data.first_loss();
  const double duration = data.end_s();
  std::vector<double> times{loss != nullptr ? data.time_s(loss->tick) : 0.2 * duration, duration / 3.0, 0.5 * duration};
  std::sort(times.begin(), times.end());
  return times;
}

Figure density_figure(const FlightData& data, const CoverageMap& map) {
  const Row row = row_of(data.field, 2, 120.0);
  Figure figure = sized("fig5_density", row);
  const double peak = peak_of(map);
  const Trajectories paths = trajectories(data, "path", first_shown_s(data, data.end_s()), data.end_s());
  const std::string targets = target_points(data);
  const std::string outlines = target_outlines(data);
  figure.data = paths.data + targets + outlines + scale_block(density_unit(peak).per_m2 * peak) +
                density_block("flown", map.flown, map);
  std::string wanted;
  if (map.has_targets()) {
    figure.data += density_block("wanted", map.wanted, map);
    figure.commands += contour_commands("wanted", peak);
    wanted = density_plot("wanted", kWantedColour, peak);
  }
  figure.commands +=
      contour_commands("flown", peak) + "set multiplot\n" + panel_style() + row.at(0) + field_axes(data, true);
  figure.commands += title("importance map and trajectories") + paths.labels + "unset key\n";
  figure.commands += fmt::format("plot {}{}{}{}\n", wanted.empty() ? "NaN" : wanted, paths.plot,
                                 targets.empty() ? "" : fmt::format(", $target_points using 1:2 {}", kTargetStyle),
                                 outlines.empty() ? "" : fmt::format(", $target_outlines using 1:2 {}", kOutlineStyle));
  figure.commands += row.at(1) + field_axes(data, false) + title("where the swarm was");
  figure.commands += fmt::format("plot {}\n", density_plot("flown", kFlownColour, peak));
  figure.commands += colour_bar(row, peak);
  const std::string point_entry = targets.empty() ? "" : fmt::format("NaN {} title 'target'", kTargetStyle);
  const std::string area_entry = outlines.empty() ? "" : fmt::format("NaN {} title 'area'", kOutlineStyle);
  figure.commands += legend(row, joined(joined(paths.legend, point_entry), area_entry)) + "unset multiplot\n";
  return figure;
}

Figure snapshot_figure(const FlightData& data, const CoverageMap& map, const std::vector<Eigen::ArrayXXd>& wanted) {
  const std::vector<double> times = snapshot_times(data);
  const Row row = row_of(data.field, static_cast<int>(times.size()), 16.0);
  Figure figure = sized("fig7_snapshots", row);
  std::string entries;
  std::string panels;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string name = fmt::format("snapshot{}", i + 1);
    std::string backdrop = "NaN";
    if (wanted[i].size() > 0) {
      const double peak = wanted[i].maxCoeff();
      figure.data += density_block(name, wanted[i], map);
      figure.commands += contour_commands(name, peak);
      backdrop = density_plot(name, kWantedColour, 1.4 * peak);
    }
    const Trajectories paths = trajectories(data, name + "_path", first_shown_s(data, times[i]), times[i]);
    figure.data += paths.data;
    entries = paths.legend;
    panels += row.at(static_cast<int>(i)) + field_axes(data, i == 0) + paths.labels;
    panels += title(fmt::format("t = {:.7g} s", times[i])) + fmt::format("plot {}{}\n", backdrop, paths.plot);
  }
  figure.commands +=
      "set multiplot\n" + panel_style() + "unset key\n" + panels + legend(row, entries) + "unset multiplot\n";
  return figure;
}

}  // namespace vigil::report
