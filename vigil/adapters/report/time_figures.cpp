#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "vigil/adapters/report/figures.hpp"
#include "vigil/adapters/report/plotting.hpp"

namespace vigil::report {
namespace {

constexpr std::size_t kPieces = 500;  // of a curve over time: about one a pixel
constexpr std::size_t kMostInputPanels = 6;
constexpr std::size_t kMostPairDrones = 4;
constexpr const char* kPale = "#80888C94";  // half transparent: pale on white and on black
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> plotted_times(const FlightData& data) {
  std::vector<double> times = data.flight.ticks.time_s;
  for (double& t : times) t *= time_unit(data).per_s;
  return times;
}

/// Stretches of values that are finite, each with its own envelope, with breaks between them.
Curve curve_of(std::span<const double> times, std::span<const double> values) {
  Curve curve;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= values.size(); ++i) {
    if (i < values.size() && std::isfinite(values[i])) continue;
    if (i > begin) {
      const std::size_t n = i - begin;
      const Curve piece = envelope(times.subspan(begin, n), values.subspan(begin, n),
                                   std::max<std::size_t>(1, kPieces * n / values.size()));
      if (!curve.empty()) curve.emplace_back(kNaN, kNaN);
      curve.insert(curve.end(), piece.begin(), piece.end());
    }
    begin = i + 1;
  }
  return curve;
}

/// Panels one above the other, in fractions of a canvas of height_px, the first at the top.
struct Stack {
  std::size_t panels = 1;
  double panel_px = 120.0;
  double gap_px = 22.0;

  static constexpr double kTop = 44.0;
  static constexpr double kBottom = 54.0;

  [[nodiscard]] int height_px() const {
    const double n = static_cast<double>(panels);
    return static_cast<int>(kTop + kBottom + n * panel_px + (n - 1.0) * gap_px);
  }
  [[nodiscard]] std::string at(std::size_t panel, double left, double right) const {
    const double top = 1.0 - (kTop + static_cast<double>(panel) * (panel_px + gap_px)) / height_px();
    return place(left, right, top - panel_px / height_px(), top);
  }
};

constexpr double kLeft = 0.10;
constexpr double kRight = 0.975;

std::string empty_figure(const std::string& text) {
  return fmt::format(
      "unset border\nunset tics\nset label {} at graph 0.5, graph 0.5 center\nplot [0:1][0:1] NaN notitle\n",
      literal(text));
}

// Fig. 6 for few drones: one panel each.
Figure input_panels(const FlightData& data, Figure figure) {
  const Stack stack{data.drones(), 118.0, 20.0};
  figure.height_px = stack.height_px();
  const std::vector<double> times = plotted_times(data);
  const double limit = data.mission.control.speed_limit_m_s;
  figure.commands = "set multiplot\n" + panel_style();
  for (std::size_t i = 0; i < data.drones(); ++i) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
      const bool is_steered = data.flight.rows.action[data.flight.row(tick, i)] == swarm::Action::kVelocity;
      const Vec2& u = data.commands[data.flight.row(tick, i)];
      x.push_back(is_steered ? u.x() : kNaN);
      y.push_back(is_steered ? u.y() : kNaN);
    }
    figure.data += block(fmt::format("input_x{}", i + 1), curve_of(times, x)) +
                   block(fmt::format("input_y{}", i + 1), curve_of(times, y));
    figure.commands += stack.at(i, kLeft, kRight) + time_axis(data, i + 1 == data.drones()) + inactive_shade(data, i) +
                       event_marks(data, i == 0);
    figure.commands +=
        fmt::format("set yrange [{:.6g}:{:.6g}]\nset ytics {:.6g}\nset ylabel {} offset 0.5,0\n", -1.25 * limit,
                    1.25 * limit, limit, literal(fmt::format("{}  u [m/s]", data.flight.drones[i])));
    figure.commands += i == 0 ? "set key at screen 0.975, screen 0.995 right top horizontal\n" : "unset key\n";
    figure.commands += fmt::format(
        "plot $input_x{0} using 1:2 with lines lw 0.9 lc rgb '{1}' title 'along x', $input_y{0} using 1:2 with lines "
        "lw "
        "0.9 lc rgb '{2}' title 'along y', "
        "{3:.6g} with lines dt (10,6) lw 1.3 lc rgb '{4}' title 'limit', {5:.6g} with lines dt (10,6) lw 1.3 lc rgb "
        "'{4}' notitle\n",
        i + 1, kBlue, kOrange, limit, kRed, -limit);
  }
  figure.commands += "unset multiplot\n";
  return figure;
}

