#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

/// What a swarm notices of a fault, against what a simulator knows. For tests and benchmarks.
namespace vigil::runtime {

/// The rows of docs/fault-matrix.md.
enum class Misfortune : std::uint8_t {
  kHidden,     ///< the tracker sees it no more
  kCutOff,     ///< nothing passes between it and the ground
  kFrozen,     ///< the tracker repeats its last place
  kJumped,     ///< the tracker sees it elsewhere
  kSwapped,    ///< the tracker takes it and the nearest one for each other
  kSkewed,     ///< its velocity is reported wrongly
  kDeaf,       ///< it flies on as it flew
  kDrifting,   ///< it flies beside what it is told
  kFliesAway,  ///< it flies out of the field, whatever it is told
  kLands,      ///< it lands by itself
  kPiloted,    ///< a pilot takes it unasked
  kFailed      ///< it says that it failed, and follows nobody
};

inline constexpr std::array<std::string_view, 12> kMisfortuneWords{
    "hidden", "cut off",  "frozen",     "jumped",          "swapped",       "velocity skewed",
    "deaf",   "drifting", "flies away", "lands by itself", "pilot unasked", "failed"};

/// For so long at most it may go unnoticed, from the moment when it shows: at once, but for kDeaf and kDrifting, which
/// show when the drone is twice as far from where its latest orders lead as noise, gusts and lost orders explain, and
/// kFliesAway, which shows when it is outside. Derived: docs/derivations/faults.md.
[[nodiscard]] double stated_time_s(const Mission& mission, Misfortune misfortune);

struct FaultTrial {
  bool has_shown = false;          ///< what has not shown cannot be noticed
  bool is_noticed = false;         ///< until the end of the trial
  bool is_in_time = false;         ///< within stated_time_s()
  bool is_named_rightly = false;   ///< by what stood there last within that time
  double delay_s = 0.0;            ///< from when it showed; negative: it was noticed before
  double unnoticed_s = 0.0;        ///< from when it befell
  std::uint64_t false_alarms = 0;  ///< a monitor's, of drones with which nothing is wrong
  std::uint64_t close_ticks = 0;   ///< ticks x pairs closer than separation_m, the faulty one among them
  /// Pairs that came closer than separation_m though the other one could still have kept away when the fault was
  /// noticed, or should have been (could_evade()); all such pairs where the faulty one follows its orders.
  std::uint64_t evadable_pairs = 0;
  std::uint64_t contact_ticks = 0;           ///< ticks x pairs closer than contact_distance_m
  std::uint64_t others_violation_ticks = 0;  ///< of the others: separation, walls, no-fly
};

using MakeFleet = std::function<std::unique_ptr<VirtualFleet>(const Mission&)>;

/// The mission as it is flown in trials: nothing goes wrong by itself but noise, gusts and losses.
[[nodiscard]] Mission trial_mission(Mission mission);

/// Flies the mission (trial_mission() of it) until a random moment, lets the misfortune befall a random drone, and
/// flies on. The same seed gives the same trial. Precondition: at least two drones.
[[nodiscard]] FaultTrial fly_trial(const Mission& mission, const MakeFleet& make_fleet, Misfortune misfortune,
                                   std::uint64_t seed);

/// False alarms in a flight of the mission for so long, in which nothing goes wrong.
[[nodiscard]] std::uint64_t false_alarms(const Mission& mission, const MakeFleet& make_fleet, std::uint64_t seed,
                                         double seconds);

}  // namespace vigil::runtime
