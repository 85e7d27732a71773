#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vigil/runtime/mission.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// The word under which an event says that something is wrong with a drone, unwished: the monitor's (swarm::Fault)
/// where it has one, else the activity's. Empty for every other event.
[[nodiscard]] std::string_view alarm_of(const swarm::Event& event);

/// An event of the mission file that befalls a drone or a station, and what came of it.
struct Detection {
  double at_s = 0.0;
  std::string befell;                 ///< the event's word
  std::string drone;                  ///< as in the event: an id, or "all"; empty where it befell a station
  std::string station{};              ///< its name, else empty
  std::string noticed_as{};           ///< alarm_of() the first alarm; empty: it was not noticed
  std::optional<double> noticed_s{};  ///< after at_s; none: it was not noticed
};

/// What went wrong in a flight by the mission's own events, against what was noticed. Events that are shorter than what
/// may pass as lost packets need not be noticed.
class FaultTally {
 public:
  explicit FaultTally(const Mission& mission);

  /// Before the first add(): what befell before is not looked for.
  void begin_at(double from_s);
  void add(const swarm::Snapshot& snapshot);

  [[nodiscard]] const std::vector<std::pair<std::string, std::uint64_t>>& alarms() const noexcept { return alarms_; }
  /// In the order of the mission's events, those that have happened.
  [[nodiscard]] std::vector<Detection> detections() const;
  /// Alarms of the monitor (not of a lost link, a lost position or an empty battery, which are as they are) about
  /// drones that nothing befell, nor less than kAfterwardsS ago. Where the simulated tracker exchanges drones by
  /// itself, what that looks like is left out.
  [[nodiscard]] std::uint64_t false_alarms() const noexcept { return false_alarms_; }

  static constexpr double kAfterwardsS = 15.0;

 private:
  struct Happening {
    Detection detection;
    std::vector<std::size_t> drones;  ///< empty: all of them
    std::optional<std::size_t> station;
    double end_s = 0.0;
    [[nodiscard]] bool concerns(std::size_t drone) const;
  };

  void take(const swarm::Event& event, std::string_view word, double now_s);
  void take_station(const swarm::Event& event, double now_s);
  void count(std::string_view word);

  std::vector<Happening> happenings_;  ///< in the order of time
  std::size_t begun_ = 0;
  std::vector<std::pair<std::string, std::uint64_t>> alarms_;
  std::uint64_t false_alarms_ = 0;
  bool confuses_bodies_;
};

}  // namespace vigil::runtime
