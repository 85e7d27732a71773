#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/safety/body.hpp"
#include "vigil/core/safety/neighbour_grid.hpp"
#include "vigil/core/safety/planar_qp.hpp"

namespace vigil::safety {

enum class RowKind : std::uint8_t { kNeighbour, kWall, kNoFly };

/// A constraint that holds a drone's velocity where it is.
struct HoldingRow {
  RowKind kind = RowKind::kNeighbour;
  int index = -1;           ///< of the other body, the wall (0 left, 1 right, 2 bottom, 3 top) or the no-fly edge
  double distance_m = 0.0;  ///< between positions, or from the wall or edge (signed)
};

/// What the filter did to one drone in one tick.
struct FilterReport {
  std::array<HoldingRow, 2> holding{};
  int holding_count = 0;
  bool speed_limited = false;   ///< the disk |u| <= u_max holds u
  bool margin_used = false;     ///< no velocity kept everything: what lost drones might do, then margins gave way
  bool fallback = false;        ///< no velocity kept even those: the least violation was taken
  double violation_m_s = 0.0;   ///< how far the worst of those rows is from being satisfied then
  bool input_rejected = false;  ///< its own state or nominal velocity was not finite: u = 0
  bool crowded = false;         ///< more rows than kMaxRows: the most pressing ones were kept
  double correction_m_s = 0.0;  ///< |u - u_nom|
  int nearest = -1;             ///< index of the nearest obstacle within sensing range, -1 for none
  double nearest_distance_m = 0.0;
};

/// A constraint of (10) as one drone was given it.
struct GivenRow {
  HalfPlane half_plane;
  HoldingRow what;
};

/// Why one drone's velocity is what it is.
struct Explanation {
  Vec2 u_nom = Vec2::Zero();   ///< what was wanted, m/s
  Vec2 u = Vec2::Zero();       ///< what the filter made of it, m/s
  std::vector<GivenRow> rows;  ///< all that the solver was given, of the relaxed problem where that was needed
  FilterReport report;
};

/// The safety filter: (10) solved exactly for every controlled drone, with gamma_d(h) = min(gamma(h), h / (2 dt)) for
/// pairs and h / dt for walls, no-fly edges and bodies nobody controls, so that zero-order hold never breaks the
/// guarantee; for h < 0 a linear rate of escape. Owns its work space, sized by `capacity` drones: run() allocates
/// nothing. One thread at a time. Same input, same bits.
class Filter {
 public:
  Filter(const BarrierParameters& parameters, const field::Field& field, std::size_t capacity);

  /// Precondition: all spans but `no_fly` have the same length, at most capacity. Bodies may be anything, also NaN.
  /// `no_fly` holds the edges of any number of polygons, each polygon's as field::edges() gives them.
  /// u[i] = 0 where bodies[i].is_controlled is false. Every |u[i]| <= u_max and finite.
  void run(std::span<const Body> bodies, std::span<const field::Segment> no_fly, std::span<const Vec2> u_nom,
           std::span<Vec2> u, std::span<FilterReport> reports) noexcept;

  /// What run() does to one drone, in full; no rows where it is not controlled. Allocates. Preconditions of run(), and
  /// own < bodies.size().
  [[nodiscard]] Explanation explain(std::size_t own, std::span<const Body> bodies,
                                    std::span<const field::Segment> no_fly, const Vec2& u_nom);

  [[nodiscard]] const BarrierParameters& parameters() const { return parameters_; }

 private:
  void place(std::span<const Body> bodies) noexcept;
  void steer(std::size_t own, std::span<const Body> bodies, std::span<const field::Segment> no_fly, const Vec2& u_nom,
             Vec2& u, FilterReport& report) noexcept;
  [[nodiscard]] PlanarQpSolution solve_rows(const Vec2& u_nom) noexcept;
  void gather_pairs(std::size_t own, const Vec2& z, std::span<const Body> bodies, FilterReport& report) noexcept;
  void gather_lesser_pairs(std::size_t own, const Vec2& z, std::span<const Body> bodies, FilterReport& report) noexcept;
  void gather_walls(const Vec2& z, const Body& own, double reserve_m, Priority priority, FilterReport& report) noexcept;
  void gather_edges(const Vec2& z, const Body& own, std::span<const field::Segment> no_fly, double reserve_m,
                    Priority priority, FilterReport& report) noexcept;
  void gather_ways_out(const Vec2& z, const Body& own, std::span<const field::Segment> no_fly,
                       FilterReport& report) noexcept;
  void add(const HalfPlane& half_plane, const HoldingRow& what, FilterReport& report) noexcept;
  void write_report(const PlanarQpSolution& solution, const Vec2& u_nom, FilterReport& report) const noexcept;

  BarrierParameters parameters_;
  field::Field field_;
  NeighbourGrid grid_;
  std::vector<Vec2> points_;  ///< barrier_point() of every body; NaN where it is no obstacle for anybody
  double reach_m_ = 0.0;      ///< no body farther than this from another's point has a row
  std::array<GivenRow, kMaxRows> rows_;
  std::array<HalfPlane, kMaxRows> half_planes_;  ///< of rows_, as the solver takes them
  std::size_t row_count_ = 0;
};

}  // namespace vigil::safety
