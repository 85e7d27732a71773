#include "vigil/core/safety/pair_screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil::safety {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
/// What a few operations in single precision may be wrong by, relative to their numbers, generously.
constexpr double kRounding = 1e-5;
/// What coordinates are rounded by, relative to themselves.
constexpr double kRoundingOfPlace = 6e-8;
/// Other numbers are no good to be squared in single precision.
constexpr double kFarthest = 1e6;
constexpr double kFastest = 1e3;
constexpr double kSlowest = 1e-9;

// Verdicts.
constexpr float kLeftOut = 1.0f;
constexpr float kBeyond = 2.0f;  ///< the range
constexpr float kPresses = -1.0f;
constexpr float kOnLimit = -2.0f;  ///< of the range, or nobody controls it: presses, and whether it counts is not known

constexpr std::array<float, Screening::kBlock> kLane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr std::array<std::int32_t, Screening::kBlock> kBit{1,       1 << 1,  1 << 2,  1 << 3, 1 << 4,  1 << 5,
                                                           1 << 6,  1 << 7,  1 << 8,  1 << 9, 1 << 10, 1 << 11,
                                                           1 << 12, 1 << 13, 1 << 14, 1 << 15};

[[gnu::always_inline]] inline float least(float a, float b) { return b < a ? b : a; }
[[gnu::always_inline]] inline float greatest(float a, float b) { return a < b ? b : a; }
float rounded(double number) { return static_cast<float>(number); }
double largest(const Vec2& v) { return std::max(std::abs(v.x()), std::abs(v.y())); }

/// All that is the same for all neighbours of a drone.
struct Terms {
  float z_x, z_y, p_x, p_y, v_x, v_y, u_x, u_y;
  float drift, reach, fresh_radius, set_range, beyond;
  float lag_squared, slope_s, relief_slope_s, gain, per_hold;
  float speed_squared;
  float square_error;  ///< of the square of a distance within reach
  float room_error;    ///< of half_slope.u_nom and |u_nom| lever
};

bool is_plain(const Screened& own) {
  const double speed = largest(own.u_nom);
  return largest(own.point) < kFarthest && largest(own.position) < kFarthest && largest(own.velocity) < kFastest &&
         own.drift_m < kFarthest && own.reach_m < kFarthest && (speed == 0.0 || (speed > kSlowest && speed < kFastest));
}

}  // namespace

/// The loops, compiled for each instruction set.
struct ScreenLoops {
  static Terms terms_of(const PairScreen& screen, const Screened& own) noexcept {
    const pair_formula::Rule& rule = screen.rule_;
    const double farthest = largest(own.point) + largest(own.position) + 2.0 * own.reach_m;
    const double apart_error = 4.0 * kRoundingOfPlace * farthest;
    const double speed_squared = own.u_nom.x() * own.u_nom.x() + own.u_nom.y() * own.u_nom.y();
    const double reach = own.reach_m;
    return {.z_x = rounded(own.point.x()),
            .z_y = rounded(own.point.y()),
            .p_x = rounded(own.position.x()),
            .p_y = rounded(own.position.y()),
            .v_x = rounded(own.velocity.x()),
            .v_y = rounded(own.velocity.y()),
            .u_x = rounded(own.u_nom.x()),
            .u_y = rounded(own.u_nom.y()),
            .drift = rounded(own.drift_m),
            .reach = rounded(own.reach_m),
            .fresh_radius = rounded(screen.fresh_radius_m_),
            .set_range = rounded(screen.set_range_m_),
            .beyond = rounded(screen.range_beyond_m_),
            .lag_squared = rounded(rule.sampling.lag_squared),
            .slope_s = rounded(rule.sampling.slope_s),
            .relief_slope_s = rounded(0.5 * rule.sampling.relief / rule.sampling.dt_s),
            .gain = rounded(rule.gain),
            .per_hold = rounded(1.0 / rule.hold_s),
            .speed_squared = rounded(speed_squared),
            .square_error = rounded(4.0 * apart_error * (reach + apart_error) + kRounding * reach * reach),
            .room_error = rounded(std::sqrt(speed_squared) * (4.0 * apart_error + kRounding * reach))};
  }

