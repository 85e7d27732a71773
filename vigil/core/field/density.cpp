#include "vigil/core/field/density.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "vigil/core/field/gaussian_on_grid.hpp"

namespace vigil::field {
namespace {

constexpr double kCellsPerSigma = 16.0;
constexpr double kCellsPerHalfWave = 10.0;
constexpr double kFewestCells = 128.0;
constexpr double kMostCells = 1024.0;
// The high-order end rule has negative weights: below this many cells a sigma it might see a narrow peak as negative
// mass.
constexpr double kResolvedCellsPerSigma = 6.0;

double smallest_sigma(std::span<const Gaussian> mixture) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Gaussian& gaussian : mixture) smallest = std::min(smallest, narrowest_sigma(gaussian));
  return smallest;
}

// The clusters that count, as Gaussians, and what each weighs.
struct Mixture {
  std::vector<Gaussian> gaussians;
  std::vector<double> weights;
};

Mixture mixture_of(const Importance& importance) {
  Mixture mixture;
  for (const Cluster& cluster : importance.clusters) {
    if (cluster.weight <= 0.0 || cluster.targets.empty()) continue;
    mixture.gaussians.push_back(fit(cluster, importance.sigma_min_m));
    mixture.weights.push_back(static_cast<double>(cluster.targets.size()) * cluster.weight);
  }
  return mixture;
}

Eigen::Index cells(double length, double sigma, int max_index) {
  const double wanted = std::max(kCellsPerSigma * length / sigma, kCellsPerHalfWave * max_index);
  const double allowed = std::clamp(std::ceil(wanted), kFewestCells, kMostCells);
  return 4 * ((static_cast<Eigen::Index>(allowed) + 3) / 4);  // whole columns of vector registers
}

DensityGrid empty_grid(const Field& field, GridShape shape, EndRule rule) {
  assert(shape.nx >= 1 && shape.ny >= 1);
  return {field, Eigen::ArrayXXd::Zero(shape.nx, shape.ny), midpoint_weights(shape.nx, field.length_x, rule),
          midpoint_weights(shape.ny, field.length_y, rule)};
}

bool resolves(const Field& field, GridShape shape, double sigma) {
  const double cell =
      std::max(field.length_x / static_cast<double>(shape.nx), field.length_y / static_cast<double>(shape.ny));
  return sigma >= kResolvedCellsPerSigma * cell;
}

void add_mixture(std::span<const Gaussian> mixture, std::span<const double> weights, DensityGrid& grid) {
  assert(mixture.size() == weights.size());
  for (std::size_t i = 0; i < mixture.size(); ++i) add_gaussian(mixture[i], weights[i], grid);
}

double cell_diagonal(const DensityGrid& grid) {
  return std::hypot(grid.field.length_x / static_cast<double>(grid.values.rows()),
                    grid.field.length_y / static_cast<double>(grid.values.cols()));
}

double half_gaussian(double distance, double sigma) {
  const double z = std::max(distance, 0.0) / sigma;
  return std::exp(-0.5 * z * z);
}

// 1 inside the area, falling off over its soft edge outside.
Eigen::ArrayXXd profile(const Area& area, const DensityGrid& grid) {
  Eigen::ArrayXXd profile = covered_share(area.outline, grid.field, {grid.values.rows(), grid.values.cols()});
  if (area.soft_edge_m < 0.5 * cell_diagonal(grid)) return profile;
  for (Eigen::Index iy = 0; iy < profile.cols(); ++iy) {
    for (Eigen::Index ix = 0; ix < profile.rows(); ++ix) {
      if (profile(ix, iy) == 1.0) continue;  // saves the search for the nearest edge
      profile(ix, iy) = half_gaussian(signed_distance(area.outline, grid.midpoint(ix, iy)), area.soft_edge_m);
    }
  }
  return profile;
}

double integral(const Eigen::ArrayXXd& values, const DensityGrid& grid) {
  return grid.weights_x.dot(values.matrix() * grid.weights_y);
}

void add_area(const Area& area, DensityGrid& grid) {
  const Eigen::ArrayXXd shape = profile(area, grid);
  const double mass = integral(shape, grid);
  if (mass > 0.0) grid.values += (area.weight / mass) * shape;
}

// 1 in cells where drones may fly, 0 in forbidden ones, the allowed share in between.
Eigen::ArrayXXd allowed_share(std::span<const Polygon> no_fly, const DensityGrid& grid) {
  Eigen::ArrayXXd allowed = Eigen::ArrayXXd::Ones(grid.values.rows(), grid.values.cols());
  for (const Polygon& polygon : no_fly) {
    allowed -= covered_share(polygon, grid.field, {grid.values.rows(), grid.values.cols()});
  }
  return allowed.max(0.0);
}

