#include "vigil/core/ergodic/lanes_code.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::ergodic {
namespace {

using EightNumbers = std::array<double, kLanes>;

struct Turns {
  EightNumbers sine{};
  EightNumbers cosine{};
  bool operator==(const Turns&) const = default;
};

Turns turns_of(const EightNumbers& half_turns, InstructionSet set) {
  Turns turns;
  lanes_code(set).sine_cosine(half_turns.data(), turns.sine.data(), turns.cosine.data());
  return turns;
}

// Of a number of half turns; the integer part is taken off first, without error.
long double true_sine(double half_turns) {
  return std::sin(std::numbers::pi_v<long double> * std::remainder(static_cast<long double>(half_turns), 2.0L));
}
long double true_cosine(double half_turns) {
  return std::cos(std::numbers::pi_v<long double> * std::remainder(static_cast<long double>(half_turns), 2.0L));
}

void expect_true(const EightNumbers& half_turns, InstructionSet set) {
  const Turns turns = turns_of(half_turns, set);
  for (std::size_t i = 0; i < half_turns.size(); ++i) {
    EXPECT_LT(std::abs(static_cast<long double>(turns.sine[i]) - true_sine(half_turns[i])), 4e-16L) << half_turns[i];
    EXPECT_LT(std::abs(static_cast<long double>(turns.cosine[i]) - true_cosine(half_turns[i])), 4e-16L)
        << half_turns[i];
  }
}

EightNumbers random_numbers(std::mt19937_64& random, double lowest, double highest) {
  std::uniform_real_distribution<double> number(lowest, highest);
  EightNumbers numbers{};
  for (double& n : numbers) n = number(random);
  return numbers;
}

TEST(LanesCodeTest, Sines_and_cosines_are_within_4e_16_of_the_truth) {
  for (const InstructionSet set : instruction_sets()) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i) expect_true(random_numbers(random, -1.5, 2.5), set);
    for (int i = 0; i < 1000; ++i) expect_true(random_numbers(random, -1e6, 1e6), set);
    expect_true({0.0, -0.0, 0.5, -0.5, 1.0, 1.5, 2.0, -1.0}, set);
    expect_true({0.25, 0.75, 1e-300, 5e-324, 1e15 + 0.5, 1e18, -1e300, 1.7e308}, set);
  }
}

TEST(LanesCodeTest, Sines_of_whole_and_cosines_of_half_numbers_are_nothing) {
  for (const InstructionSet set : instruction_sets()) {
    const Turns turns = turns_of({0.0, 1.0, 2.0, -1.0, 0.5, 1.5, -0.5, 2.5}, set);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(turns.sine.at(i), 0.0);
    for (std::size_t i = 4; i < 8; ++i) EXPECT_NEAR(turns.cosine.at(i), 0.0, 2e-16);
  }
}

TEST(LanesCodeTest, Sines_and_cosines_are_the_same_with_every_instruction_set_to_the_last_bit) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const EightNumbers numbers = random_numbers(random, -3.0, 3.0);
    for (const InstructionSet set : instruction_sets())
      ASSERT_EQ(turns_of(numbers, set), turns_of(numbers, InstructionSet::kPortable)) << name_of(set);
  }
}

struct Matrix {
  Matrix(std::size_t row_count, std::size_t stride_of_rows, std::size_t length, std::mt19937_64& random)
      : rows(row_count), stride(stride_of_rows), numbers(row_count * stride_of_rows) {
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t j = 0; j < length; ++j) numbers[r * stride + j] = number(random);
  }
  [[nodiscard]] std::span<const double> row(std::size_t r) const {
    return std::span(numbers).subspan(r * stride, stride);
  }
  std::size_t rows;
  std::size_t stride;
  std::vector<double> numbers;
};

// Entry (r, c) at r b.rows + c.
std::vector<double> products(const Matrix& a, const Matrix& b, InstructionSet set) {
  std::vector<double> out(a.rows * b.rows);
  lanes_code(set).row_products({.rows = a.numbers.data(),
                                .columns = b.numbers.data(),
                                .row_count = a.rows,
                                .column_count = b.rows,
                                .stride = a.stride,
                                .out = out.data(),
                                .out_row_stride = b.rows,
                                .out_column_stride = 1});
  return out;
}

RC_GTEST_PROP(LanesCodeTest, Row_products_are_the_sums_of_products_and_the_same_with_every_instruction_set, ()) {
  const auto length = *rc::gen::inRange<std::size_t>(1, 60);
  const std::size_t stride = (length + kLanes - 1) / kLanes * kLanes;
  std::mt19937_64 random(*rc::gen::inRange<unsigned>(0, 1000));
  const Matrix a(*rc::gen::inRange<std::size_t>(1, 40), stride, length, random);
  const Matrix b(*rc::gen::inRange<std::size_t>(1, 40), stride, length, random);
  const auto portable = products(a, b, InstructionSet::kPortable);
  for (const InstructionSet set : instruction_sets()) RC_ASSERT(products(a, b, set) == portable);
  for (std::size_t r = 0; r < a.rows; ++r) {
    for (std::size_t c = 0; c < b.rows; ++c) {
      const double sum = std::inner_product(a.row(r).begin(), a.row(r).end(), b.row(c).begin(), 0.0);
      RC_ASSERT(std::abs(portable[r * b.rows + c] - sum) < 1e-13);
    }
  }
}

TEST(InstructionSetTest, There_is_always_one_and_each_has_its_own_name) {
  ASSERT_FALSE(instruction_sets().empty());
  EXPECT_EQ(instruction_sets().front(), InstructionSet::kPortable);
  for (std::size_t i = 1; i < instruction_sets().size(); ++i)
    EXPECT_NE(name_of(instruction_sets()[i]), name_of(instruction_sets()[i - 1]));
}

}  // namespace
}  // namespace vigil::ergodic