  template <bool kIsPaper>
  [[gnu::always_inline]] static inline void judge(const Terms& own, const BodyColumns& columns, std::size_t own_place,
                                                  Screening& screening) {
    constexpr float kLess = 1.0f - static_cast<float>(10.0 * kRounding);
    constexpr float kMore = 1.0f + static_cast<float>(10.0 * kRounding);
    for (std::size_t block = 0; block < screening.blocks_; ++block) {
      const std::size_t first = screening.first_[block];
      const auto before = static_cast<float>(static_cast<std::int64_t>(own_place) - static_cast<std::int64_t>(first));
      const float* const point_x = columns.point_x.data() + first;
      const float* const point_y = columns.point_y.data() + first;
      const float* const position_x = columns.position_x.data() + first;
      const float* const position_y = columns.position_y.data() + first;
      const float* const velocity_x = columns.velocity_x.data() + first;
      const float* const velocity_y = columns.velocity_y.data() + first;
      const float* const drift_m = columns.drift_m.data() + first;
      float* const verdicts = screening.verdicts_.data() + block * Screening::kBlock;
      float* const squares = screening.squares_.data() + block * Screening::kBlock;
#if !defined(__clang__)
#pragma GCC ivdep
#endif
      for (std::size_t i = 0; i < Screening::kBlock; ++i) {
        const float z_x = own.z_x - point_x[i], z_y = own.z_y - point_y[i];
        const float z_squared = kLane[i] != before ? z_x * z_x + z_y * z_y : kInfinite;
        const float drift = own.drift + drift_m[i];
        const float radius = own.fresh_radius + drift;
        const float range = least(own.reach, greatest(own.set_range + drift, radius + own.beyond));
        const float beyond = z_squared - range * range;

        const float v_x = own.v_x - velocity_x[i], v_y = own.v_y - velocity_y[i];
        const float swing = own.lag_squared * (v_x * v_x + v_y * v_y);
        const float h = z_squared - kMore * swing - radius * radius - own.square_error;
        const float gamma = least(kIsPaper ? own.gain * h * h * h : own.gain * h, h * own.per_hold);
        const float slope_x = z_x - own.slope_s * v_x, slope_y = z_y - own.slope_s * v_y;
        const float lever_squared = slope_x * slope_x + slope_y * slope_y;
        const float given = kLess * (gamma + own.relief_slope_s * swing);
        const float room = slope_x * own.u_x + slope_y * own.u_y + given - own.room_error;
        const float spared = kLess * room * room - own.speed_squared * lever_squared;

        const float free = spared >= 0.0f ? kLeftOut : kPresses;
        const float facing = room > 0.0f ? free : kPresses;
        const float outside = h > 0.0f ? facing : kPresses;
        const float clear = beyond < -own.square_error ? outside : kOnLimit;
        const float known = radius < kInfinite ? clear : kOnLimit;
        verdicts[i] = beyond <= own.square_error ? known : kBeyond;
        const float p_x = own.p_x - position_x[i], p_y = own.p_y - position_y[i];
        squares[i] = p_x * p_x + p_y * p_y;
      }
    }
  }

  /// A bit for each of a block that is not beyond the range.
  [[gnu::always_inline]] static inline unsigned within(const float* verdicts) {
    std::int32_t bits = 0;
    for (std::size_t i = 0; i < Screening::kBlock; ++i) bits |= verdicts[i] < kBeyond ? kBit[i] : 0;
    return static_cast<unsigned>(bits);
  }

