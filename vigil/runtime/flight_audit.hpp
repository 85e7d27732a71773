#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/core/safety/neighbour_grid.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/recorder.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// What counts as a violation.
struct AuditLimits {
  field::Field field;
  std::vector<field::Polygon> no_fly;
  double separation_m = 0.0;     ///< R_s
  double wall_distance_m = 0.0;  ///< R_wall
  double no_fly_buffer_m = 0.0;
  double speed_limit_m_s = 0.0;  ///< u_max
  /// Whether a vehicle itself is held to it, or only what it is ordered to fly: autopilots overshoot, gusts push.
  bool follows_exactly = true;
  double landed_height_m = 0.05;  ///< lower than this a drone is down
};

/// What the whole flight came to.
struct AuditTotals {
  Clearances least;                         ///< of all ticks
  double max_speed_m_s = 0.0;               ///< horizontal, of drones that the controller steered
  std::uint64_t separation_violations = 0;  ///< ticks x pairs of airborne drones closer than R_s
  // Not of a drone that a pilot flies, or has given back where or as fast as the controller never would, until it is
  // back within the limits: those are the pilot's.
  std::uint64_t wall_violations = 0;    ///< ticks x airborne drones closer than R_wall to the border, or outside
  std::uint64_t no_fly_violations = 0;  ///< ticks x airborne drones within the buffer of a no-fly polygon
  std::uint64_t ran_empty = 0;          ///< drones whose batteries were empty in the air
  double least_charge = std::numeric_limits<double>::infinity();  ///< of a battery in the air; infinity: there is none
  std::uint64_t speed_violations = 0;  ///< ticks x steered drones ordered (or, see follows_exactly, flying) above u_max
};

/// Judges a flight by ground truth, whatever the controller believed. A rounding of 1e-9 (m, m/s) is no violation.
class FlightAudit {
 public:
  FlightAudit(AuditLimits limits, std::size_t drones);

  /// The truth at one tick and the controller's snapshot of that tick (for who is active). No allocation.
  Clearances judge(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot) noexcept;
  [[nodiscard]] const AuditTotals& totals() const { return totals_; }

 private:
  void note_pilots(std::span<const TruthSample> truth) noexcept;
  [[nodiscard]] bool is_within_limits(const TruthSample& drone) const noexcept;
  void judge_pairs(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot, Clearances& now) noexcept;
  void judge_places(std::span<const TruthSample> truth, Clearances& now) noexcept;
  void judge_batteries(std::span<const TruthSample> truth) noexcept;
  void judge_speeds(std::span<const TruthSample> truth, const swarm::Snapshot& snapshot) noexcept;

  AuditLimits limits_;
  AuditTotals totals_;
  std::vector<std::size_t> airborne_;  ///< work space: drones in the air
  safety::NeighbourGrid near_;         ///< work space: where they are
  std::vector<std::uint8_t> piloted_;  ///< 1 from when a pilot takes a drone until it is back within the limits
};

}  // namespace vigil::runtime
