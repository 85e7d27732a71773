#include "vigil/core/ergodic/basis.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "vigil/core/ergodic/lanes_code.hpp"

namespace vigil::ergodic {
namespace {

Eigen::VectorXd wave_numbers(int max_index, double length) {
  Eigen::VectorXd result(max_index + 1);
  for (int k = 0; k <= max_index; ++k) result[k] = k * std::numbers::pi / length;
  return result;
}

// Numbers in rows that the vector code reads: each begins where it likes it, and is followed by zeros to whole lanes.
class PaddedRows {
 public:
  PaddedRows(std::size_t rows, std::size_t length)
      : stride_((length + kLanes - 1) / kLanes * kLanes), numbers_(rows * stride_ + kLanesAlignment / sizeof(double)) {
    void* place = numbers_.data();
    std::size_t room = numbers_.size() * sizeof(double);
    first_ = static_cast<double*>(std::align(kLanesAlignment, rows * stride_ * sizeof(double), place, room));
  }
  PaddedRows(const PaddedRows&) = delete;
  PaddedRows& operator=(const PaddedRows&) = delete;

  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] double* row(std::size_t r) { return first_ + r * stride_; }

 private:
  std::size_t stride_;
  std::vector<double> numbers_;
  double* first_;
};

// Row k: cos(k pi (j + 1/2) / n) times the weight of midpoint j, for j = 0..n-1. k (2 j + 1) / (2 n) half turns, of
// which whole turns are taken off without error.
void tabulate_weighted_cosines(const LanesCode& code, const Eigen::VectorXd& weights, std::size_t rows,
                               PaddedRows& table) {
  const auto n = static_cast<std::size_t>(weights.size());
  std::array<double, kLanes> half_turns{};
  std::array<double, kLanes> sine{};
  std::array<double, kLanes> cosine{};
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t first = 0; first < n; first += kLanes) {
      for (std::size_t i = 0; i < kLanes; ++i)
        half_turns[i] = static_cast<double>(k * (2 * (first + i) + 1) % (4 * n)) / static_cast<double>(2 * n);
      code.sine_cosine(half_turns.data(), sine.data(), cosine.data());
      const std::size_t present = std::min(kLanes, n - first);
      for (std::size_t i = 0; i < present; ++i)
        table.row(k)[first + i] = weights[static_cast<Eigen::Index>(first + i)] * cosine[i];
    }
  }
}

}  // namespace

Basis::Basis(const field::Field& field, int max_index, double smoothness)
    : field_(field),
      max_index_(max_index),
      wave_numbers_x_(wave_numbers(max_index, field.length_x)),
      wave_numbers_y_(wave_numbers(max_index, field.length_y)),
      norm_(max_index + 1, max_index + 1),
      weight_(max_index + 1, max_index + 1) {
  assert(field.length_x > 0.0 && field.length_y > 0.0);
  assert(max_index >= 1 && max_index <= kLargestIndex && smoothness > 0.0);
  for (int k1 = 0; k1 <= max_index; ++k1) {
    for (int k2 = 0; k2 <= max_index; ++k2) {
      // (6): the integral of cos^2 over a side is the side's length for index 0, half of it for any other.
      norm_(k1, k2) = std::sqrt(field.area() * (k1 == 0 ? 1.0 : 0.5) * (k2 == 0 ? 1.0 : 0.5));
      weight_(k1, k2) = std::pow(1.0 + k1 * k1 + k2 * k2, -smoothness);
    }
  }
}

Coefficients Basis::evaluate(const Vec2& q) const {
  Coefficients f_k(indices_per_axis(), indices_per_axis());
  for (int k1 = 0; k1 <= max_index_; ++k1) {
    for (int k2 = 0; k2 <= max_index_; ++k2) {
      f_k(k1, k2) =
          std::cos(wave_numbers_x_[k1] * q.x()) * std::cos(wave_numbers_y_[k2] * q.y()) / norm_(k1, k2);  // (5)
    }
  }
  return f_k;
}

// The products are spelt out: a library's would sum in an order that depends on the machine's caches.
Coefficients target_coefficients(const Basis& basis, const field::DensityGrid& density, InstructionSet set) {
  const LanesCode& code = lanes_code(set);
  const auto indices = static_cast<std::size_t>(basis.indices_per_axis());
  const auto nx = static_cast<std::size_t>(density.values.rows());
  const auto ny = static_cast<std::size_t>(density.values.cols());
  PaddedRows cos_x(indices, nx);
  PaddedRows cos_y(indices, ny);
  tabulate_weighted_cosines(code, density.weights_x, indices, cos_x);
  tabulate_weighted_cosines(code, density.weights_y, indices, cos_y);

  // For a few y at a time: the integral over x for every k1.
  constexpr std::size_t kMostAtOnce = 24;
  PaddedRows along_x(indices, ny);
  PaddedRows values(kMostAtOnce, nx);
  for (std::size_t first = 0; first < ny; first += kMostAtOnce) {
    const std::size_t present = std::min(kMostAtOnce, ny - first);
    for (std::size_t c = 0; c < present; ++c)
      std::copy_n(density.values.col(static_cast<Eigen::Index>(first + c)).data(), nx, values.row(c));
    code.row_products({.rows = cos_x.row(0),
                       .columns = values.row(0),
                       .row_count = indices,
                       .column_count = present,
                       .stride = cos_x.stride(),
                       .out = along_x.row(0) + first,
                       .out_row_stride = along_x.stride(),
                       .out_column_stride = 1});
  }

  Coefficients integrals(basis.indices_per_axis(), basis.indices_per_axis());
  code.row_products({.rows = along_x.row(0),
                     .columns = cos_y.row(0),
                     .row_count = indices,
                     .column_count = indices,
                     .stride = along_x.stride(),
                     .out = integrals.data(),
                     .out_row_stride = 1,
                     .out_column_stride = indices});
  return integrals.cwiseQuotient(basis.norm());
}

double ergodic_metric(const Basis& basis, const Coefficients& c_k, const Coefficients& phi_k) noexcept {
  return (basis.weight().array() * (c_k - phi_k).array().square()).sum();  // (4)
}

}  // namespace vigil::ergodic
