#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vigil/core/ergodic/coverage_statistics.hpp"
#include "vigil/core/ergodic/kernel.hpp"
#include "vigil/core/ergodic/look_ahead.hpp"
#include "vigil/core/guidance/goal_seeker.hpp"
#include "vigil/core/guidance/way_finder.hpp"
#include "vigil/core/parallel/workers.hpp"
#include "vigil/core/safety/filter.hpp"
#include "vigil/swarm/basis_sums.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/fault_monitor.hpp"
#include "vigil/swarm/flown_orders.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/parameters.hpp"
#include "vigil/swarm/protection.hpp"
#include "vigil/swarm/recharging.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::swarm {

/// What a swarm knows of its past, apart from its drones: what a restarted program goes on from.
struct SwarmPast {
  std::uint64_t ticks = 0;
  double first_metric = 0.0;
  bool has_first_metric = false;
  ergodic::CoverageRecord coverage;
};

/// The whole controller between two ticks, as one value: copy it and run the copy ahead to look into the future. A copy
/// may allocate in its first ticks. It knows of no threads: whoever calls tick() brings workers or does without.
class SwarmState {
 public:
  /// Precondition: parameters that mission checks accepted. Allocates all that ticks will ever need.
  explicit SwarmState(const SwarmParameters& parameters);

  [[nodiscard]] const SwarmParameters& parameters() const { return parameters_; }
  [[nodiscard]] const ergodic::Basis& basis() const { return basis_; }
  [[nodiscard]] const CoverageTarget& target() const { return target_; }
  /// Whom the target's protected parts leave how much.
  [[nodiscard]] const ProtectedShare& protection() const { return protection_.share(); }
  [[nodiscard]] const ergodic::CoverageStatistics& statistics() const { return statistics_; }
  /// How many ticks have been run.
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  /// What is remembered of every drone.
  [[nodiscard]] std::span<const DroneMemory> drones() const { return drones_; }
  /// How a drone will move, as far as its orders tell, when the next tick's orders begin to act on it. Precondition:
  /// drone.index() < parameters().drones.
  [[nodiscard]] Motion next_motion(DroneId drone) const noexcept;

  /// What the safety filter did to a drone in the newest tick, in full. Field frame. Allocates. Precondition: ticks() >
  /// 0, drone.index() < parameters().drones.
  [[nodiscard]] safety::Explanation explain(DroneId drone) const;

  /// Makes a copy into a model of the flight: from now on a tick lasts dt_s, and what it orders acts at once on drones
  /// that are seen as they are. For looking ahead, from next_motion() on: where delays are made up for, the flight goes
  /// like that, by so much later. Precondition: dt_s > 0. Allocates.
  void become_model(double dt_s);

  /// Allocates nothing where `out` has been written before.
  void write_past(SwarmPast& out) const;
  /// Before the first tick: goes on from what was written. False, and nothing changed, where it does not fit.
  [[nodiscard]] bool read_past(const SwarmPast& past);

 private:
  friend void tick(SwarmState& state, std::span<const DroneObservation> observations, std::span<const Command> commands,
                   Snapshot& out, parallel::Workers* workers) noexcept;

  /// Drones that one thread looks after before it asks for more.
  static constexpr std::size_t kPart = 512;
  static constexpr std::size_t parts_of(std::size_t drones) { return (drones + kPart - 1) / kPart; }

  /// What one part of the drones comes to.
  struct alignas(64) PartNote {
    std::size_t active = 0;        ///< how many
    std::size_t first_active = 0;  ///< how many are before them
    bool has_change = false;       ///< of an activity
    bool has_traveller = false;
    bool has_starter = false;  ///< wants to take off
    bool has_stray = false;    ///< nobody steers it, and it may meet others
    bool has_fallback = false;
  };
  /// Calls body(index, note) for every drone, part by part.
  template <typename Body>
  void for_each_drone(parallel::Workers* workers, Body&& body) noexcept;
  [[nodiscard]] bool is_any(bool PartNote::* what) const noexcept;

