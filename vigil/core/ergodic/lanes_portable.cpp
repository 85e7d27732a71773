// Lanes for any processor. std::fma is exact wherever it comes from: an instruction (then the compiler makes vectors of
// these loops), or a slow function of the C library.

#include <cmath>

#include "vigil/core/ergodic/lanes_template.hpp"

namespace vigil::ergodic {
namespace {

struct Portable {
  static constexpr std::size_t kWidth = 8;
  static constexpr std::size_t kMostRows = 2;
  static constexpr std::size_t kMostColumns = 2;

  static Portable all(double number) noexcept {
    Portable result;
    for (double& n : result.numbers) n = number;
    return result;
  }
  static Portable load(const double* from) noexcept {
    Portable result;
    for (std::size_t i = 0; i < kWidth; ++i) result.numbers[i] = from[i];
    return result;
  }
  static void sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept;
  void store(double* to) const noexcept {
    for (std::size_t i = 0; i < kWidth; ++i) to[i] = numbers[i];
  }

  double numbers[kWidth];
};

template <typename Operation>
Portable each(Operation operation) noexcept {
  Portable result;
  for (std::size_t i = 0; i < Portable::kWidth; ++i) result.numbers[i] = operation(i);
  return result;
}

Portable operator-(const Portable& a, const Portable& b) noexcept {
  return each([&](std::size_t i) { return a.numbers[i] - b.numbers[i]; });
}
Portable operator*(const Portable& a, const Portable& b) noexcept {
  return each([&](std::size_t i) { return a.numbers[i] * b.numbers[i]; });
}
Portable operator/(const Portable& a, const Portable& b) noexcept {
  return each([&](std::size_t i) { return a.numbers[i] / b.numbers[i]; });
}
Portable fused(const Portable& a, const Portable& b, const Portable& c) noexcept {
  return each([&](std::size_t i) { return std::fma(a.numbers[i], b.numbers[i], c.numbers[i]); });
}
Portable rounded(const Portable& a) noexcept {
  return each([&](std::size_t i) { return std::nearbyint(a.numbers[i]); });
}

void Portable::sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept {
  for (std::size_t r = 0; r < kMostRows; ++r) {
    const double* row = rows[r];
    sums[r] = ((row[0] + row[4]) + (row[2] + row[6])) + ((row[1] + row[5]) + (row[3] + row[7]));
  }
}

}  // namespace

const LanesCode& lanes_portable() noexcept { return lanes::code_of<Portable>(); }

}  // namespace vigil::ergodic
