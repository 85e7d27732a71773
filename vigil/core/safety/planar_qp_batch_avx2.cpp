// The planar solver's batches for x86-64 with AVX2, two registers of four lanes; compiled for that.

#include <immintrin.h>

#include "vigil/core/safety/planar_qp_lanes.hpp"

namespace vigil::safety {
namespace {

/// All bits of a lane, or none.
struct Marks256 {
  static Marks256 all() {
    const __m256d ones = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    return {ones, ones};
  }
  __m256d low, high;
};

Marks256 operator&(const Marks256& a, const Marks256& b) {
  return {_mm256_and_pd(a.low, b.low), _mm256_and_pd(a.high, b.high)};
}
Marks256 operator|(const Marks256& a, const Marks256& b) {
  return {_mm256_or_pd(a.low, b.low), _mm256_or_pd(a.high, b.high)};
}
Marks256 without(const Marks256& a, const Marks256& b) {
  return {_mm256_andnot_pd(b.low, a.low), _mm256_andnot_pd(b.high, a.high)};
}
std::uint8_t bits(const Marks256& a) {
  return static_cast<std::uint8_t>(_mm256_movemask_pd(a.low) | (_mm256_movemask_pd(a.high) << 4));
}
bool any(const Marks256& a) { return _mm256_movemask_pd(_mm256_or_pd(a.low, a.high)) != 0; }

struct Numbers256 {
  using Marks = Marks256;
  static Numbers256 all(double number) { return {_mm256_set1_pd(number), _mm256_set1_pd(number)}; }
  static Numbers256 load(const double* from) { return {_mm256_load_pd(from), _mm256_load_pd(from + 4)}; }
  void store(double* to) const {
    _mm256_store_pd(to, low);
    _mm256_store_pd(to + 4, high);
  }
  __m256d low, high;
};

Numbers256 operator+(const Numbers256& a, const Numbers256& b) {
  return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
}
Numbers256 operator-(const Numbers256& a, const Numbers256& b) {
  return {_mm256_sub_pd(a.low, b.low), _mm256_sub_pd(a.high, b.high)};
}
Numbers256 operator*(const Numbers256& a, const Numbers256& b) {
  return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
}
Numbers256 operator/(const Numbers256& a, const Numbers256& b) {
  return {_mm256_div_pd(a.low, b.low), _mm256_div_pd(a.high, b.high)};
}
Numbers256 operator-(const Numbers256& a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_xor_pd(a.low, sign), _mm256_xor_pd(a.high, sign)};
}
Numbers256 magnitude(const Numbers256& a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_andnot_pd(sign, a.low), _mm256_andnot_pd(sign, a.high)};
}
Numbers256 root(const Numbers256& a) { return {_mm256_sqrt_pd(a.low), _mm256_sqrt_pd(a.high)}; }
Marks256 is_less(const Numbers256& a, const Numbers256& b) {
  return {_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ)};
}
Marks256 differ(const Numbers256& a, const Numbers256& b) {
  return {_mm256_cmp_pd(a.low, b.low, _CMP_NEQ_UQ), _mm256_cmp_pd(a.high, b.high, _CMP_NEQ_UQ)};
}
Numbers256 chosen(const Marks256& which, const Numbers256& a, const Numbers256& b) {
  return {_mm256_blendv_pd(b.low, a.low, which.low), _mm256_blendv_pd(b.high, a.high, which.high)};
}
/// b where one of them is not a number, like (a > b ? a : b).
Numbers256 greatest(const Numbers256& a, const Numbers256& b) {
  return {_mm256_max_pd(a.low, b.low), _mm256_max_pd(a.high, b.high)};
}

}  // namespace

void solve_avx2(PlanarQpColumns& problems, double radius) noexcept { LanesSolver<Numbers256>::solve(problems, radius); }

}  // namespace vigil::safety