/// |u| of the active drones at one tick, ascending.
std::vector<double> active_speeds(const FlightData& data, std::size_t tick) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < data.drones(); ++i) {
    const double speed = data.commands[data.flight.row(tick, i)].norm();
    if (data.flight.is_active(tick, i) && std::isfinite(speed)) speeds.push_back(speed);
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

// Fig. 6 for many drones: how |u| is distributed over the active ones.
Figure input_distribution(const FlightData& data, Figure figure) {
  const Stack stack{1, 260.0};
  figure.height_px = stack.height_px();
  const double limit = data.mission.control.speed_limit_m_s;
  const std::vector<double> times = plotted_times(data);
  std::vector<double> most(data.ticks(), kNaN);
  std::string band = "$input_band << EOD\n";
  const std::size_t stride = std::max<std::size_t>(1, data.ticks() / kPieces);
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    const std::vector<double> speeds = active_speeds(data, tick);
    if (speeds.empty()) continue;
    most[tick] = speeds.back();
    if (tick % stride == 0) {
      band += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", times[tick], quantile(speeds, 0.1), quantile(speeds, 0.5),
                          quantile(speeds, 0.9));
    }
  }
  figure.data = band + "EOD\n" + block("input_most", curve_of(times, most));
  figure.commands = panel_style() + stack.at(0, kLeft, kRight) + time_axis(data, true) + event_marks(data, true);
  figure.commands += fmt::format(
      "set yrange [0:{0:.6g}]\nset ylabel '|u| of active drones [m/s]'\nset key at screen 0.975, screen 0.995 right "
      "top horizontal\n"
      "plot $input_band using 1:2:4 with filledcurves fc rgb '{1}' fs transparent solid 0.25 title '10 to 90 %', "
      "$input_band using 1:3 with lines lw 1.4 lc rgb '{1}' title 'median', $input_most using 1:2 with lines lw 0.9 lc "
      "rgb '{2}' title 'fastest', "
      "{3:.6g} with lines dt (10,6) lw 1.3 lc rgb '{4}' title 'limit'\n",
      1.2 * limit, kBlue, kOrange, limit, kRed);
  return figure;
}

/// A pair's distance, where both are active and where not.
struct PairCurves {
  std::vector<double> active;
  std::vector<double> other;
};

PairCurves pair_curves(const FlightData& data, std::size_t a, std::size_t b) {
  PairCurves curves;
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    const bool both = data.flight.is_active(tick, a) && data.flight.is_active(tick, b);
    const double d = distance_m(data, tick, a, b);
    curves.active.push_back(both ? d : kNaN);
    curves.other.push_back(both ? kNaN : d);
  }
  return curves;
}

/// A round step that divides a length into about four.
double round_step(double length) {
  const double raw = length / 4.0;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / decade;
  return decade * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

/// One scale for all pairs.
std::string pair_axis(const FlightData& data) {
  double most = data.mission.safety.separation_m;
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    for (std::size_t a = 0; a < data.drones(); ++a) {
      for (std::size_t b = a + 1; b < data.drones(); ++b) most = std::fmax(most, distance_m(data, tick, a, b));
    }
  }
  return fmt::format("set yrange [0:{:.6g}]\nset ytics {:.6g}\n", 1.05 * most, round_step(most));
}

// Fig. 8 for few drones: one panel a pair.
Figure pair_panels(const FlightData& data, Figure figure) {
  const std::size_t pairs = data.drones() * (data.drones() - 1) / 2;
  const Stack stack{pairs, pairs > 3 ? 92.0 : 118.0, 20.0};
  figure.height_px = stack.height_px();
  const std::vector<double> times = plotted_times(data);
  const double bound = data.mission.safety.separation_m;
  figure.commands = "set multiplot\n" + panel_style() + pair_axis(data);
  std::size_t panel = 0;
  for (std::size_t a = 0; a < data.drones(); ++a) {
    for (std::size_t b = a + 1; b < data.drones(); ++b, ++panel) {
      const PairCurves curves = pair_curves(data, a, b);
      const std::string name = fmt::format("pair_{}_{}", a + 1, b + 1);
      const Curve other = curve_of(times, curves.other);
      figure.data += block(name, curve_of(times, curves.active)) + block(name + "_off", other);
      figure.commands +=
          stack.at(panel, kLeft, kRight) + time_axis(data, panel + 1 == pairs) + event_marks(data, panel == 0);
      figure.commands += fmt::format("set ylabel {} offset 0.5,0\n",
                                     literal(fmt::format("{}, {}  [m]", data.flight.drones[a], data.flight.drones[b])));
      figure.commands += panel == 0 ? "set key at screen 0.975, screen 0.995 right top horizontal\n" : "unset key\n";
      figure.commands +=
          fmt::format("plot ${} using 1:2 with lines lw 1.4 lc rgb '{}' title 'both active', ", name, kGreen);
      // The legend names the dimmed line once, in whatever panel it is, where there is one at all.
      figure.commands +=
          other.empty() && data.changes.empty() ? ""
          : other.empty()
              ? fmt::format("NaN with lines lw 1.4 lc rgb '{}' title 'not both active', ", kPale)
              : fmt::format("${}_off using 1:2 with lines lw 1.4 lc rgb '{}' title 'not both active', ", name, kPale);
      figure.commands += fmt::format("{:.6g} with lines dt (10,6) lw 1.3 lc rgb '{}' title 'R_s'\n", bound, kRed);
    }
  }
  figure.commands += "unset multiplot\n";
  return figure;
}

