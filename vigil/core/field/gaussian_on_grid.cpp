#include "vigil/core/field/gaussian_on_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace vigil::field {
namespace {

/// Farther down than this exponent a Gaussian is not drawn: nine standard deviations.
constexpr double kDeepest = 40.5;
constexpr std::size_t kLanes = 8;

Eigen::ArrayXd midpoints(Eigen::Index n, double length) {
  return (Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) + 0.5) * (length / static_cast<double>(n));
}

double peak_of(const Gaussian& gaussian) {
  return 1.0 / (2.0 * std::numbers::pi * std::sqrt(gaussian.covariance.determinant()));
}

/// Everywhere, and never nothing: also of a peak between two midpoints something is left.
void add_cell_by_cell(const Gaussian& gaussian, double weight, DensityGrid& grid) {
  constexpr double kLowestExponent = -690.0;  // keeps what is nothing anyway from becoming a slow denormal number
  const Eigen::Matrix2d precision = gaussian.covariance.inverse();
  const Eigen::ArrayXd dx = midpoints(grid.values.rows(), grid.field.length_x) - gaussian.mean.x();
  const Eigen::ArrayXd dy = midpoints(grid.values.cols(), grid.field.length_y) - gaussian.mean.y();
  const Eigen::ArrayXd along_x = -0.5 * precision(0, 0) * dx.square();
  for (Eigen::Index iy = 0; iy < dy.size(); ++iy) {
    const double along_y = -0.5 * precision(1, 1) * dy[iy] * dy[iy];
    const double mixed = -precision(0, 1) * dy[iy];
    grid.values.col(iy) += weight * peak_of(gaussian) * (along_x + mixed * dx + along_y).max(kLowestExponent).exp();
  }
}

/// Every cut of a Gaussian along x is the same bell, moved and scaled: exp(-w (i - t)^2 / 2) over the cells i. With
/// i - t = k - f, where f is what t is beyond a whole cell, it is exp(-w k^2 / 2), which is tabulated once, times
/// exp(w f)^k, which is a product more from one cell to the next, times what does not depend on k.
class Bell {
 public:
  /// `w`: in the square of cells; `longest`: the most cells from its middle.
  Bell(double w, Eigen::Index longest) : w_(w), longest_(longest), table_(static_cast<std::size_t>(2 * longest + 1)) {
    for (Eigen::Index k = -longest; k <= longest; ++k)
      table_[static_cast<std::size_t>(k + longest)] = std::exp(-0.5 * w * static_cast<double>(k * k));
  }

  /// cut[i] += height exp(-w (i - t)^2 / 2) for i in [first, last).
  void add(double height, double t, Eigen::Index first, Eigen::Index last, double* cut) const {
    const double middle = std::round(t);
    const double f = t - middle;
    const Eigen::Index k = first - static_cast<Eigen::Index>(middle);
    const double* bell = table_.data() + (k + longest_);
    double power = std::exp(w_ * f * static_cast<double>(k)) * height * std::exp(-0.5 * w_ * f * f);
    const double ratio = std::exp(w_ * f);
    std::array<double, kLanes> powers{};
    for (double& lane : powers) {
      lane = power;
      power *= ratio;
    }
    const double stride = std::pow(ratio, static_cast<double>(kLanes));
    const auto count = static_cast<std::size_t>(last - first);
    double* to = cut + first;
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        to[i + lane] += bell[i + lane] * powers[lane];
        powers[lane] *= stride;
      }
    for (std::size_t lane = 0; i + lane < count; ++lane) to[i + lane] += bell[i + lane] * powers[lane];
  }

 private:
  double w_;
  Eigen::Index longest_;
  std::vector<double> table_;
};

}  // namespace

double narrowest_sigma(const Gaussian& gaussian) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(gaussian.covariance, Eigen::EigenvaluesOnly)
                       .eigenvalues()
                       .minCoeff());
}

void add_gaussian(const Gaussian& gaussian, double weight, DensityGrid& grid) {
  const Eigen::Index nx = grid.values.rows();
  const double cell_x = grid.field.length_x / static_cast<double>(nx);
  const double cell_y = grid.field.length_y / static_cast<double>(grid.values.cols());
  const Eigen::Matrix2d precision = gaussian.covariance.inverse();
  const double w = precision(0, 0) * cell_x * cell_x;
  const double reach = std::sqrt(2.0 * kDeepest / w);  // cells
  // A table much wider than the field would cost more than it saves, and a mean far outside is no whole number of
  // cells.
  const bool is_wide = reach > 8.0 * static_cast<double>(nx);
  if (is_wide || narrowest_sigma(gaussian) < std::max(cell_x, cell_y)) return add_cell_by_cell(gaussian, weight, grid);

  const double slope = precision(0, 1) / precision(0, 0);
  const double across = precision(1, 1) - precision(0, 1) * slope;
  const double height = weight * peak_of(gaussian);
  const Bell bell(w, static_cast<Eigen::Index>(reach) + 2);
  for (Eigen::Index iy = 0; iy < grid.values.cols(); ++iy) {
    const double dy = (static_cast<double>(iy) + 0.5) * cell_y - gaussian.mean.y();
    const double exponent = 0.5 * across * dy * dy;
    const double half = std::sqrt(std::max(0.0, 2.0 * (kDeepest - exponent) / w));
    const double t = (gaussian.mean.x() - slope * dy) / cell_x - 0.5;
    const double first = std::max(0.0, std::ceil(t - half));
    const double last = std::min(static_cast<double>(nx), std::floor(t + half) + 1.0);
    if (exponent >= kDeepest || first >= last) continue;
    bell.add(height * std::exp(-exponent), t, static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(last),
             grid.values.col(iy).data());
  }
}

}  // namespace vigil::field
