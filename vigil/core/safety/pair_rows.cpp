#include "vigil/core/safety/pair_rows.hpp"

#include <limits>

namespace vigil::safety {

using pair_formula::greatest;
using pair_formula::least;

constexpr std::size_t kLanes = 8;

/// The one loop, compiled for each instruction set.
struct PairLoops {
  template <bool kIsPaper>
  [[gnu::always_inline]] static inline void loop_of(const PairRows& rows, const Body& own, const Vec2& z,
                                                    double reach_m, std::size_t count, PairBatch& batch) {
    pair_formula::Rule rule = rows.rule_;
    rule.is_paper = kIsPaper;  // a choice within the loop would keep it from becoming vector instructions
    const double own_drift = rule.u_max_m_s * greatest(0.0, own.age_s);
    const double z_x = z.x(), z_y = z.y();
    const double p_x = own.position.x(), p_y = own.position.y();
    const double v_x = own.velocity.x(), v_y = own.velocity.y();
    const double fresh_radius = rows.fresh_radius_m_, set_range = rows.set_range_m_, beyond = rows.range_beyond_m_;
    const double* const point_x = batch.point_x.data();
    const double* const point_y = batch.point_y.data();
    const double* const position_x = batch.position_x.data();
    const double* const position_y = batch.position_y.data();
    const double* const velocity_x = batch.velocity_x.data();
    const double* const velocity_y = batch.velocity_y.data();
    const double* const age_s = batch.age_s.data();
    double* const excess_m = batch.excess_m.data();
    double* const distance_m = batch.distance_m.data();
    double* const normal_x = batch.normal_x.data();
    double* const normal_y = batch.normal_y.data();
    double* const offset = batch.offset.data();
    double* const lever = batch.lever.data();
    const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    for (std::size_t first = 0; first < padded; first += kLanes) {
#if !defined(__clang__)
#pragma GCC ivdep
#endif
      for (std::size_t i = first; i < first + kLanes; ++i) {
        const double z_ij_x = z_x - point_x[i], z_ij_y = z_y - point_y[i];
        const double p_ij_x = p_x - position_x[i], p_ij_y = p_y - position_y[i];
        const double drift = own_drift + rule.u_max_m_s * greatest(0.0, age_s[i]);
        const double radius = fresh_radius + drift;
        const double range = greatest(set_range + (radius - fresh_radius), radius + beyond);
        excess_m[i] = pair_formula::length(z_ij_x, z_ij_y) - least(reach_m, range);
        distance_m[i] = pair_formula::length(p_ij_x, p_ij_y);
        const pair_formula::Row row =
            pair_formula::row(rule, radius, z_ij_x, z_ij_y, v_x - velocity_x[i], v_y - velocity_y[i]);
        normal_x[i] = row.half_slope_x / row.lever;
        normal_y[i] = row.half_slope_y / row.lever;
        offset[i] = row.offset;
        lever[i] = row.lever;
      }
    }
  }

  [[gnu::always_inline]] static inline void loop(const PairRows& rows, const Body& own, const Vec2& z, double reach_m,
                                                 std::size_t count, PairBatch& batch) {
    if (rows.rule_.is_paper)
      loop_of<true>(rows, own, z, reach_m, count, batch);
    else
      loop_of<false>(rows, own, z, reach_m, count, batch);
  }

  static void portable(const PairRows& rows, const Body& own, const Vec2& z, double reach_m, std::size_t count,
                       PairBatch& batch) noexcept {
    loop(rows, own, z, reach_m, count, batch);
  }

#if defined(__x86_64__)
  [[gnu::target("avx2")]] static void avx2(const PairRows& rows, const Body& own, const Vec2& z, double reach_m,
                                           std::size_t count, PairBatch& batch) noexcept {
    loop(rows, own, z, reach_m, count, batch);
  }

#if defined(__clang__)
#define VIGIL_AVX512 "avx512f,avx512dq,avx512vl"
#else
#define VIGIL_AVX512 "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
  [[gnu::target(VIGIL_AVX512)]] static void avx512(const PairRows& rows, const Body& own, const Vec2& z, double reach_m,
                                                   std::size_t count, PairBatch& batch) noexcept {
    loop(rows, own, z, reach_m, count, batch);
  }
#undef VIGIL_AVX512
#endif

  static PairRows::Compute of(PairRows::InstructionSet set) {
#if defined(__x86_64__)
    if (set == PairRows::InstructionSet::kAvx512) return avx512;
    if (set == PairRows::InstructionSet::kAvx2) return avx2;
#endif
    return portable;
  }
};

PairRows::InstructionSet PairRows::best_instruction_set() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return InstructionSet::kAvx512;
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kPortable;
}

PairRows::PairRows(const BarrierParameters& parameters, InstructionSet set)
    : compute_(PairLoops::of(set)),
      rule_(pair_formula::rule_of(parameters, separation_barrier(parameters, Body{}, Body{}))),
      fresh_radius_m_(barrier_radius(parameters)),
      set_range_m_(parameters.sensing_range_m.value_or(0.0)),
      range_beyond_m_(parameters.sensing_range_m ? (parameters.u_max_m_s + parameters.u_max_m_s) * parameters.dt_s
                                                 : std::numeric_limits<double>::infinity()) {}

}  // namespace vigil::safety
