#include "vigil/adapters/report/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vigil::report {
namespace {

void add_stretch(Curve& curve, std::span<const double> times, std::span<const double> values) {
  const auto less = [](double a, double b) { return a < b; };
  const auto index = [&](auto at) { return static_cast<std::size_t>(at - values.begin()); };
  std::array<std::size_t, 4> keep{0, index(std::min_element(values.begin(), values.end(), less)),
                                  index(std::max_element(values.begin(), values.end(), less)), values.size() - 1};
  std::sort(keep.begin(), keep.end());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (i == 0 || keep[i] != keep[i - 1]) curve.emplace_back(times[keep[i]], values[keep[i]]);
  }
}

double length_of(const Curve& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = (path[i] - path[i - 1]).norm();
    if (std::isfinite(step)) length += step;
  }
  return length;
}

Curve with_step(const Curve& path, double step) {
  Curve kept;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool is_break = !path[i].allFinite();
    const bool follows_break = kept.empty() || !kept.back().allFinite();
    if (is_break ? !follows_break : (follows_break || i + 1 == path.size() || (path[i] - kept.back()).norm() >= step)) {
      kept.push_back(path[i]);
    }
  }
  return kept;
}

}  // namespace

Curve envelope(std::span<const double> times, std::span<const double> values, std::size_t pieces) {
  Curve curve;
  const std::size_t n = values.size();
  pieces = std::min(pieces, n);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t from = n * piece / pieces;
    const std::size_t to = n * (piece + 1) / pieces;
    add_stretch(curve, times.subspan(from, to - from), values.subspan(from, to - from));
  }
  return curve;
}

Curve thinned(const Curve& path, std::size_t points) {
  double step = length_of(path) / static_cast<double>(std::max<std::size_t>(points, 1));
  Curve kept = with_step(path, 0.0);
  while (kept.size() > points && step > 0.0) {
    kept = with_step(path, step);
    step *= 1.5;
  }
  return kept;
}

}  // namespace vigil::report
