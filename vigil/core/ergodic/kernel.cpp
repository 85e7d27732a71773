#include "vigil/core/ergodic/kernel.hpp"

#include <cassert>
#include <memory>

namespace vigil::ergodic {
namespace {

static_assert(sizeof(Vec2) == 2 * sizeof(double), "the vector code reads x and y of one drone after the other");

constexpr std::size_t kSlack = kLanesAlignment / sizeof(double);

const double* coordinates(std::span<const Vec2> points) noexcept {
  return points.empty() ? nullptr : points.front().data();
}

}  // namespace

Kernel::Kernel(const Basis& basis, InstructionSet set)
    : code_(&lanes_code(set)),
      field_(basis.field()),
      wave_numbers_x_(basis.wave_numbers_x()),
      wave_numbers_y_(basis.wave_numbers_y()),
      inverse_norm_(basis.norm().cwiseInverse()),
      scaled_a_(basis.indices_per_axis(), basis.indices_per_axis()),
      work_(lanes_work_size(static_cast<std::size_t>(basis.indices_per_axis())) + kSlack) {}

BasisNumbers Kernel::numbers() noexcept {
  void* work = work_.data();
  std::size_t room = work_.size() * sizeof(double);
  std::align(kLanesAlignment, room - kLanesAlignment, work, room);
  return {.indices = static_cast<std::size_t>(inverse_norm_.rows()),
          .length_x = field_.length_x,
          .length_y = field_.length_y,
          .wave_numbers_x = wave_numbers_x_.data(),
          .wave_numbers_y = wave_numbers_y_.data(),
          .inverse_norm = inverse_norm_.data(),
          .work = static_cast<double*>(work)};
}

void Kernel::add_basis(std::span<const Vec2> positions, std::span<const double> weights, Coefficients& sum_k) noexcept {
  assert(positions.size() == weights.size());
  assert(sum_k.rows() == inverse_norm_.rows() && sum_k.cols() == inverse_norm_.cols());
  code_->add_basis(numbers(), coordinates(positions), weights.data(), positions.size(), sum_k.data());
}

void Kernel::gradient(std::span<const Vec2> positions, const Coefficients& a_k, std::span<Vec2> out) noexcept {
  assert(positions.size() == out.size());
  assert(a_k.rows() == inverse_norm_.rows() && a_k.cols() == inverse_norm_.cols());
  if (positions.empty()) return;
  scaled_a_ = a_k.cwiseProduct(inverse_norm_);
  code_->gradient(numbers(), coordinates(positions), positions.size(), scaled_a_.data(), out.front().data());
}

}  // namespace vigil::ergodic
