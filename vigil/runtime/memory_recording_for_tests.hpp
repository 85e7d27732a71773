#pragma once

#include <string>
#include <vector>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/live_world_for_tests.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::runtime {

/// Keeps a flight in memory, as a recorder does on a disk.
struct KeptFlight final : Recorder {
  RecordingHead head;
  std::vector<RecordedTick> ticks;

  void begin(const Mission& mission, const FlightStart& start) override {
    head.parameters = swarm_parameters(mission, start.first_intent);
    head.start = start;
  }
  void record(const TickRecord& tick) noexcept override {
    RecordedTick& kept = ticks.emplace_back(tick.observations.size());
    kept.observations.assign(tick.observations.begin(), tick.observations.end());
    kept.commands.assign(tick.commands.begin(), tick.commands.end());
    kept.snapshot = tick.snapshot;
    kept.truth.assign(tick.truth.begin(), tick.truth.end());
    kept.clearances = tick.clearances;
  }
  void log(const LoggedEvent&) noexcept override {}
  void targets(double, const MissionTargets&) noexcept override {}
  void finish() override {}
};

/// Reads what was kept.
class KeptRecording final : public FlightRecording {
 public:
  explicit KeptRecording(KeptFlight kept) : kept_(std::move(kept)) {}
  [[nodiscard]] const RecordingHead& head() const override { return kept_.head; }
  [[nodiscard]] std::uint64_t tick_count() const override { return kept_.ticks.size(); }
  void read(std::uint64_t number, RecordedTick& into) override { into = kept_.ticks.at(number); }
  [[nodiscard]] std::span<const RecordedTargets> targets() const override { return {}; }
  [[nodiscard]] std::span<const LoggedEvent> events() const override { return {}; }
  [[nodiscard]] const std::string& incomplete_reason() const override { return reason_; }

 private:
  KeptFlight kept_;
  std::string reason_;
};

/// The small mission, flown for so many ticks, one drone sent down on the way.
[[nodiscard]] inline KeptFlight kept_flight(std::uint64_t ticks) {
  const Mission mission = small_mission("simulation: {events: [{at_s: 2, do: land, drone: b}]}\n");
  ObedientFleet fleet(starts_in_field(mission));
  KeptFlight kept;
  kept.begin(mission, {first_intent(mission), {}});
  VirtualFlight flight(mission, fleet, &kept, [] { return std::chrono::nanoseconds{}; });
  while (flight.ticks_flown() < ticks) flight.step();
  return kept;
}

}  // namespace vigil::runtime
