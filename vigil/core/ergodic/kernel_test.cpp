#include "vigil/core/ergodic/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vigil/core/ergodic/literal_kernel.hpp"

namespace vigil::ergodic {
namespace {

constexpr field::Field kField{.length_x = 3.0, .length_y = 2.0};

// In units of a side: from a tenth outside one border to a tenth outside the other, both borders among them.
double side() {
  return *rc::gen::weightedOneOf<int>({{8, rc::gen::inRange(-100, 1101)}, {1, rc::gen::element(0, 1000)}}) * 1e-3;
}

std::vector<Vec2> any_positions(std::size_t at_most) {
  const auto count = *rc::gen::inRange<std::size_t>(0, at_most);
  std::vector<Vec2> positions;
  for (std::size_t i = 0; i < count; ++i) positions.emplace_back(kField.length_x * side(), kField.length_y * side());
  return positions;
}

Coefficients any_coefficients(const Basis& basis) {
  Coefficients a_k(basis.indices_per_axis(), basis.indices_per_axis());
  for (double& a : a_k.reshaped()) a = *rc::gen::inRange(-1000, 1001) * 1e-3;
  return a_k;
}

// Of what every instruction set of this machine computes: the first's answer, if it is everybody's to the last bit.
Coefficients sums_of_all_sets(const Basis& basis, std::span<const Vec2> positions, std::span<const double> weights,
                              const Coefficients& before) {
  Coefficients sums = before;
  Kernel(basis, InstructionSet::kPortable).add_basis(positions, weights, sums);
  for (const InstructionSet set : instruction_sets()) {
    Coefficients others = before;
    Kernel(basis, set).add_basis(positions, weights, others);
    RC_ASSERT(others == sums);
  }
  return sums;
}

std::vector<Vec2> gradients_of_all_sets(const Basis& basis, std::span<const Vec2> positions, const Coefficients& a_k) {
  std::vector<Vec2> b(positions.size());
  Kernel(basis, InstructionSet::kPortable).gradient(positions, a_k, b);
  for (const InstructionSet set : instruction_sets()) {
    std::vector<Vec2> others(positions.size());
    Kernel(basis, set).gradient(positions, a_k, others);
    RC_ASSERT(others == b);
  }
  return b;
}

double potential(const Basis& basis, const Coefficients& a_k, const Vec2& p) {
  return (a_k.array() * basis.evaluate(p).array()).sum();
}

RC_GTEST_PROP(KernelTest, Sums_are_those_of_the_literal_kernel_and_the_same_with_every_instruction_set, ()) {
  const Basis basis(kField, *rc::gen::element(1, 2, 7, 10, 13, 20, 64), 1.5);
  const std::vector<Vec2> positions = any_positions(300);
  std::vector<double> weights;
  for (std::size_t i = 0; i < positions.size(); ++i) weights.push_back(*rc::gen::inRange(1, 1001) * 1e-3);
  Coefficients literal = Coefficients::Ones(basis.indices_per_axis(), basis.indices_per_axis());
  const Coefficients fast = sums_of_all_sets(basis, positions, weights, literal);
  add_basis_literally(basis, positions, weights, literal);
  RC_ASSERT((fast - literal).cwiseAbs().maxCoeff() <= 1e-12 * literal.cwiseAbs().maxCoeff());
}

RC_GTEST_PROP(KernelTest, Gradients_are_those_of_the_literal_kernel_and_the_same_with_every_instruction_set, ()) {
  const Basis basis(kField, *rc::gen::element(1, 2, 7, 10, 13, 20, 64), 1.5);
  const std::vector<Vec2> positions = any_positions(20);
  const Coefficients a_k = any_coefficients(basis);
  const std::vector<Vec2> fast = gradients_of_all_sets(basis, positions, a_k);
  std::vector<Vec2> literal(positions.size());
  gradient_literally(basis, positions, a_k, literal);
  // Relative to the gradients that these coefficients can have: near a stationary point the terms cancel.
  const double scale = a_k.norm() * basis.wave_numbers_y()[basis.max_index()] / basis.norm()(1, 1);
  for (std::size_t i = 0; i < positions.size(); ++i) RC_ASSERT((fast[i] - literal[i]).norm() <= 1e-12 * scale);
}

RC_GTEST_PROP(KernelTest, The_gradient_is_the_slope_of_the_potential, ()) {
  const Basis basis(kField, 7, 1.5);
  const std::vector<Vec2> positions{{kField.length_x * side(), kField.length_y * side()}};
  const Coefficients a_k = any_coefficients(basis);
  std::vector<Vec2> b(1);
  Kernel(basis).gradient(positions, a_k, b);
  for (const Vec2& axis : {Vec2(1.0, 0.0), Vec2(0.0, 1.0)}) {
    const Vec2 step = 1e-5 * axis;
    const double rise = potential(basis, a_k, positions[0] + step) - potential(basis, a_k, positions[0] - step);
    RC_ASSERT(std::abs(rise / 2e-5 - b[0].dot(axis)) < 2e-6);
  }
}

RC_GTEST_PROP(KernelTest, A_drone_s_gradient_does_not_depend_on_the_others_to_the_last_bit, ()) {
  const Basis basis(kField, 10, 1.5);
  const std::vector<Vec2> positions = any_positions(20);
  const Coefficients a_k = any_coefficients(basis);
  Kernel kernel(basis);
  std::vector<Vec2> together(positions.size());
  kernel.gradient(positions, a_k, together);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Vec2 alone;
    kernel.gradient(std::span(positions).subspan(i, 1), a_k, std::span(&alone, 1));
    RC_ASSERT(alone == together[i]);
  }
}

RC_GTEST_PROP(KernelTest, The_place_of_the_data_in_memory_does_not_matter_to_the_last_bit, ()) {
  const Basis basis(kField, 10, 1.5);
  const std::vector<Vec2> positions = any_positions(20);
  const std::vector<double> weights(positions.size(), 0.02);
  // A double further on: no longer on a 16-byte boundary.
  std::vector<double> shifted_weights(weights.size() + 1, 0.02);
  Kernel kernel(basis);
  Coefficients sum = Coefficients::Zero(11, 11);
  Coefficients shifted = Coefficients::Zero(11, 11);
  kernel.add_basis(positions, weights, sum);
  kernel.add_basis(positions, std::span(shifted_weights).subspan(1), shifted);
  RC_ASSERT(sum == shifted);
}

RC_GTEST_PROP(KernelTest, Portions_added_in_order_give_the_sums_of_one_call_to_the_last_bit, ()) {
  const Basis basis(kField, 10, 1.5);
  const std::vector<Vec2> positions = any_positions(500);
  const std::vector<double> weights(positions.size(), 0.02);
  Kernel kernel(basis);
  Coefficients sum = Coefficients::Zero(11, 11);
  Coefficients sum_of_portions = sum;
  kernel.add_basis(positions, weights, sum);
  for (std::size_t first = 0; first < positions.size(); first += Kernel::kPortion) {
    const std::size_t size = std::min(Kernel::kPortion, positions.size() - first);
    Coefficients portion = Coefficients::Zero(11, 11);
    kernel.add_basis(std::span(positions).subspan(first, size), std::span(weights).subspan(first, size), portion);
    sum_of_portions += portion;
  }
  RC_ASSERT(sum == sum_of_portions);
}

TEST(KernelTest, Nothing_pushes_across_the_border) {
  const Basis basis(kField, 10, 1.5);
  const std::vector<Vec2> positions{{0.0, 1.0}, {3.0, 1.0}, {1.0, 0.0}, {1.0, 2.0}};
  std::vector<Vec2> b(4);
  Kernel(basis).gradient(positions, Coefficients::Ones(11, 11), b);
  EXPECT_NEAR(b[0].x(), 0.0, 1e-11);
  EXPECT_NEAR(b[1].x(), 0.0, 1e-11);
  EXPECT_NEAR(b[2].y(), 0.0, 1e-11);
  EXPECT_NEAR(b[3].y(), 0.0, 1e-11);
}

TEST(KernelTest, A_copy_works_alike) {
  const Basis basis(kField, 10, 1.5);
  const std::vector<Vec2> positions{{0.3, 1.0}, {2.0, 1.5}};
  const std::vector<double> weights{1.0, 2.0};
  Kernel kernel(basis);
  Coefficients sum = Coefficients::Zero(11, 11);
  Coefficients copied = Coefficients::Zero(11, 11);
  kernel.add_basis(positions, weights, sum);
  Kernel copy = kernel;
  copy.add_basis(positions, weights, copied);
  EXPECT_EQ(sum, copied);
}

}  // namespace
}  // namespace vigil::ergodic
