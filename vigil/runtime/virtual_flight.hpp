#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vigil/core/field/revisit.hpp"
#include "vigil/runtime/flight_audit.hpp"
#include "vigil/runtime/flight_script.hpp"
#include "vigil/runtime/flight_summary.hpp"
#include "vigil/runtime/goal_script.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// A monotonic clock; injected, so that only the program's outermost room knows the real one.
using Stopwatch = std::function<std::chrono::nanoseconds()>;

/// A whole mission flown as fast as it can be computed: script, fleet, tick, judge, recorder. One thread, and the
/// workers that it is given; the same bits with any number of them.
class VirtualFlight {
 public:
  /// Precondition: a mission that mission checks accepted; fleet, recorder and workers outlive this, of whom the last
  /// two may be null.
  VirtualFlight(Mission mission, VirtualFleet& fleet, Recorder* recorder, Stopwatch stopwatch,
                parallel::Workers* workers = nullptr);

  [[nodiscard]] std::uint64_t ticks_to_fly() const noexcept { return ticks_to_fly_; }
  [[nodiscard]] std::uint64_t ticks_flown() const noexcept { return state_.ticks(); }
  [[nodiscard]] bool is_over() const noexcept { return ticks_flown() >= ticks_to_fly_; }

  /// One tick: events, observation, control, judgement, record; then dt passes. Precondition: !is_over().
  void step();

  [[nodiscard]] const swarm::Snapshot& snapshot() const noexcept { return snapshot_; }
  [[nodiscard]] const swarm::SwarmState& state() const noexcept { return state_; }
  [[nodiscard]] FlightSummary summary() const;

 private:
  void retarget(double time_s, std::vector<swarm::Command>& commands);
  void watch(const std::string& name, std::vector<Vec2> places, double time_s);
  void watch_areas(double time_s);
  void log_snapshot_events();
  [[nodiscard]] std::string fault_in_words(const swarm::Event& event) const;

  Mission mission_;
  VirtualFleet& fleet_;
  Recorder* recorder_;
  Stopwatch stopwatch_;
  parallel::Workers* workers_;
  swarm::SwarmState state_;
  swarm::Snapshot snapshot_;
  FlightScript script_;
  std::optional<GoalScript> goals_;
  FlightAudit audit_;
  SummaryBuilder summary_;
  std::uint64_t ticks_to_fly_;
  std::vector<swarm::DroneObservation> observations_;
  std::vector<swarm::DroneOrder> orders_;
  std::vector<field::RevisitLog> areas_;
  std::vector<Vec2> watchers_;  ///< where the active drones really are
  double footprint_radius_m_;
  bool has_targets_to_set_ = true;
};

}  // namespace vigil::runtime
