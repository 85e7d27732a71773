#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety {

enum class RowKind : std::uint8_t { kNeighbour, kWall, kNoFly };

/// A constraint that holds a drone's velocity where it is.
struct HoldingRow {
  RowKind kind = RowKind::kNeighbour;
  int index = -1;           ///< of the other body, the wall (0 left, 1 right, 2 bottom, 3 top) or the no-fly edge
  double distance_m = 0.0;  ///< between positions, or from the wall or edge (signed)
};

/// A constraint of (10) as one drone was given it.
struct GivenRow {
  HalfPlane half_plane;
  HoldingRow what;
};

/// The rows of one drone; of more than kMaxRows those that press most.
class RowSet {
 public:
  void clear() noexcept {
    count_ = 0;
    is_crowded_ = false;
  }
  void add(const HalfPlane& half_plane, const HoldingRow& what) noexcept {
    if (count_ == kMaxRows) return replace(half_plane, what);
    half_planes_[count_] = half_plane;
    whats_[count_] = what;
    if (++count_ == kMaxRows) heap_up();
  }
  /// The same where `is_wanted`; without a branch while there is room, for whoever cannot foresee which rows bind.
  void add_if(bool is_wanted, const HalfPlane& half_plane, const HoldingRow& what) noexcept {
    if (count_ + 1 < kMaxRows) {
      half_planes_[count_] = half_plane;
      whats_[count_] = what;
      count_ += is_wanted ? 1 : 0;
    } else if (is_wanted) {
      add(half_plane, what);
    }
  }

  [[nodiscard]] std::span<const HalfPlane> half_planes() const { return std::span(half_planes_).first(count_); }
  [[nodiscard]] const HoldingRow& what(std::size_t row) const { return whats_[row]; }
  /// Whether some had to be left out.
  [[nodiscard]] bool is_crowded() const { return is_crowded_; }

 private:
  void heap_up() noexcept;
  void replace(const HalfPlane& half_plane, const HoldingRow& what) noexcept;

  std::array<HalfPlane, kMaxRows> half_planes_;
  std::array<HoldingRow, kMaxRows> whats_;
  std::size_t count_ = 0;
  bool is_crowded_ = false;
};

}  // namespace vigil::safety
