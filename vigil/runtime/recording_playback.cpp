#include "vigil/runtime/recording_playback.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "vigil/runtime/least_clearances.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/recollection.hpp"
#include "vigil/runtime/recorded_targets.hpp"

namespace vigil::runtime {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Each kept tick, completed, in its order.
template <class Take>
void for_each_tick(FlightRecording& recording, const Take& take) {
  Recollection recollection(recording.head());
  RecordedTick tick(recording.head().parameters.drones);
  for (std::uint64_t number = 0; number < recording.tick_count(); ++number) {
    recording.read(number, tick);
    recollection.complete(tick);
    take(tick);
  }
}

void expect_drones(const FlightRecording& recording, const Mission& mission) {
  if (recording.head().parameters.drones != mission.drones.size())
    throw std::runtime_error("the recording has another number of drones than its mission; it is damaged");
}

/// Writes ticks as columns, world frame.
class Columns {
 public:
  Columns(const Mission& mission, RecordedFlight& flight) : frame_(world_frame(mission)), flight_(flight) {}

  void reserve(std::size_t ticks) {
    DroneColumns& rows = flight_.rows;
    const std::size_t n = ticks * flight_.drones.size();
    std::apply([&](auto&... columns) { (columns.reserve(n), ...); },
               std::tie(rows.mode, rows.activity, rows.position_m, rows.height_m, rows.velocity_m_s, rows.age_s,
                        rows.nominal_m_s, rows.action, rows.command_m_s, rows.held_by, rows.fallback,
                        rows.true_position_m, rows.true_height_m));
  }

  /// What a tick that is left out, or the next kept one, has to say of safety.
  void add_safety(const RecordedTick& tick) {
    least_ = least(least_, tick.clearances);
    fallback_ = fallback_ || tick.snapshot.fallback;
  }

  void add(const RecordedTick& tick) {
    const swarm::Snapshot& s = tick.snapshot;
    TickColumns& to = flight_.ticks;
    to.time_s.push_back(s.time_s);
    to.metric.push_back(s.has_metric ? s.metric : kNaN);
    to.metric_percent.push_back(s.has_metric ? s.metric_percent : kNaN);
    to.active.push_back(s.active);
    to.idle.push_back(s.idle);
    to.fallback.push_back(std::exchange(fallback_, false) ? 1 : 0);
    to.clearances.push_back(std::exchange(least_, {}));
    for (std::size_t i = 0; i < s.drones.size(); ++i) {
      add(s.drones[i]);
      add_truth(tick.truth.empty() ? nullptr : &tick.truth[i]);
    }
  }

 private:
  void add(const swarm::DroneSnapshot& drone) {
    const bool is_seen = drone.age_s != swarm::DroneObservation::kNever;
    DroneColumns& to = flight_.rows;
    to.mode.push_back(drone.mode);
    to.activity.push_back(drone.activity);
    to.position_m.push_back(frame_.point_to_world(drone.position));
    to.height_m.push_back(drone.height_m);
    to.velocity_m_s.push_back(frame_.vector_to_world(drone.velocity));
    to.age_s.push_back(is_seen ? drone.age_s : swarm::DroneObservation::kNever);
    to.nominal_m_s.push_back(frame_.vector_to_world(drone.u_nom));
    to.action.push_back(drone.order.action);
    to.command_m_s.push_back(frame_.vector_to_world(drone.order.velocity));
    to.held_by.push_back(nearest_holding(drone.filter));
    to.fallback.push_back(drone.filter.fallback ? 1 : 0);
  }

  void add_truth(const TruthSample* truth) {
    const Vec2 place = truth == nullptr ? Vec2(kNaN, kNaN) : frame_.point_to_world(truth->position);
    flight_.rows.true_position_m.push_back(place);
    flight_.rows.true_height_m.push_back(truth == nullptr ? kNaN : truth->height_m);
  }

  static std::optional<safety::HoldingRow> nearest_holding(const safety::FilterReport& report) {
    const auto* const end = report.holding.data() + report.holding_count;
    const auto* const row = std::min_element(report.holding.data(), end,
                                             [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
    return row == end ? std::nullopt : std::optional(*row);
  }

  field::WorldFrame frame_;
  RecordedFlight& flight_;
  Clearances least_;       ///< since the last kept tick
  bool fallback_ = false;  ///< since the last kept tick
};

/// The least distance between kept ticks with which no more than `most_rows` rows are kept, but for the last tick's.
std::size_t stride_for(std::uint64_t ticks, std::size_t drones, std::size_t most_rows) {
  const std::uint64_t affordable = std::max<std::uint64_t>(1, most_rows / drones);
  return (ticks + affordable - 1) / affordable;
}

}  // namespace

void play(FlightRecording& recording, const Mission& mission, Recorder& recorder) {
  expect_drones(recording, mission);
  recorder.begin(mission, recording.head().start);
  for (const RecordedTargets& targets : recording.targets())
    recorder.targets(targets.time_s, with(targets_of(mission), targets));
  for (const LoggedEvent& event : recording.events()) recorder.log(event);
  double last_s = 0.0;
  for_each_tick(recording, [&](const RecordedTick& tick) {
    last_s = tick.snapshot.time_s;
    recorder.record({tick.snapshot, tick.observations, tick.commands, tick.truth, tick.clearances});
  });
  if (!recording.incomplete_reason().empty())
    recorder.log({last_s, "recorder", "not_whole", "", recording.incomplete_reason()});
  recorder.finish();
}

RecordedFlight collect(FlightRecording& recording, const Mission& mission, std::size_t most_rows) {
  expect_drones(recording, mission);
  if (recording.tick_count() == 0)
    throw std::runtime_error("the recording has no complete tick; fly the mission again");
  RecordedFlight flight;
  flight.mission_text = recording.head().mission_text;
  for (const DroneEntry& drone : mission.drones) flight.drones.push_back(drone.id);
  flight.targets.assign(recording.targets().begin(), recording.targets().end());
  flight.events.assign(recording.events().begin(), recording.events().end());
  flight.incomplete_reason = recording.incomplete_reason();
  flight.is_complete = flight.incomplete_reason.empty();
  const std::uint64_t ticks = recording.tick_count();
  flight.every = stride_for(ticks, std::max<std::size_t>(1, flight.drones.size()), most_rows);
  Columns columns(mission, flight);
  columns.reserve(ticks / flight.every + 2);
  std::uint64_t number = 0;
  for_each_tick(recording, [&](const RecordedTick& tick) {
    columns.add_safety(tick);
    if (number % flight.every == 0 || number + 1 == ticks) columns.add(tick);
    ++number;
  });
  return flight;
}

}  // namespace vigil::runtime
