#include "vigil/adapters/report/plotting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "vigil/adapters/report/gnuplot.hpp"
#include "vigil/runtime/chosen_evenly.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

constexpr std::size_t kManyDrones = 100;    // of which dots would hide the ways
constexpr std::size_t kPathPoints = 15000;  // of one map with all its trajectories

struct LineStyle {
  const char* colour;
  double width;
  const char* dash;
};
// Greens that differ in lightness, and in width and dashes for those who cannot tell them apart.
constexpr std::array<LineStyle, 6> kPaths{{{"#148A50", 1.3, "1"},
                                           {"#2FBF71", 1.8, "1"},
                                           {"#6F9E12", 1.3, "(14,5)"},
                                           {"#0E8C8C", 1.3, "(5,4)"},
                                           {"#8BC34A", 1.8, "1"},
                                           {"#4E7D36", 1.3, "(14,4,4,4)"}}};
constexpr const char* kManyPaths = "with lines lw 0.8 lc rgb '#90148A50'";  // half transparent

Curve path_of(const FlightData& data, std::size_t drone, std::size_t from, std::size_t to) {
  Curve path;
  for (std::size_t tick = from; tick <= to; ++tick) path.push_back(data.positions[data.flight.row(tick, drone)]);
  return path;
}

bool is_known(const FlightData& data, std::size_t tick, std::size_t drone) {
  return data.positions[data.flight.row(tick, drone)].allFinite();
}

std::string line(const LineStyle& style) {
  return fmt::format("with lines lw {} lc rgb '{}' dt {}", style.width, style.colour, style.dash);
}

// Those drones that are active, or not, at a tick.
void add_places(Trajectories& out, const FlightData& data, const std::string& name, std::size_t tick, bool active,
                const std::vector<std::size_t>& drones, const std::string& point) {
  Curve places;
  for (const std::size_t i : drones) {
    if (data.flight.is_active(tick, i) == active && is_known(data, tick, i))
      places.push_back(data.positions[data.flight.row(tick, i)]);
  }
  if (places.empty()) return;
  out.data += block(name, places);
  out.plot += fmt::format(", ${} using 1:2 with points {} lc rgb '#000000'", name, point);
}

std::string names_at(const FlightData& data, std::size_t tick) {
  std::string labels;
  for (std::size_t i = 0; i < data.drones() && data.drones() <= kFewDrones; ++i) {
    if (!is_known(data, tick, i)) continue;
    const Vec2& p = data.positions[data.flight.row(tick, i)];
    const bool near_right = p.x() > 0.85 * data.field.length_x;
    labels +=
        fmt::format("set label {} {} at {:.6g},{:.6g} {} offset {},0.5 front\n", i + 1, literal(data.flight.drones[i]),
                    p.x(), p.y(), near_right ? "right" : "left", near_right ? -0.6 : 0.6);
  }
  return labels;
}

std::string outline_object(const runtime::NoFlyEntry& area, const field::WorldFrame& frame) {
  std::string points;
  for (const Vec2& vertex : area.outline_m) {
    const Vec2 p = frame.point_to_field(vertex);
    points += fmt::format("{:.6g},{:.6g} to ", p.x(), p.y());
  }
  const Vec2 first = frame.point_to_field(area.outline_m.front());
  return fmt::format(
      "set object polygon from {}{:.6g},{:.6g} front fillcolor rgb '#555555' fillstyle transparent pattern 4 border "
      "rgb '#555555'\n",
      points, first.x(), first.y());
}

}  // namespace

TimeUnit time_unit(const FlightData& data) {
  constexpr double kLong = 1200.0;
  return data.end_s() > kLong ? TimeUnit{1.0 / 60.0, "min"} : TimeUnit{};
}

std::string block(std::string_view name, const Curve& curve) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const Vec2& p : curve) {
    if (p.allFinite())
      fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n", p.x(), p.y());
    else
      text += '\n';
  }
  return text + "EOD\n";
}

std::string panel_style() {
  return "set border 3 lw 0.8 lc rgb '#000000'\nset tics nomirror out scale 0.6\nset grid lc rgb '#B8BCC4' lw 0.5 dt "
         "(2,3)\n"
         "set key noautotitle samplen 2 spacing 1.1\nset bmargin 0\nset tmargin 0\n";
}

std::string time_axis(const FlightData& data, bool is_lowest) {
  const TimeUnit unit = time_unit(data);
  const double first = unit.per_s * data.time_s(0);
  const double last = std::max(unit.per_s * data.end_s(), first + 1e-3);
  const std::string range = fmt::format("set xrange [{:.9g}:{:.9g}]\n", first, last);
  if (!is_lowest) return range + "set format x ''\nunset xlabel\n";
  return range + fmt::format("set format x '%g'\nset xlabel 't [{}]' offset 0,0.3\n", unit.name);
}

std::string place(double left, double right, double bottom, double top) {
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen {:.4f}\nset tmargin at screen "
      "{:.4f}\n",
      left, right, bottom, top);
}

std::string event_marks(const FlightData& data, bool with_labels) {
  constexpr std::size_t kMostMarks = 40;
  constexpr double kLabelShare = 0.16;  // of the axis: nearer labels would run into each other
  const TimeUnit unit = time_unit(data);
  std::string text = "unset arrow\nunset label\n";
  double next_label_s = data.time_s(0);
  for (std::size_t i = 0; i < std::min(data.changes.size(), kMostMarks); ++i) {
    const double time_s = data.time_s(data.changes[i].tick);
    text +=
        fmt::format("set arrow from {0:.9g}, graph 0 to {0:.9g}, graph 1 nohead front lw 0.9 dt (8,5) lc rgb '{1}'\n",
                    unit.per_s * time_s, kViolet);
    if (!with_labels || time_s < next_label_s) continue;
    next_label_s = time_s + kLabelShare * data.end_s();
    text += fmt::format("set label {} at {:.9g}, graph 1 {} offset 0,0.55 front tc rgb '{}'\n",
                        literal(data.describe(data.changes[i])), unit.per_s * time_s,
                        time_s > 0.85 * data.end_s() ? "right" : "left", kViolet);
  }
  return text;
}

