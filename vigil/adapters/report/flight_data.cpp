#include "vigil/adapters/report/flight_data.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/report/report_error.hpp"
#include "vigil/runtime/chosen_evenly.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::report {
namespace {

using runtime::RecordedFlight;

void check_drones(const RecordedFlight& flight, const runtime::Mission& mission) {
  if (flight.tick_count() == 0) throw ReportError("the recording has no tick; fly the mission again");
  const bool same = std::equal(flight.drones.begin(), flight.drones.end(), mission.drones.begin(), mission.drones.end(),
                               [](const std::string& id, const runtime::DroneEntry& entry) { return id == entry.id; });
  if (!same) {
    throw ReportError(
        fmt::format("the recording's {} drones are not the {} of its mission.yaml; give the mission that was flown",
                    flight.drones.size(), mission.drones.size()));
  }
}

std::vector<double> steps_of(const std::vector<double>& times, double rate_hz) {
  std::vector<double> steps;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) steps.push_back(times[k + 1] - times[k]);
  steps.push_back(1.0 / rate_hz);
  return steps;
}

std::vector<ActiveChange> changes_of(const RecordedFlight& flight) {
  std::vector<ActiveChange> changes;
  for (std::size_t tick = 1; tick < flight.tick_count(); ++tick) {
    ActiveChange change{tick, {}, {}};
    for (std::size_t i = 0; i < flight.drones.size(); ++i) {
      const bool was = flight.is_active(tick - 1, i);
      if (was && !flight.is_active(tick, i)) change.lost.push_back(i);
      if (!was && flight.is_active(tick, i)) change.returned.push_back(i);
    }
    if (!change.lost.empty() || !change.returned.empty()) changes.push_back(std::move(change));
  }
  return changes;
}

std::string reason(swarm::Activity activity) {
  switch (activity) {
    case swarm::Activity::kLanding:
      return "landing";
    case swarm::Activity::kGrounded:
      return "landed";
    case swarm::Activity::kEmergencyStop:
      return "motors stopped";
    case swarm::Activity::kOverridden:
      return "flown by a pilot";
    case swarm::Activity::kTrackingLost:
      return "not tracked";
    case swarm::Activity::kLinkLost:
      return "link lost";
    case swarm::Activity::kBatteryLow:
      return "battery low";
    case swarm::Activity::kHeld:
      return "held";
    default:
      return "failed";
  }
}

}  // namespace

std::size_t FlightData::tick_at(double time_s) const {
  constexpr double kRounding = 1e-9;
  const std::vector<double>& times = flight.ticks.time_s;
  const auto after = std::upper_bound(times.begin(), times.end(), time_s + kRounding);
  return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

const ActiveChange* FlightData::first_loss() const {
  const auto found =
      std::find_if(changes.begin(), changes.end(), [](const auto& change) { return !change.lost.empty(); });
  return found == changes.end() ? nullptr : &*found;
}

std::string FlightData::describe(const ActiveChange& change) const {
  if (change.lost.size() == 1) {
    const std::size_t drone = change.lost.front();
    return fmt::format("{} {}", flight.drones[drone], reason(flight.rows.activity[flight.row(change.tick, drone)]));
  }
  if (change.lost.size() > 1) return fmt::format("{} drones lost", change.lost.size());
  if (change.returned.size() == 1) return fmt::format("{} back", flight.drones[change.returned.front()]);
  return fmt::format("{} drones back", change.returned.size());
}

FlightData prepare(const RecordedFlight& flight, const runtime::Mission& mission) {
  check_drones(flight, mission);
  FlightData data{flight, mission, runtime::monitored_field(mission), false, {}, {}, {}, {}, {}};
  const field::WorldFrame frame = runtime::world_frame(mission);
  data.has_truth = std::any_of(flight.rows.true_position_m.begin(), flight.rows.true_position_m.end(),
                               [](const Vec2& p) { return p.allFinite(); });
  data.positions.reserve(flight.rows.position_m.size());
  data.commands.reserve(flight.rows.command_m_s.size());
  for (const Vec2& p : data.has_truth ? flight.rows.true_position_m : flight.rows.position_m) {
    data.positions.push_back(frame.point_to_field(p));
  }
  for (const Vec2& u : flight.rows.command_m_s) data.commands.push_back(frame.vector_to_field(u));
  data.steps_s = steps_of(flight.ticks.time_s, mission.control.rate_hz);
  data.changes = changes_of(flight);
  data.drawn = runtime::chosen_evenly(data.drones(), kMostDrawn);
  return data;
}

}  // namespace vigil::report
