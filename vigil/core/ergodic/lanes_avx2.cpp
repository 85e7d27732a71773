// Lanes in two halves of four, for x86-64 with AVX2 and FMA; compiled for those.

#include <immintrin.h>

#include "vigil/core/ergodic/lanes_template.hpp"

namespace vigil::ergodic {
namespace {

struct Avx2 {
  static constexpr std::size_t kWidth = 4;
  static constexpr std::size_t kMostRows = 4;  // 4 x 3 sums, three columns and a row: all sixteen registers
  static constexpr std::size_t kMostColumns = 3;

  static Avx2 all(double number) noexcept { return {_mm256_set1_pd(number)}; }
  static Avx2 load(const double* from) noexcept { return {_mm256_loadu_pd(from)}; }
  static void sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept;
  void store(double* to) const noexcept { _mm256_storeu_pd(to, numbers); }

  __m256d numbers;
};

Avx2 operator-(Avx2 a, Avx2 b) noexcept { return {_mm256_sub_pd(a.numbers, b.numbers)}; }
Avx2 operator*(Avx2 a, Avx2 b) noexcept { return {_mm256_mul_pd(a.numbers, b.numbers)}; }
Avx2 operator/(Avx2 a, Avx2 b) noexcept { return {_mm256_div_pd(a.numbers, b.numbers)}; }
Avx2 fused(Avx2 a, Avx2 b, Avx2 c) noexcept { return {_mm256_fmadd_pd(a.numbers, b.numbers, c.numbers)}; }
Avx2 rounded(Avx2 a) noexcept { return {_mm256_round_pd(a.numbers, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)}; }

// Of four rows: what each has in lanes 0+4, 1+5, 2+6, 3+7, and so on.
__m256d sums_of_four(const double (*rows)[kLanes]) noexcept {
  __m256d halved[4];
  for (std::size_t r = 0; r < 4; ++r) halved[r] = _mm256_add_pd(_mm256_loadu_pd(rows[r]), _mm256_loadu_pd(rows[r] + 4));
  const __m256d even = _mm256_add_pd(_mm256_permute2f128_pd(halved[0], halved[2], 0x20),
                                     _mm256_permute2f128_pd(halved[0], halved[2], 0x31));
  const __m256d odd = _mm256_add_pd(_mm256_permute2f128_pd(halved[1], halved[3], 0x20),
                                    _mm256_permute2f128_pd(halved[1], halved[3], 0x31));
  return _mm256_add_pd(_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd));
}

void Avx2::sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept {
  _mm256_storeu_pd(sums, sums_of_four(rows));
}

}  // namespace

const LanesCode& lanes_avx2() noexcept { return lanes::code_of<Avx2>(); }

}  // namespace vigil::ergodic