std::string inactive_shade(const FlightData& data, std::size_t drone) {
  const TimeUnit unit = time_unit(data);
  std::string text = "unset object\n";
  std::size_t begin = 0;
  const auto close = [&](std::size_t end, double to_s) {
    if (end <= begin) return;
    text += fmt::format(
        "set object rect from {:.9g}, graph 0 to {:.9g}, graph 1 behind fc rgb '{}' fs transparent solid 0.16 "
        "noborder\n",
        unit.per_s * data.time_s(begin), unit.per_s * to_s, kGrey);
  };
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    if (!data.flight.is_active(tick, drone)) continue;
    close(tick, data.time_s(tick));
    begin = tick + 1;
  }
  close(data.ticks(), data.end_s());
  return text;
}

std::string field_axes(const FlightData& data, bool with_y_numbers) {
  std::string text = fmt::format(
      "unset arrow\nunset label\nunset object\nset border 15 lw 0.8 lc rgb '#000000'\nunset grid\nset size ratio -1\n"
      "set xrange [0:{:.9g}]\nset yrange [0:{:.9g}]\nset format x '%g'\nset xlabel 'x, field frame [m]' offset 0,0.4\n",
      data.field.length_x, data.field.length_y);
  text += with_y_numbers ? "set format y '%g'\nset ylabel 'y, field frame [m]'\n" : "set format y ''\nunset ylabel\n";
  const field::WorldFrame frame = runtime::world_frame(data.mission);
  for (const runtime::NoFlyEntry& area : data.mission.no_fly) text += outline_object(area, frame);
  return text;
}

std::string density_block(std::string_view name, const Eigen::ArrayXXd& density, const CoverageMap& map) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (Eigen::Index iy = 0; iy < density.cols(); ++iy) {
    for (Eigen::Index ix = 0; ix < density.rows(); ++ix) {
      fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g} {:.4g}\n", (static_cast<double>(ix) + 0.5) * map.cell_x_m,
                     (static_cast<double>(iy) + 0.5) * map.cell_y_m, density(ix, iy));
    }
    text += '\n';
  }
  return text + "EOD\n";
}

std::string contour_commands(std::string_view name, double peak) {
  return fmt::format(
      "set contour base\nunset surface\nset cntrparam levels discrete {:.6g},{:.6g},{:.6g}\nset table ${}_contours\n"
      "splot ${} using 1:2:3\nunset table\nunset contour\nset surface\n",
      0.15 * peak, 0.4 * peak, 0.7 * peak, name, name);
}

std::string density_plot(std::string_view name, unsigned colour, double peak) {
  return fmt::format(
      "${0} using 1:2:({1}):({2}):({3}):(235*($3>{4:.6g}?1:($3<0?0:$3/{4:.6g}))**0.75) with rgbalpha, "
      "${0}_contours using 1:2 with lines lw 0.7 lc rgb '#{5:06X}'",
      name, colour >> 16U, (colour >> 8U) & 0xFFU, colour & 0xFFU, peak, colour);
}

std::vector<std::size_t> shown_inactive(const FlightData& data, std::size_t tick) {
  std::vector<std::size_t> inactive;
  for (std::size_t i = 0; i < data.drones(); ++i)
    if (!data.flight.is_active(tick, i)) inactive.push_back(i);
  std::vector<std::size_t> shown;
  for (const std::size_t number : runtime::chosen_evenly(inactive.size(), kMostDrawn))
    shown.push_back(inactive[number]);
  return shown;
}

Trajectories trajectories(const FlightData& data, std::string_view name, double from_s, double to_s) {
  Trajectories out;
  constexpr std::size_t kLeastSteps = 3;  // so that a thinned recording has ways to show, too
  const std::size_t to = data.tick_at(to_s);
  const std::size_t from = std::min(data.tick_at(from_s), to - std::min(to, kLeastSteps));
  const bool few = data.drones() <= kPaths.size();
  const std::size_t points = std::clamp<std::size_t>(kPathPoints / data.drawn.size(), 10, 2500);
  for (const std::size_t i : data.drawn) {
    out.data += block(fmt::format("{}{}", name, i + 1), thinned(path_of(data, i, from, to), points));
    const std::string style = few ? line(kPaths[i]) : kManyPaths;
    out.plot += fmt::format(", ${}{} using 1:2 {}", name, i + 1, style);
    if (few) out.legend += fmt::format("{}NaN {} title {}", i == 0 ? "" : ", ", style, literal(data.flight.drones[i]));
  }
  const double size = data.drones() <= kFewDrones ? 0.9 : data.drones() <= kManyDrones ? 0.45 : 0.3;
  add_places(out, data, fmt::format("{}_on", name), to, true, data.drawn, fmt::format("pt 7 ps {}", size));
  add_places(out, data, fmt::format("{}_off", name), to, false, shown_inactive(data, to),
             fmt::format("pt 2 ps {} lw 2", size + 0.3));
  out.labels = names_at(data, to);
  return out;
}

}  // namespace vigil::report
