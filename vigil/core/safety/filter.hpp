#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/parallel/workers.hpp"
#include "vigil/core/safety/body.hpp"
#include "vigil/core/safety/body_columns.hpp"
#include "vigil/core/safety/neighbour_grid.hpp"
#include "vigil/core/safety/pair_rows.hpp"
#include "vigil/core/safety/pair_screen.hpp"
#include "vigil/core/safety/planar_qp.hpp"
#include "vigil/core/safety/planar_qp_batch.hpp"
#include "vigil/core/safety/row_set.hpp"

namespace vigil::safety {

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

/// Why one drone's velocity is what it is.
struct Explanation {
  Vec2 u_nom = Vec2::Zero();   ///< what was wanted, m/s
  Vec2 u = Vec2::Zero();       ///< what the filter made of it, m/s
  std::vector<GivenRow> rows;  ///< all that the solver was given, of the relaxed problem where that was needed
  FilterReport report;
};

/// How old, and how wayward, the bodies of a tick are at worst. Those that are not finite do not count.
struct Extremes {
  double age_s = 0.0;
  bool is_any_uncontrolled = false;
  double uncooperative_speed_m_s = 0.0;  ///< of those

  void include(const Body& body) noexcept;
  void include(const Extremes& others) noexcept;
};

/// The safety filter: (10) solved exactly for every controlled drone, with gamma_d(h) = min(gamma(h), h / (2 dt)) for
/// pairs and h / dt for walls, no-fly edges and bodies nobody controls, so that zero-order hold never breaks the
/// guarantee; for h < 0 a linear rate of escape. Owns its work space, sized by `capacity` drones: run() allocates
/// nothing. One call at a time. Same input, same bits, whatever the number of threads and the instruction set.
class Filter {
 public:
  Filter(const BarrierParameters& parameters, const field::Field& field, std::size_t capacity);

  /// The first bodies are steered, as many as there are of u_nom, u and reports; those after them, if any, are only
  /// kept clear of. Precondition: at most `capacity` bodies. They may be anything, also NaN.
  /// `no_fly` holds the edges of any number of polygons, each polygon's as field::edges() gives them.
  /// u[i] = 0 where bodies[i].is_controlled is false. Every |u[i]| <= u_max and finite. With workers the drones are
  /// shared out among them.
  void run(std::span<const Body> bodies, std::span<const field::Segment> no_fly, std::span<const Vec2> u_nom,
           std::span<Vec2> u, std::span<FilterReport> reports, parallel::Workers* workers = nullptr) noexcept;

  /// What run() does to one drone, in full; no rows where it is not controlled. Allocates. Preconditions of run(), and
  /// own < bodies.size().
  [[nodiscard]] Explanation explain(std::size_t own, std::span<const Body> bodies,
                                    std::span<const field::Segment> no_fly, const Vec2& u_nom);

  [[nodiscard]] const BarrierParameters& parameters() const { return parameters_; }

 private:
  /// What steering one drone after the other takes, beside what all share.
  struct Desk {
    RowSet rows;
    Screening screening;
    PairBatch batch{};  // also what is in columns that nobody filled is a number
    std::array<std::uint32_t, PairBatch::kSize> places;
    std::size_t gathered = 0;
    double nearest_m = 0.0;
  };

  /// What is given to run(), beside bodies.
  struct Task {
    std::span<const field::Segment> no_fly;
    std::span<const Vec2> u_nom;
    std::span<Vec2> u;
    std::span<FilterReport> reports;
  };

  /// Drones whose problems are solved together.
  struct Together {
    PlanarQpBatch problems;
    struct Drone {
      std::size_t place = 0;
      std::size_t own = 0;
      FilterReport report;
      std::array<HoldingRow, PlanarQpBatch::kMostRows> whats;  ///< of its rows
      std::size_t rows = 0;
    };
    std::array<Drone, PlanarQpBatch::kLanes> drones;
    std::size_t count = 0;
  };

  /// Which rows of neighbours are gathered: those that may hold the drone, or all.
  enum class Gather : std::uint8_t { kPressing, kAll };

  void place(std::span<const Body> bodies, parallel::Workers* workers) noexcept;
  void steer_alone(std::size_t place, std::size_t own, const Task& task, Desk& desk) const noexcept;
  void steer_together(std::size_t place, std::size_t own, const Task& task, Desk& desk,
                      Together& together) const noexcept;
  void finish_together(const Task& task, Desk& desk, Together& together) const noexcept;
  [[nodiscard]] Vec2 point_of(const Body& body) const noexcept;
  void steer(std::size_t place, std::size_t own, const Body& body, std::span<const field::Segment> no_fly,
             const Vec2& u_nom, Gather gather, Vec2& u, FilterReport& report, Desk& desk) const noexcept;
  [[nodiscard]] bool gather_pressing(std::size_t place, std::size_t own, const Body& body, const Vec2& z,
                                     std::span<const field::Segment> no_fly, const Vec2& u_nom, FilterReport& report,
                                     Desk& desk) const noexcept;
  void gather_fixed(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly,
                    RowSet& rows) const noexcept;
  void gather_pairs(std::size_t own, const Body& body, const Vec2& z, FilterReport& report, Desk& desk) const noexcept;
  void add_pairs(std::size_t own, const Body& body, const Vec2& z, FilterReport& report, Desk& desk) const noexcept;
  void add_pairs_one_by_one(std::size_t own, const Body& body, const Vec2& z, FilterReport& report,
                            Desk& desk) const noexcept;
  [[nodiscard]] std::optional<HalfPlane> row_beside(const Body& body, const Body& other,
                                                    const Vec2& u_nom) const noexcept;
  void gather_lesser_pairs(std::size_t own, const Body& body, const Vec2& z, const Vec2& u_nom,
                           RowSet& rows) const noexcept;
  void gather_walls(const Vec2& z, const Body& body, double reserve_m, Priority priority, RowSet& rows) const noexcept;
  void gather_edges(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly, double reserve_m,
                    Priority priority, RowSet& rows) const noexcept;
  void gather_ways_out(const Vec2& z, const Body& body, std::span<const field::Segment> no_fly,
                       RowSet& rows) const noexcept;
  void write_report(const PlanarQpSolution& solution, const Vec2& u_nom, std::span<const HoldingRow> whats,
                    FilterReport& report) const noexcept;

  BarrierParameters parameters_;
  field::Field field_;
  double lag_s_;  ///< of barrier_point()
  PairRows pair_rows_;
  PairScreen pair_screen_;
  NeighbourGrid grid_;
  // In the order of the grid: what is near in the field is near in memory.
  std::vector<Body> bodies_;
  BodyColumns columns_;
  std::vector<Extremes> extremes_;  ///< of each part of them
  bool are_all_fresh_ = false;      ///< all are controlled, and were seen just now
  double reach_m_ = 0.0;            ///< no body farther than this from another's point has a row
  double wall_reach_m_ = 0.0;       ///< no wall farther than this from a point has one
};

}  // namespace vigil::safety
