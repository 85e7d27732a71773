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
  /// The row of a neighbour, where `is_wanted`. Number by number and, while there is room, without a branch: many are
  /// added, nobody can foresee which bind, and what was just written in parts is slow to read as a whole.
  void add_neighbour_if(bool is_wanted, const HalfPlane& half_plane, int index, double distance_m) noexcept {
    if (count_ + 1 >= kMaxRows) {
      if (is_wanted) add(half_plane, {RowKind::kNeighbour, index, distance_m});
      return;
    }
    HalfPlane& row = half_planes_[count_];
    row.normal.x() = half_plane.normal.x();
    row.normal.y() = half_plane.normal.y();
    row.offset = half_plane.offset;
    row.priority = half_plane.priority;
    HoldingRow& what = whats_[count_];
    what.kind = RowKind::kNeighbour;
    what.index = index;
    what.distance_m = distance_m;
    count_ += is_wanted ? 1 : 0;
  }

  [[nodiscard]] std::span<const HalfPlane> half_planes() const { return std::span(half_planes_).first(count_); }
  [[nodiscard]] const HoldingRow& what(std::size_t row) const { return whats_[row]; }
  [[nodiscard]] std::span<const HoldingRow> whats() const { return std::span(whats_).first(count_); }
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
