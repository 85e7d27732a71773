#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vigil/runtime/area_watch.hpp"
#include "vigil/runtime/predicted_fleet.hpp"
#include "vigil/swarm/tick.hpp"

/// Looking ahead: a copy of the swarm's state is run on in a model of its world, faster than time.
namespace vigil::runtime {

inline constexpr double kLongestPreviewS = 600.0;
/// An area is covered once it has this share of the attention that is asked for it.
inline constexpr double kCoveredShare = 0.9;
/// The points of all ghost trails together are at most so many, and at least two a drone.
inline constexpr std::size_t kMostGhostPoints = 15'000;

/// What is looked ahead from. A value.
struct PreviewStart {
  swarm::SwarmState state;   ///< between two ticks; at least one was run
  AreaWatch areas;           ///< what has been seen until now
  PredictedVehicle vehicle;  ///< of all drones
  double footprint_m = 0.0;  ///< a place within it of an active drone is seen
};

/// What is to be different.
struct PreviewChange {
  std::shared_ptr<const swarm::CoverageTarget> target;  ///< null: the present one
  std::vector<swarm::DroneId> without;                  ///< they land where they are
};

/// How the swarm does at one moment.
struct OutlookSample {
  double in_s = 0.0;  ///< from now
  double metric = 0.0;
  double metric_percent = 0.0;  ///< of its first value; 0 where nothing is to be covered
  double worst_age_s = 0.0;     ///< of all areas' age_s
  std::size_t active = 0;
};

/// How one cluster or area will fare.
struct AreaOutlook {
  TargetName what;
  double asked = 0.0;
  double achieved = 0.0;  ///< at the end
  /// Until achieved reaches kCoveredShare of asked; 0: it has; none: not until then.
  std::optional<double> covered_in_s = std::nullopt;
  /// Until every part of it has been seen, from now on; none: not until then.
  std::optional<double> seen_in_s = std::nullopt;
  double worst_age_s = 0.0;  ///< the longest that a part of it will have waited at any time from now on
  std::optional<double> deadline_s = std::nullopt;
};

/// A future, from now until `seconds` later. Field frame.
struct Outlook {
  double seconds = 0.0;
  double tick_s = 0.0;                 ///< of the model
  std::vector<OutlookSample> samples;  ///< at the first tick of every second, the first of now
  std::vector<AreaOutlook> areas;      ///< in the mission's order, clusters first
  /// Of two drones in the air, at any time; infinite without such a pair.
  double least_pair_m = std::numeric_limits<double>::infinity();
  double ghost_spacing_s = 0.0;  ///< between two points of a trail
  std::size_t ghost_points = 0;  ///< of each drone
  std::vector<Vec2> ghosts;      ///< all of drone 0, the first of now, all of drone 1, ...; NaN: never seen
};

/// The tick of the model: a whole multiple of the mission's that makes the figures honest and the answer quick.
[[nodiscard]] double preview_tick_s(double mission_tick_s, std::size_t drones) noexcept;

/// Runs `start` ahead for `seconds`, by the flight's own controller and filter in longer ticks. None where `cancelled`
/// became true, which is looked at in every tick. Deterministic: nothing depends on how long it takes. Precondition:
/// 0 < seconds <= kLongestPreviewS; the drones of `change` exist.
[[nodiscard]] std::optional<Outlook> look_into_future(PreviewStart start, const PreviewChange& change, double seconds,
                                                      const std::atomic<bool>& cancelled);

}  // namespace vigil::runtime
