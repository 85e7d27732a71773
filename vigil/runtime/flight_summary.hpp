#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "vigil/runtime/energy_tally.hpp"
#include "vigil/runtime/fault_tally.hpp"
#include "vigil/runtime/flight_audit.hpp"
#include "vigil/runtime/goal_script.hpp"
#include "vigil/runtime/lateness.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// summary.json: what one simulated flight came to. The same object for every run of a campaign.
struct FlightSummary {
  std::string mission;
  std::uint64_t seed = 0;
  double duration_s = 0.0;  ///< flown, not asked for
  bool complete = true;     ///< false where the flight was stopped before its time
  std::uint64_t ticks = 0;
  std::size_t drones = 0;
  std::optional<double> first_metric;  ///< none before the first sample
  double last_metric = 0.0;
  double last_percent = 0.0;
  std::vector<std::pair<double, double>> percent_at;  ///< seconds, percent of the first metric
  AuditTotals audit;
  std::uint64_t fallback_ticks = 0;
  std::optional<GoalTally> goals;                               ///< where the mission has goals
  std::vector<std::pair<std::string, double>> worst_revisit_s;  ///< per cluster and area
  std::vector<std::pair<std::string, std::uint64_t>> faults;    ///< what was noticed, by its word, and how often
  std::vector<Detection> detections;  ///< what befell drones by the mission's events, and when it was noticed
  std::uint64_t false_alarms = 0;     ///< FaultTally::false_alarms()
  std::vector<std::pair<double, std::size_t>> active;  ///< each change of |I_a(t)|
  std::optional<EnergyTally> energy;                   ///< where the mission has batteries
  double tick_us_p50 = 0.0;  ///< wall-clock, the only figures that differ between two runs of one seed
  double tick_us_p99 = 0.0;
  double tick_us_max = 0.0;
  std::string accounting;
  std::string controller;
  std::string barrier;
};

[[nodiscard]] nlohmann::ordered_json to_json(const FlightSummary& summary);

/// Collects a summary tick by tick.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(const Mission& mission);

  /// Before the first add(): only what follows from this moment of the flight on is added. Nothing is told of moments
  /// before it, duration_s is that of the rest, and `first_metric` is what the flight began with, where it had begun.
  void begin_at(double from_s, std::optional<double> first_metric);

  void add(const swarm::Snapshot& snapshot, double tick_us);
  [[nodiscard]] FlightSummary finish(const AuditTotals& audit,
                                     std::vector<std::pair<std::string, double>> worst_revisit_s,
                                     const std::optional<GoalTally>& goals = std::nullopt) const;

 private:
  FlightSummary summary_;
  FaultTally faults_;
  std::vector<double> ask_percent_at_s_;  ///< ascending; those before next_ask_ are answered
  std::size_t next_ask_ = 0;
  Lateness tick_times_;
  double from_s_ = 0.0;  ///< mission time before the first tick that is added
  double asked_duration_s_;
  double dt_s_;
};

}  // namespace vigil::runtime