  void take_commands(std::span<const Command> commands, Snapshot& out) noexcept;
  void take_wish(const Command& command, Snapshot& out) noexcept;
  void set_target(const CoverageTarget& target) noexcept;
  [[nodiscard]] const DroneObservation& believed(std::size_t index,
                                                 std::span<const DroneObservation> observations) const noexcept;
  void judge_drones(std::span<const DroneObservation> observations, bool are_remembered, Snapshot& out,
                    parallel::Workers* workers) noexcept;
  void predict(std::size_t index) noexcept;
  void gather_active(parallel::Workers* workers) noexcept;
  void cover(Snapshot& out, parallel::Workers* workers) noexcept;
  void measure_coverage(Snapshot& out, parallel::Workers* workers) noexcept;
  void go_down_the_gradient(parallel::Workers* workers) noexcept;
  void look_ahead() noexcept;
  void seek_goals() noexcept;
  void keep_safe(parallel::Workers* workers) noexcept;
  void add_doubted_places() noexcept;
  void step_aside() noexcept;
  /// Whose place a body of the filter is; -1 is nobody's.
  [[nodiscard]] int drone_of(int body) const noexcept;
  void name_holders(safety::FilterReport& report) const noexcept;
  void write_orders(Snapshot& out, parallel::Workers* workers) noexcept;
  void write_order(std::size_t index, DroneSnapshot& to) noexcept;
  void sort_air(parallel::Workers* workers) noexcept;
  /// Nobody flies so close above a grounded drone, nor comes so fast, that it would come up into its way; and the
  /// others have known of it for as long as they take to answer.
  [[nodiscard]] bool has_clear_air(std::size_t index) const noexcept;
  [[nodiscard]] safety::Body body_of(std::size_t index) const noexcept;
  [[nodiscard]] double assumed_age(const DroneMemory& drone) const noexcept;
  [[nodiscard]] double longest_assumed_age_s() const noexcept;
  [[nodiscard]] bool may_be_flown_to(const Vec2& place) const noexcept;
  [[nodiscard]] guidance::Traveller traveller(std::size_t index) noexcept;
  [[nodiscard]] Vec2 within_walls(const Vec2& place) const noexcept;

  SwarmParameters parameters_;
  ergodic::Basis basis_;
  std::vector<ergodic::Kernel> kernels_;  ///< one for each thread that may share a tick
  BasisSums sums_;
  ergodic::CoverageStatistics statistics_;
  ergodic::LookAhead look_ahead_;
  guidance::GoalSeeker goal_seeker_;
  guidance::WayFinder ways_;
  safety::Filter filter_;
  safety::NeighbourGrid air_;  ///< where drones are in the air, of a tick in which somebody wants to take off
  FlownOrders flown_;
  FaultMonitor monitor_;
  Recharging recharging_;
  CoverageTarget target_;
  Protection protection_;
  double fade_delta_ = 0.0;
  double first_metric_ = 0.0;
  bool has_first_metric_ = false;
  std::uint64_t ticks_ = 0;
  std::size_t active_set_ = 0;  ///< a number that grows whenever other drones are active
  std::vector<DroneMemory> drones_;

  // Work space of one tick.
  std::vector<PartNote> notes_;
  std::vector<Activity> activities_before_;
  std::vector<std::uint32_t> active_;
  std::vector<std::uint32_t> active_before_;
  std::vector<Vec2> active_positions_;
  std::vector<ergodic::Departure> departures_;  ///< of the active drones; kLookAhead
  std::vector<Vec2> active_u_;
  std::vector<Motion> motions_;    ///< of all drones, as they will be when this tick's orders begin to act
  std::vector<double> seen_ages_;  ///< of all drones: their observations' ages in the last tick
  std::vector<guidance::Traveller> travellers_;
  std::vector<Vec2> travel_u_;
  std::vector<safety::Body> bodies_;    ///< of all drones; then those of `doubted_`
  std::vector<std::uint32_t> doubted_;  ///< drones that may be elsewhere, as well
  std::vector<Vec2> u_nom_;
  std::vector<Vec2> u_;
  std::vector<safety::FilterReport> reports_;
  ergodic::Coefficients c_k_;
  ergodic::Coefficients a_k_;
};

/// One control tick: takes in `observations` (one per drone), applies `commands`, adds to the coverage statistics, asks
/// the ergodic controller where to go and the safety filter what of it is allowed, and writes orders and reasons to
/// `out`. Pure: it depends on nothing but its arguments; it reads no clock, takes no lock, opens nothing, allocates
/// nothing. The tick lasts parameters().dt_s. Precondition: as many observations, and drones in `out`, as drones;
/// whatever is in the observations. A command for a drone that does not exist, or a target of the wrong shape, is
/// refused with an event. With workers the drones are shared out among them, the same bits come out for any number of
/// threads; fewer than some hundred drones are not worth it and stay with the caller.
void tick(SwarmState& state, std::span<const DroneObservation> observations, std::span<const Command> commands,
          Snapshot& out, parallel::Workers* workers = nullptr) noexcept;

template <typename Body>
void SwarmState::for_each_drone(parallel::Workers* workers, Body&& body) noexcept {
  parallel::for_each_part(workers, drones_.size(), kPart, [&](std::size_t first, std::size_t last, std::size_t) {
    PartNote& note = notes_[first / kPart];
    for (std::size_t index = first; index < last; ++index) body(index, note);
  });
}

}  // namespace vigil::swarm
