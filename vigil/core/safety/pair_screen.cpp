#include "vigil/core/safety/pair_screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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

constexpr std::size_t kBlock = Screening::kBlock;
constexpr std::array<float, kBlock> kLane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr std::array<std::uint32_t, kBlock> kBit{1u << 0,  1u << 1,  1u << 2,  1u << 3, 1u << 4,  1u << 5,
                                                 1u << 6,  1u << 7,  1u << 8,  1u << 9, 1u << 10, 1u << 11,
                                                 1u << 12, 1u << 13, 1u << 14, 1u << 15};
// Of a block's lanes one number: who is within range in its lower half, who of them presses in its upper.
constexpr unsigned kUpper = kBlock;
constexpr std::uint32_t kLowerHalf = (1u << kUpper) - 1u;

[[gnu::always_inline]] inline float least(float a, float b) { return b < a ? b : a; }
[[gnu::always_inline]] inline float greatest(float a, float b) { return a < b ? b : a; }
float rounded(double number) { return static_cast<float>(number); }
double largest(const Vec2& v) { return std::max(std::abs(v.x()), std::abs(v.y())); }

/// All that is the same for all neighbours of a drone, beside the screen's own numbers.
struct Terms {
  float z_x, z_y, p_x, p_y, v_x, v_y, u_x, u_y;
  float drift, reach;
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
  static Terms terms_of(const Screened& own) noexcept {
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
            .speed_squared = rounded(speed_squared),
            .square_error = rounded(4.0 * apart_error * (reach + apart_error) + kRounding * reach * reach),
            .room_error = rounded(std::sqrt(speed_squared) * (4.0 * apart_error + kRounding * reach))};
  }

  /// Returns the square of the distance to the nearest of whom it is certain that they are within range. kAreFresh:
  /// nobody may have come any way since it was seen.
  template <bool kIsPaper, bool kAreFresh>
  [[gnu::always_inline]] static inline float judge(const PairScreen::Numbers& all, const Terms& own,
                                                   const BodyColumns& columns, std::size_t own_place,
                                                   Screening& screening) {
    constexpr float kLess = 1.0f - static_cast<float>(10.0 * kRounding);
    constexpr float kMore = 1.0f + static_cast<float>(10.0 * kRounding);
    std::array<float, kBlock> nearest;
    nearest.fill(kInfinite);
    for (std::size_t block = 0; block < screening.blocks_; ++block) {
      const std::size_t first = screening.first_[block];
      const auto before = static_cast<float>(static_cast<std::int64_t>(own_place) - static_cast<std::int64_t>(first));
      const float* const point_x = columns.point_x() + first;
      const float* const point_y = columns.point_y() + first;
      const float* const position_x = columns.position_x() + first;
      const float* const position_y = columns.position_y() + first;
      const float* const velocity_x = columns.velocity_x() + first;
      const float* const velocity_y = columns.velocity_y() + first;
      const float* const drift_m = columns.drift_m() + first;
      float* const verdicts = screening.verdicts_.data() + block * kBlock;
      float* const squares = screening.squares_.data() + block * kBlock;
      const auto size = static_cast<float>(screening.size_[block]);
      std::uint32_t marks = 0;
#if !defined(__clang__)
#pragma GCC ivdep
#endif
      for (std::size_t i = 0; i < Screening::kBlock; ++i) {
        const float z_x = own.z_x - point_x[i], z_y = own.z_y - point_y[i];
        const float z_squared = kLane[i] != before ? z_x * z_x + z_y * z_y : kInfinite;
        const float drift = kAreFresh ? 0.0f : own.drift + drift_m[i];
        const float radius = all.fresh_radius + drift;
        const float range = least(own.reach, greatest(all.set_range + drift, radius + all.beyond));
        const float beyond = z_squared - range * range;

        const float v_x = own.v_x - velocity_x[i], v_y = own.v_y - velocity_y[i];
        const float swing = all.lag_squared * (v_x * v_x + v_y * v_y);
        const float h = z_squared - kMore * swing - radius * radius - own.square_error;
        const float gamma = least(kIsPaper ? all.gain * h * h * h : all.gain * h, h * all.per_hold);
        const float slope_x = z_x - all.slope_s * v_x, slope_y = z_y - all.slope_s * v_y;
        const float lever_squared = slope_x * slope_x + slope_y * slope_y;
        const float given = kLess * (gamma + all.relief_slope_s * swing);
        const float room = slope_x * own.u_x + slope_y * own.u_y + given - own.room_error;
        const float spared = kLess * room * room - own.speed_squared * lever_squared;

        const float free = spared >= 0.0f ? kLeftOut : kPresses;
        const float facing = room > 0.0f ? free : kPresses;
        const float outside = h > 0.0f ? facing : kPresses;
        const float clear = beyond < -own.square_error ? outside : kOnLimit;
        const float known = radius < kInfinite ? clear : kOnLimit;
        const float within = beyond <= own.square_error ? known : kBeyond;
        const float verdict = kLane[i] < size ? within : kBeyond;
        verdicts[i] = verdict;
        const float p_x = own.p_x - position_x[i], p_y = own.p_y - position_y[i];
        const float square = p_x * p_x + p_y * p_y;
        squares[i] = square;
        const float certain = verdict > kOnLimit ? square : kInfinite;
        nearest[i] = least(nearest[i], verdict < kBeyond ? certain : kInfinite);
        marks |= (verdict < kBeyond ? kBit[i] : 0u) | (verdict < 0.0f ? kBit[i] << kUpper : 0u);
      }
      screening.marks_[block] = marks;
    }
    return least_of(nearest);
  }

  [[gnu::always_inline]] static inline float least_of(std::array<float, kBlock>& lanes) {
    for (std::size_t half = kBlock / 2; half > 0; half /= 2)
      for (std::size_t i = 0; i < half; ++i) lanes[i] = least(lanes[i], lanes[i + half]);
    return lanes[0];
  }

  /// A bit for each of a block that is not farther away.
  [[gnu::always_inline]] static inline std::uint32_t near(const float* squares, float farthest_square) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kBlock; ++i) bits |= squares[i] <= farthest_square ? kBit[i] : 0u;
    return bits;
  }

  [[gnu::always_inline]] static inline void conclude(float farthest_square, Screening& screening) {
    std::size_t within_range = 0;
    std::size_t count = 0;
    std::size_t near_count = 0;
    for (std::size_t block = 0; block < screening.blocks_; ++block) {
      const std::uint32_t within = screening.marks_[block] & kLowerHalf;
      if (within == 0) continue;
      within_range += static_cast<std::size_t>(__builtin_popcount(within));
      const auto place_of = [&](std::uint32_t bits) {
        return screening.first_[block] + static_cast<std::uint32_t>(__builtin_ctz(bits));
      };
      for (std::uint32_t bits = screening.marks_[block] >> kUpper; bits != 0; bits &= bits - 1)
        screening.pressing_[count++] = place_of(bits);
      const std::size_t at = block * kBlock;
      for (std::uint32_t bits = near(&screening.squares_[at], farthest_square) & within; bits != 0; bits &= bits - 1) {
        screening.near_[near_count++] = place_of(bits);
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        screening.is_sure_ = screening.is_sure_ && screening.verdicts_[at + lane] != kOnLimit;
      }
    }
    screening.within_range_ = within_range;
    screening.count_ = count;
    screening.near_count_ = near_count;
  }

  [[gnu::always_inline]] static inline void look(const PairScreen& screen, const BodyColumns& columns,
                                                 const Screened& own, Screening& screening) {
    screening.is_sure_ = screening.is_sure_ && is_plain(own);
    if (!screening.is_sure_) return;
    const Terms terms = terms_of(own);
    const auto judged = [&](auto is_paper, auto are_fresh) __attribute__((always_inline)) {
      return judge<is_paper, are_fresh>(screen.numbers_, terms, columns, own.place, screening);
    };
    float least_square = 0.0f;
    if (screen.is_paper_)
      least_square = judged(std::true_type(), std::false_type());
    else if (own.are_all_fresh)
      least_square = judged(std::false_type(), std::true_type());
    else
      least_square = judged(std::false_type(), std::false_type());
    conclude(least_square + 2.0f * terms.square_error, screening);
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

PairScreen::PairScreen(const BarrierParameters& parameters, InstructionSet set) : look_(ScreenLoops::of(set)) {
  const pair_formula::Rule rule = pair_formula::rule_of(parameters, separation_barrier(parameters, Body{}, Body{}));
  const pair_formula::Sampling& sampling = rule.sampling;
  is_paper_ = rule.is_paper;
  // As in PairRows.
  numbers_ = {.fresh_radius = rounded(barrier_radius(parameters)),
              .set_range = rounded(parameters.sensing_range_m.value_or(0.0)),
              .beyond = parameters.sensing_range_m ? rounded(2.0 * parameters.u_max_m_s * parameters.dt_s) : kInfinite,
              .lag_squared = rounded(sampling.lag_squared),
              .slope_s = rounded(sampling.slope_s),
              .relief_slope_s = rounded(0.5 * sampling.relief / sampling.dt_s),
              .gain = rounded(rule.gain),
              .per_hold = rounded(1.0 / rule.hold_s)};
}

}  // namespace vigil::safety
