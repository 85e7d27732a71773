// Lanes in one register of eight, for x86-64 with AVX-512 F; compiled for that.

#include <immintrin.h>

#include "vigil/core/ergodic/lanes_template.hpp"

namespace vigil::ergodic {
namespace {

struct Avx512 {
  static constexpr std::size_t kWidth = 8;
  static constexpr std::size_t kMostRows = 8;  // 8 x 3 sums, three columns and a row: 28 of the 32 registers
  static constexpr std::size_t kMostColumns = 3;

  static Avx512 all(double number) noexcept { return {_mm512_set1_pd(number)}; }
  static Avx512 load(const double* from) noexcept { return {_mm512_loadu_pd(from)}; }
  static void sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept;
  void store(double* to) const noexcept { _mm512_storeu_pd(to, numbers); }

  __m512d numbers;
};

Avx512 operator-(Avx512 a, Avx512 b) noexcept { return {_mm512_sub_pd(a.numbers, b.numbers)}; }
Avx512 operator*(Avx512 a, Avx512 b) noexcept { return {_mm512_mul_pd(a.numbers, b.numbers)}; }
Avx512 operator/(Avx512 a, Avx512 b) noexcept { return {_mm512_div_pd(a.numbers, b.numbers)}; }
Avx512 fused(Avx512 a, Avx512 b, Avx512 c) noexcept { return {_mm512_fmadd_pd(a.numbers, b.numbers, c.numbers)}; }
Avx512 rounded(Avx512 a) noexcept {
  return {_mm512_roundscale_pd(a.numbers, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)};
}

// Rows a and b side by side, each as its lanes 0+4, 1+5, 2+6, 3+7.
__m512d halved(const double* a, const double* b) noexcept {
  const __m512d row_a = _mm512_loadu_pd(a);
  const __m512d row_b = _mm512_loadu_pd(b);
  return _mm512_add_pd(_mm512_shuffle_f64x2(row_a, row_b, 0x44), _mm512_shuffle_f64x2(row_a, row_b, 0xEE));
}

// Four rows side by side, each as two numbers.
__m512d quartered(__m512d ab, __m512d cd) noexcept {
  return _mm512_add_pd(_mm512_shuffle_f64x2(ab, cd, 0x88), _mm512_shuffle_f64x2(ab, cd, 0xDD));
}

void Avx512::sum_lanes(const double (&rows)[kLanes][kLanes], double (&sums)[kLanes]) noexcept {
  const __m512d first = quartered(halved(rows[0], rows[1]), halved(rows[2], rows[3]));
  const __m512d last = quartered(halved(rows[4], rows[5]), halved(rows[6], rows[7]));
  const __m512d mixed = _mm512_add_pd(_mm512_unpacklo_pd(first, last), _mm512_unpackhi_pd(first, last));
  const __m512i order = _mm512_set_epi64(7, 5, 3, 1, 6, 4, 2, 0);  // mixed is of rows 0, 4, 1, 5, 2, 6, 3, 7
  _mm512_storeu_pd(sums, _mm512_permutexvar_pd(order, mixed));
}

}  // namespace

const LanesCode& lanes_avx512() noexcept { return lanes::code_of<Avx512>(); }

}  // namespace vigil::ergodic
