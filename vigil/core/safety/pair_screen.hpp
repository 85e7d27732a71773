#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vigil/core/safety/body_columns.hpp"
#include "vigil/core/safety/pair_formula.hpp"
#include "vigil/core/safety/pair_rows.hpp"

namespace vigil::safety {

/// The drone whose neighbours are screened.
struct Screened {
  std::size_t place = 0;  ///< in the columns
  Vec2 point = Vec2::Zero();
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  double drift_m = 0.0;  ///< how far it may have come since it was seen
  Vec2 u_nom = Vec2::Zero();
  double reach_m = 0.0;        ///< pairs farther apart have no row
  bool are_all_fresh = false;  ///< all bodies are controlled, and were seen just now
};

/// Which neighbours of one drone matter: work space and result. Whether anything is said at all is in is_sure().
class Screening {
 public:
  static constexpr std::size_t kBlock = 16;
  static constexpr std::size_t kMostBlocks = 16;

  void clear() noexcept {
    blocks_ = 0;
    is_sure_ = true;
  }
  /// Bodies to be looked at: those at [first, last) of the columns, after those that were added before.
  void add(std::size_t first, std::size_t last) noexcept {
    for (; first < last; first += kBlock) {
      if (blocks_ == kMostBlocks) {
        is_sure_ = false;
        return;
      }
      first_[blocks_] = static_cast<std::uint32_t>(first);
      size_[blocks_] = static_cast<std::uint32_t>(last - first < kBlock ? last - first : kBlock);
      ++blocks_;
    }
  }

  /// False where there are too many of them, or what counts cannot be told from a first look: all rows have to be
  /// looked at then, and nothing below means anything.
  [[nodiscard]] bool is_sure() const noexcept { return is_sure_; }
  /// How many are within the range in which a pair has a row, or hardly beyond it.
  [[nodiscard]] std::size_t within_range() const noexcept { return within_range_; }
  /// Those of them whose rows may hold the drone, in the order of the columns.
  [[nodiscard]] std::span<const std::uint32_t> pressing() const noexcept { return std::span(pressing_).first(count_); }
  /// Those within range among which the nearest is, in the order of the columns.
  [[nodiscard]] std::span<const std::uint32_t> nearest() const noexcept { return std::span(near_).first(near_count_); }

 private:
  friend struct ScreenLoops;

  static constexpr std::size_t kMost = kBlock * kMostBlocks;
  alignas(64) std::array<float, kMost> verdicts_;
  alignas(64) std::array<float, kMost> squares_;  ///< of distances
  std::array<std::uint32_t, kMostBlocks> first_;  ///< place of each block
  std::array<std::uint32_t, kMostBlocks> size_;
  std::array<std::uint32_t, kMostBlocks> marks_;  ///< of each block: who is within range, and who of them presses
  std::array<std::uint32_t, kMost> pressing_;
  std::array<std::uint32_t, kMost> near_;
  std::size_t blocks_ = 0;
  std::size_t count_ = 0;
  std::size_t near_count_ = 0;
  std::size_t within_range_ = 0;
  bool is_sure_ = true;
};

/// Leaves out the rows that cannot have a part in a drone's answer, before anything is divided or a root is drawn.
///
/// Where u = 0 satisfies every row (no offset is above 0), the answer, and every velocity that the solver comes by, is
/// the point of a convex set with 0 in it that is nearest to u_nom: it lies in the disk over the diameter from 0 to
/// u_nom (Thales). A row n.u >= offset that all of this disk satisfies, offset < (n.u_nom - |u_nom|) / 2, changes
/// nothing. With the offset of pair_formula, -(gamma_d(h) + relief/2) / (2 lever), and the normal half_slope / lever,
/// that is
///     |u_nom| lever < half_slope.u_nom + gamma_d(h) + relief/2.
/// Single precision does for that: what it may round is left as room, and the answer is the same to the last bit. The
/// caller sees to the premise: no row is left out whose offset may be above 0, and those that are kept are computed.
class PairScreen {
 public:
  using InstructionSet = PairRows::InstructionSet;
  explicit PairScreen(const BarrierParameters& parameters, InstructionSet set = PairRows::best_instruction_set());

  /// Looks at all bodies that were added to the screening.
  void look(const BodyColumns& columns, const Screened& own, Screening& screening) const noexcept {
    look_(*this, columns, own, screening);
  }

 private:
  using Look = void (*)(const PairScreen& screen, const BodyColumns& columns, const Screened& own,
                        Screening& screening) noexcept;
  friend struct ScreenLoops;

  /// Of the barrier of two drones that were seen just now.
  struct Numbers {
    float fresh_radius, set_range, beyond;
    float lag_squared, slope_s, relief_slope_s, gain, per_hold;
  };

  Look look_;
  Numbers numbers_{};
  bool is_paper_ = false;
};

}  // namespace vigil::safety
