// The planar solver's batches for x86-64 with AVX-512 F, DQ and VL; compiled for that.

#include <immintrin.h>

#include "vigil/core/safety/planar_qp_lanes.hpp"

namespace vigil::safety {
namespace {

struct Marks512 {
  static Marks512 all() { return {static_cast<__mmask8>(0xff)}; }
  __mmask8 lanes;
};

Marks512 operator&(Marks512 a, Marks512 b) { return {_kand_mask8(a.lanes, b.lanes)}; }
Marks512 operator|(Marks512 a, Marks512 b) { return {_kor_mask8(a.lanes, b.lanes)}; }
Marks512 without(Marks512 a, Marks512 b) { return {_kandn_mask8(b.lanes, a.lanes)}; }
bool any(Marks512 a) { return a.lanes != 0; }
std::uint8_t bits(Marks512 a) { return a.lanes; }

struct Numbers512 {
  using Marks = Marks512;
  static Numbers512 all(double number) { return {_mm512_set1_pd(number)}; }
  static Numbers512 load(const double* from) { return {_mm512_load_pd(from)}; }
  void store(double* to) const { _mm512_store_pd(to, lanes); }
  __m512d lanes;
};

Numbers512 operator+(Numbers512 a, Numbers512 b) { return {_mm512_add_pd(a.lanes, b.lanes)}; }
Numbers512 operator-(Numbers512 a, Numbers512 b) { return {_mm512_sub_pd(a.lanes, b.lanes)}; }
Numbers512 operator*(Numbers512 a, Numbers512 b) { return {_mm512_mul_pd(a.lanes, b.lanes)}; }
Numbers512 operator/(Numbers512 a, Numbers512 b) { return {_mm512_div_pd(a.lanes, b.lanes)}; }
Numbers512 operator-(Numbers512 a) { return {_mm512_xor_pd(a.lanes, _mm512_set1_pd(-0.0))}; }
Numbers512 magnitude(Numbers512 a) { return {_mm512_abs_pd(a.lanes)}; }
Numbers512 root(Numbers512 a) { return {_mm512_sqrt_pd(a.lanes)}; }
Marks512 is_less(Numbers512 a, Numbers512 b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_LT_OQ)}; }
Marks512 differ(Numbers512 a, Numbers512 b) { return {_mm512_cmp_pd_mask(a.lanes, b.lanes, _CMP_NEQ_UQ)}; }
Numbers512 chosen(Marks512 which, Numbers512 a, Numbers512 b) {
  return {_mm512_mask_blend_pd(which.lanes, b.lanes, a.lanes)};
}
/// b where one of them is not a number, like (a > b ? a : b).
Numbers512 greatest(Numbers512 a, Numbers512 b) { return {_mm512_max_pd(a.lanes, b.lanes)}; }

}  // namespace

void solve_avx512(PlanarQpColumns& problems, double radius) noexcept {
  LanesSolver<Numbers512>::solve(problems, radius);
}

}  // namespace vigil::safety