// Scales the values to the given mass; false, and no values at all, where there is next to nothing left of what there
// was: a tail of a millionth is no map.
bool scale_to(double mass, double original_mass, const DensityGrid& grid, Eigen::ArrayXXd& values) {
  constexpr double kNextToNothing = 1e-6;
  const double present = integral(values, grid);
  const bool possible = mass > 0.0 && present > kNextToNothing * original_mass;
  values *= possible ? mass / present : 0.0;
  return possible;
}

double total(std::span<const double> weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

// Clusters and areas, also where nobody may fly; their mass there and outside the field is in `mass`, too.
DensityGrid targets_anywhere(const Field& field, const Importance& importance, GridShape shape, double& mass) {
  const Mixture mixture = mixture_of(importance);
  const bool smooth = importance.areas.empty() && importance.no_fly.empty() &&
                      resolves(field, shape, smallest_sigma(mixture.gaussians));
  DensityGrid grid = empty_grid(field, shape, smooth ? EndRule::kSmooth : EndRule::kKinked);
  mass = total(mixture.weights);
  add_mixture(mixture.gaussians, mixture.weights, grid);
  for (const Area& area : importance.areas) {
    if (area.weight <= 0.0) continue;
    mass += area.weight;
    add_area(area, grid);
  }
  return grid;
}

Importance only_protected(Importance importance) {
  for (Cluster& cluster : importance.clusters) cluster.weight = cluster.is_protected ? cluster.weight : 0.0;
  for (Area& area : importance.areas) area.weight = area.is_protected ? area.weight : 0.0;
  return importance;
}

}  // namespace

Vec2 DensityGrid::midpoint(Eigen::Index ix, Eigen::Index iy) const {
  return {(static_cast<double>(ix) + 0.5) * field.length_x / static_cast<double>(values.rows()),
          (static_cast<double>(iy) + 0.5) * field.length_y / static_cast<double>(values.cols())};
}

double DensityGrid::integral() const { return field::integral(values, *this); }

GridShape grid_shape(const Field& field, const Importance& importance, int max_index) {
  double sigma = smallest_sigma(mixture_of(importance).gaussians);
  for (const Area& area : importance.areas) {
    if (area.weight > 0.0 && area.soft_edge_m > 0.0) sigma = std::min(sigma, area.soft_edge_m);
  }
  return {cells(field.length_x, sigma, max_index), cells(field.length_y, sigma, max_index)};
}

std::optional<DensityGrid> rasterise(const Field& field, const Importance& importance, GridShape shape) {
  double target_mass = 0.0;
  DensityGrid grid = targets_anywhere(field, importance, shape, target_mass);
  Eigen::ArrayXXd floor = allowed_share(importance.no_fly, grid);
  grid.values *= floor;
  const bool has_targets = scale_to(1.0 - importance.uniform_floor, target_mass, grid, grid.values);
  const bool has_floor = scale_to(importance.uniform_floor, field.area(), grid, floor);
  if (!has_targets && !has_floor) return std::nullopt;
  grid.values += floor;
  scale_to(1.0, 1.0, grid, grid.values);  // one part alone gets all attention; of two, only rounding is mended
  return grid;
}

std::optional<DensityGrid> rasterise_protected(const Field& field, const Importance& importance, GridShape shape) {
  const Importance kept = only_protected(importance);
  if (!kept.has_targets() || importance.uniform_floor >= 1.0) return std::nullopt;
  double mass = 0.0;
  double kept_mass = 0.0;
  DensityGrid all = targets_anywhere(field, importance, shape, mass);
  DensityGrid grid = targets_anywhere(field, kept, shape, kept_mass);
  const Eigen::ArrayXXd allowed = allowed_share(importance.no_fly, all);
  all.values *= allowed;
  grid.values *= allowed;
  const double share = (1.0 - importance.uniform_floor) * grid.integral() / all.integral();
  if (!std::isfinite(share) || !scale_to(share, kept_mass, grid, grid.values)) return std::nullopt;
  return grid;
}

std::optional<DensityGrid> rasterise(const Field& field, std::span<const Gaussian> mixture,
                                     std::span<const double> weights, GridShape shape) {
  const bool smooth = resolves(field, shape, smallest_sigma(mixture));
  DensityGrid grid = empty_grid(field, shape, smooth ? EndRule::kSmooth : EndRule::kKinked);
  add_mixture(mixture, weights, grid);
  if (!scale_to(1.0, total(weights), grid, grid.values)) return std::nullopt;
  return grid;
}

}  // namespace vigil::field
