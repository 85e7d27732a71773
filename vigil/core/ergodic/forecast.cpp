#include "vigil/core/ergodic/forecast.hpp"

#include <cassert>
#include <cmath>

namespace vigil::ergodic {

namespace {

Coefficients weight_of_detail(const Basis& basis) {
  constexpr double kPower = 0.85;  // measured: docs/decisions/0002-look-ahead.md, New targets
  return basis.weight().unaryExpr([](double lambda_k) { return std::pow(lambda_k, kPower); });
}

// The integral over F of |grad f_k|^2 is (k1 pi/L1)^2 + (k2 pi/L2)^2.
double mean_squared_slope(const Basis& basis, const Coefficients& weight) {
  double sum = 0.0;
  for (int k2 = 0; k2 <= basis.max_index(); ++k2) {
    for (int k1 = 0; k1 <= basis.max_index(); ++k1) {
      const double squared = std::pow(basis.wave_numbers_x()[k1], 2) + std::pow(basis.wave_numbers_y()[k2], 2);
      sum += weight(k1, k2) * squared;
    }
  }
  return sum / basis.field().area();
}

}  // namespace

Forecast::Forecast(const Basis& basis, std::size_t drones, int pieces)
    : weight_{basis.weight(), weight_of_detail(basis)},
      mean_squared_slope_{mean_squared_slope(basis, weight_[0]), mean_squared_slope(basis, weight_[1])},
      excess_(static_cast<std::size_t>(pieces), Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())),
      a_k_(excess_.front()) {
  assert(pieces >= 1);
  most_nodes_ = drones * excess_.size();
  midpoints_.reserve(most_nodes_);
  midpoint_slopes_.reserve(most_nodes_);
  ends_.reserve(most_nodes_);
  slopes_.reserve(most_nodes_);
}

void Forecast::run(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
                   const AllowedRegion& region, const Paths& paths) noexcept {
  assert(paths.velocities.size() == paths.starts.size() * excess_.size() && paths.piece_s > 0.0);
  assert(paths.velocities.size() <= most_nodes_);
  drones_ = paths.starts.size();
  midpoints_.resize(paths.velocities.size());  // within their capacity
  midpoint_slopes_.resize(paths.velocities.size());
  ends_.resize(paths.velocities.size());
  slopes_.resize(paths.velocities.size());

  follow(region, paths);
  foresee(kernel, statistics, phi_k, paths.piece_s);
  look_back(kernel, statistics, paths.piece_s);
  moment_s2_ = statistics.gain_s(paths.piece_s, drones_) * paths.piece_s;
  trace_back(2.0 * moment_s2_);
}

void Forecast::follow(const AllowedRegion& region, const Paths& paths) noexcept {
  for (std::size_t i = 0; i < drones_; ++i) {
    Vec2 from = paths.starts[i];
    for (std::size_t j = 0; j < excess_.size(); ++j) {
      const Vec2 to = from + paths.piece_s * paths.velocities[i * excess_.size() + j];
      ends_[j * drones_ + i] = keep_inside(region, to);
      midpoints_[j * drones_ + i] = 0.5 * (from + ends_[j * drones_ + i].point);
      from = ends_[j * drones_ + i].point;
    }
  }
}

void Forecast::foresee(Kernel& kernel, const CoverageStatistics& statistics, const Coefficients& phi_k,
                       double piece_s) noexcept {
  for (std::size_t j = 0; j < excess_.size(); ++j) {
    if (j == 0)
      statistics.excess(phi_k, excess_[0]);
    else
      excess_[j] = excess_[j - 1];
    statistics.foresee(kernel, std::span(midpoints_).subspan(j * drones_, drones_), phi_k, piece_s, excess_[j]);
  }
}

// A midpoint of piece j adds gain f_k to D_j, gain kept f_k to D_(j+1), gain kept^2 f_k to D_(j+2), ...
void Forecast::look_back(Kernel& kernel, const CoverageStatistics& statistics, double piece_s) noexcept {
  a_k_.setZero();
  for (std::size_t j = excess_.size(); j-- > 0;) {
    a_k_ *= statistics.kept(piece_s);
    a_k_ += weight_[emphasis()].cwiseProduct(excess_[j]);
    kernel.gradient(std::span(midpoints_).subspan(j * drones_, drones_), a_k_,
                    std::span(midpoint_slopes_).subspan(j * drones_, drones_));
  }
}

// The velocity of a piece moves its end by piece_s, its midpoint by half of that, and everything after it like its end.
void Forecast::trace_back(double scale) noexcept {
  for (std::size_t i = 0; i < drones_; ++i) {
    Vec2 later = Vec2::Zero();  // dJ by the start of the piece after
    for (std::size_t j = excess_.size(); j-- > 0;) {
      const Vec2 half = 0.5 * midpoint_slopes_[j * drones_ + i];
      const Vec2 by_end = ends_[j * drones_ + i].slide(later + half);
      slopes_[i * excess_.size() + j] = scale * by_end;
      later = by_end + half;
    }
  }
}

// A path of N pieces that moves by v moves the midpoint of piece l by (l + 1/2) piece_s v, and so changes D_j by about
// moment j^2/2 grad f_k . v: the sum of their squares is moment^2 N^5/20 |grad f_k|^2 |v|^2, for N velocities.
double Forecast::curvature() const noexcept {
  const auto pieces = static_cast<double>(excess_.size());
  return std::pow(pieces * pieces * moment_s2_, 2) / 10.0 * mean_squared_slope_[emphasis()];
}

double Forecast::cost() const noexcept {
  double sum = 0.0;
  for (const Coefficients& d_k : excess_) sum += (weight_[emphasis()].array() * d_k.array().square()).sum();
  return sum;
}

}  // namespace vigil::ergodic
