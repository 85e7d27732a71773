#include "vigil/adapters/report/coverage_map.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/core/field/density.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

constexpr double kTargetRegion = 0.05;  // of the map's peak: what is below belongs to no target

field::GridShape shape_for(const field::Field& field, double sigma_m) {
  constexpr double kLeast = 144.0;
  constexpr double kMost = 256.0;
  const double longer = std::max(field.length_x, field.length_y);
  const double cells = std::clamp(2.0 * longer / sigma_m, kLeast, kMost);
  const auto along = [&](double length) { return std::max<Index>(8, std::llround(cells * length / longer)); };
  return {along(field.length_x), along(field.length_y)};
}

Index cell_of(double at, double cell, Index cells) {
  return std::clamp<Index>(static_cast<Index>(std::floor(at / cell)), 0, cells - 1);
}

Index mirrored(Index i, Index n) {
  while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
  return i;
}

// Gaussian smoothing down the columns; mass that would leave the grid is mirrored back.
ArrayXXd smoothed_columns(const ArrayXXd& density, double sigma_cells) {
  const auto reach = static_cast<Index>(std::ceil(3.0 * sigma_cells));
  Eigen::ArrayXd kernel(2 * reach + 1);
  for (Index i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) / sigma_cells;
    kernel(i + reach) = std::exp(-0.5 * x * x);
  }
  kernel /= kernel.sum();
  ArrayXXd out = ArrayXXd::Zero(density.rows(), density.cols());
  for (Index ix = 0; ix < density.rows(); ++ix) {
    for (Index i = -reach; i <= reach; ++i) {
      out.row(mirrored(ix + i, density.rows())) += kernel(i + reach) * density.row(ix);
    }
  }
  return out;
}

ArrayXXd smoothed(const ArrayXXd& density, const CoverageMap& map) {
  const ArrayXXd along_x = smoothed_columns(density, map.smoothing_m / map.cell_x_m);
  return smoothed_columns(along_x.transpose(), map.smoothing_m / map.cell_y_m).transpose();
}

/// The active drones' time as a density, each kept tick with a weight.
template <class Weight>
ArrayXXd dwell(const FlightData& data, const CoverageMap& map, Index nx, Index ny, const Weight& weight) {
  ArrayXXd time = ArrayXXd::Zero(nx, ny);
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    const double w = weight(tick);
    if (w <= 0.0) continue;
    for (std::size_t i = 0; i < data.drones(); ++i) {
      const Vec2& p = data.positions[data.flight.row(tick, i)];
      if (!data.flight.is_active(tick, i) || !p.allFinite()) continue;
      time(cell_of(p.x(), map.cell_x_m, nx), cell_of(p.y(), map.cell_y_m, ny)) += w;
    }
  }
  const double total = time.sum() * map.cell_x_m * map.cell_y_m;
  return total > 0.0 ? ArrayXXd(time / total) : time;
}

std::size_t start_of_coverage(const FlightData& data) {
  std::size_t start = 0;
  for (const runtime::LoggedEvent& event : data.flight.events) {
    if (event.what == "start_afresh") start = data.tick_at(event.time_s);
  }
  return start;
}

/// The share of each target's own density in the mixture.
struct Component {
  std::string name;
  ArrayXXd density;
};

std::vector<Component> components_of(const field::Field& field, const field::Importance& importance,
                                     field::GridShape shape) {
  std::vector<Component> components;
  const auto add = [&](const std::string& name, double mass, field::Importance alone) {
    alone.no_fly = importance.no_fly;
    alone.sigma_min_m = importance.sigma_min_m;
    if (const auto grid = field::rasterise(field, alone, shape)) components.push_back({name, mass * grid->values});
  };
  for (const field::Cluster& cluster : importance.clusters) {
    field::Importance alone;
    alone.clusters = {cluster};
    add(cluster.name, static_cast<double>(cluster.targets.size()) * cluster.weight, std::move(alone));
  }
  for (const field::Area& area : importance.areas) {
    field::Importance alone;
    alone.areas = {area};
    add(area.name, area.weight, std::move(alone));
  }
  return components;
}

std::vector<AttentionShare> shares_of(const CoverageMap& map, const std::vector<Component>& components,
                                      const ArrayXXd& time) {
  std::vector<AttentionShare> shares;
  for (const Component& component : components) shares.push_back({component.name, 0.0, 0.0, 0.0});
  shares.push_back({"elsewhere", 0.0, 0.0, 0.0});
  const double least = kTargetRegion * map.wanted.maxCoeff();
  const double cell = map.cell_x_m * map.cell_y_m;
  const double cells = static_cast<double>(map.wanted.size());
  for (Index iy = 0; iy < map.wanted.cols(); ++iy) {
    for (Index ix = 0; ix < map.wanted.rows(); ++ix) {
      std::size_t best = components.size();
      double most = 0.0;
      for (std::size_t c = 0; c < components.size() && map.wanted(ix, iy) >= least; ++c) {
        if (components[c].density(ix, iy) <= most) continue;
        most = components[c].density(ix, iy);
        best = c;
      }
      shares[best].asked += cell * map.wanted(ix, iy);
      shares[best].achieved += cell * time(ix, iy);
      shares[best].area += 1.0 / cells;
    }
  }
  return shares;
}

}  // namespace

double CoverageMap::overlap(const ArrayXXd& a, const ArrayXXd& b) const { return a.min(b).sum() * cell_x_m * cell_y_m; }

ArrayXXd CoverageMap::uniform() const {
  const double cells = static_cast<double>(flown.size());
  return ArrayXXd::Constant(flown.rows(), flown.cols(), 1.0 / (cells * cell_x_m * cell_y_m));
}

CoverageMap coverage_map(const FlightData& data, const field::Importance& importance) {
  CoverageMap map;
  // Smoothing beyond the field's size is uniform already, and its kernel would only take longer and longer.
  map.smoothing_m = std::min(0.5 * importance.sigma_min_m, std::max(data.field.length_x, data.field.length_y));
  const field::GridShape shape = shape_for(data.field, importance.sigma_min_m);
  map.cell_x_m = data.field.length_x / static_cast<double>(shape.nx);
  map.cell_y_m = data.field.length_y / static_cast<double>(shape.ny);

  const std::size_t start = start_of_coverage(data);
  const std::optional<double> memory_s = runtime::memory_s(data.mission);
  const ArrayXXd time = dwell(data, map, shape.nx, shape.ny, [&](std::size_t tick) {
    if (tick < start) return 0.0;
    const double age_s = data.end_s() - data.time_s(tick);
    return data.steps_s[tick] * (memory_s ? std::exp(-age_s / *memory_s) : 1.0);
  });
  map.flown = smoothed(time, map);
  if (const auto grid = field::rasterise(data.field, importance, shape)) {
    map.wanted = grid->values;
    map.wanted_smoothed = smoothed(map.wanted, map);
    map.shares = shares_of(map, components_of(data.field, importance, shape), time);
  }
  return map;
}

ArrayXXd wanted_on_grid(const FlightData& data, const CoverageMap& map, const field::Importance& importance) {
  const auto grid = field::rasterise(data.field, importance, {map.flown.rows(), map.flown.cols()});
  return grid ? grid->values : ArrayXXd();
}

ArrayXXd flown_between(const FlightData& data, const CoverageMap& map, std::size_t from, std::size_t to) {
  const auto weight = [&](std::size_t tick) { return tick >= from && tick < to ? data.steps_s[tick] : 0.0; };
  return smoothed(dwell(data, map, map.flown.rows(), map.flown.cols(), weight), map);
}

}  // namespace vigil::report