// Fig. 8 for many drones: the nearest pair at every tick, and how far nearest neighbours are.
Figure nearest_panel(const FlightData& data, Figure figure) {
  const Stack stack{1, 260.0};
  figure.height_px = stack.height_px();
  const std::vector<double> times = plotted_times(data);
  std::vector<double> least;
  for (const runtime::Clearances& clearances : data.flight.ticks.clearances) least.push_back(clearances.active_pair_m);
  std::string band = "$nearest_band << EOD\n";
  double most = data.mission.safety.separation_m;
  for (const NearestDistances& d : nearest_distances(data)) {
    most = std::max(most, d.high_m);
    band += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", times[d.tick], d.low_m, d.median_m, d.high_m);
  }
  figure.data = band + "EOD\n" + block("nearest_pair", curve_of(times, least));
  figure.commands = panel_style() + stack.at(0, kLeft, kRight) + time_axis(data, true) + event_marks(data, true);
  figure.commands += fmt::format(
      "set yrange [0:{4:.6g}]\nset ylabel 'to nearest active drone [m]'\nset key at screen 0.975, screen 0.995 right "
      "top "
      "horizontal\n"
      "plot $nearest_band using 1:2:4 with filledcurves fc rgb '{0}' fs transparent solid 0.25 title '10 to 90 %', "
      "$nearest_band using 1:3 with lines lw 1.2 lc rgb '{0}' title 'median', "
      "$nearest_pair using 1:2 with lines lw 1.2 lc rgb '{1}' title 'least', {2:.6g} with lines dt (10,6) lw "
      "1.3 "
      "lc rgb '{3}' title 'R_s'\n",
      kGreen, kBlue, data.mission.safety.separation_m, kRed, 1.1 * most);
  return figure;
}

}  // namespace

Figure metric_figure(const FlightData& data) {
  const Stack stack{2, 165.0, 26.0};
  Figure figure{"fig4_metric", 800, stack.height_px(), {}, {}};
  const std::vector<double>& percent = data.flight.ticks.metric_percent;
  const Curve curve = curve_of(plotted_times(data), percent);
  if (curve.empty()) {
    figure.commands = empty_figure("no drone covered anything: there is no metric");
    return figure;
  }
  const bool has_logarithm = std::any_of(percent.begin(), percent.end(), [](double p) { return p > 0.0; });
  figure.data = block("metric", curve);
  figure.commands =
      "set multiplot\n" + panel_style() + stack.at(0, kLeft, kRight) + time_axis(data, false) + event_marks(data, true);
  figure.commands += fmt::format(
      "set yrange [0:*]\nset ylabel 'metric [%]'\nplot $metric using 1:2 with lines lw 1.6 lc rgb '{}'\n", kBlue);
  figure.commands += stack.at(1, kLeft, kRight) + time_axis(data, true) + event_marks(data, false);
  figure.commands += has_logarithm ? "set logscale y\nset yrange [*:*]\nset format y '%g'\nset mytics 10\n" : "";
  figure.commands += fmt::format(
      "set ylabel 'metric [%], {}'\nplot $metric using 1:2 with lines lw 1.4 lc rgb '{}'\nunset multiplot\n",
      has_logarithm ? "log scale" : "same", kBlue);
  return figure;
}

bool shows_each_input(const FlightData& data) { return data.drones() <= kMostInputPanels; }

bool shows_each_pair(const FlightData& data) { return data.drones() >= 2 && data.drones() <= kMostPairDrones; }

Figure input_figure(const FlightData& data) {
  Figure figure{"fig6_inputs", 800, 0, {}, {}};
  return shows_each_input(data) ? input_panels(data, std::move(figure)) : input_distribution(data, std::move(figure));
}

Figure distance_figure(const FlightData& data) {
  Figure figure{"fig8_distances", 800, 120, {}, {}};
  if (data.drones() < 2) {
    figure.commands = empty_figure("one drone has no distance to another");
    return figure;
  }
  return shows_each_pair(data) ? pair_panels(data, std::move(figure)) : nearest_panel(data, std::move(figure));
}

}  // namespace vigil::report