  [[gnu::always_inline]] static inline void conclude(float square_error, Screening& screening) {
    std::size_t within_range = 0;
    std::size_t count = 0;
    float least_square = kInfinite;
    for (std::size_t block = 0; block < screening.blocks_; ++block) {
      const std::size_t at = block * Screening::kBlock;
      const unsigned present = (1u << screening.size_[block]) - 1u;
      for (unsigned bits = within(&screening.verdicts_[at]) & present; bits != 0; bits &= bits - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(bits));
        const std::uint32_t place = screening.first_[block] + i;
        const float verdict = screening.verdicts_[at + i];
        const float square = screening.squares_[at + i];
        screening.pressing_[count] = place;
        count += verdict < 0.0f ? 1u : 0u;
        screening.near_[within_range] = place;
        screening.near_squares_[within_range] = square;
        screening.near_verdicts_[within_range] = verdict;
        ++within_range;
        least_square = least(least_square, verdict == kOnLimit ? kInfinite : square);
      }
    }
    screening.within_range_ = within_range;
    screening.count_ = count;
    keep_nearest(least_square + 2.0f * square_error, screening);
  }

  [[gnu::always_inline]] static inline void keep_nearest(float farthest_square, Screening& screening) {
    std::size_t near_count = 0;
    bool is_sure = true;
    for (std::size_t k = 0; k < screening.within_range_; ++k) {
      const bool is_near = screening.near_squares_[k] <= farthest_square;
      screening.near_[near_count] = screening.near_[k];
      near_count += is_near ? 1u : 0u;
      is_sure = is_sure && !(is_near && screening.near_verdicts_[k] == kOnLimit);
    }
    screening.near_count_ = near_count;
    screening.is_sure_ = is_sure;
  }

  [[gnu::always_inline]] static inline void look(const PairScreen& screen, const BodyColumns& columns,
                                                 const Screened& own, Screening& screening) {
    screening.is_sure_ = screening.is_sure_ && is_plain(own);
    if (!screening.is_sure_) return;
    const Terms terms = terms_of(screen, own);
    if (screen.rule_.is_paper)
      judge<true>(terms, columns, own.place, screening);
    else
      judge<false>(terms, columns, own.place, screening);
    conclude(terms.square_error, screening);
  }

  static void portable(const PairScreen& screen, const BodyColumns& columns, const Screened& own,
                       Screening& screening) noexcept {
    look(screen, columns, own, screening);
  }

#if defined(__x86_64__)
  [[gnu::target("avx2")]] static void avx2(const PairScreen& screen, const BodyColumns& columns, const Screened& own,
                                           Screening& screening) noexcept {
    look(screen, columns, own, screening);
  }

#if defined(__clang__)
#define VIGIL_AVX512 "avx512f,avx512dq,avx512vl"
#else
#define VIGIL_AVX512 "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
  [[gnu::target(VIGIL_AVX512)]] static void avx512(const PairScreen& screen, const BodyColumns& columns,
                                                   const Screened& own, Screening& screening) noexcept {
    look(screen, columns, own, screening);
  }
#undef VIGIL_AVX512
#endif

  static PairScreen::Look of(PairScreen::InstructionSet set) {
#if defined(__x86_64__)
    if (set == PairScreen::InstructionSet::kAvx512) return avx512;
    if (set == PairScreen::InstructionSet::kAvx2) return avx2;
#endif
    return portable;
  }
};

PairScreen::PairScreen(const BarrierParameters& parameters, InstructionSet set)
    : look_(ScreenLoops::of(set)),
      rule_(pair_formula::rule_of(parameters, separation_barrier(parameters, Body{}, Body{}))),
      fresh_radius_m_(barrier_radius(parameters)),
      set_range_m_(parameters.sensing_range_m.value_or(0.0)),
      range_beyond_m_(parameters.sensing_range_m ? (parameters.u_max_m_s + parameters.u_max_m_s) * parameters.dt_s
                                                 : std::numeric_limits<double>::infinity()) {}

}  // namespace vigil::safety
