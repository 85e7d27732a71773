#include "vigil/runtime/energy_tally.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace vigil::runtime {

using swarm::Activity;

void EnergyTally::add(const swarm::Snapshot& snapshot) {
  ++ticks_;
  const auto away =
      static_cast<std::uint64_t>(std::ranges::count_if(snapshot.drones, [](const swarm::DroneSnapshot& drone) {
        return drone.pad >= 0 && drone.activity != Activity::kActive;
      }));
  away_ticks_ += away;
  most_away_ = std::max(most_away_, away);
  for (const swarm::Event& event : snapshot.events) {
    if (event.kind == swarm::EventKind::kStationFailed) ++stations_failed_;
    const bool leaves = event.kind == swarm::EventKind::kActivityChanged && event.before == Activity::kCharging &&
                        event.after == Activity::kAboutToTakeOff;
    if (leaves) ++charges_;
  }
}

nlohmann::ordered_json EnergyTally::to_json(const AuditTotals& audit) const {
  using Json = nlohmann::ordered_json;
  const double mean_away = ticks_ > 0 ? static_cast<double>(away_ticks_) / static_cast<double>(ticks_) : 0.0;
  return {{"ran_empty", audit.ran_empty},
          {"least_charge", std::isfinite(audit.least_charge) ? Json(audit.least_charge) : Json(nullptr)},
          {"charges", charges_},
          {"mean_away", mean_away},
          {"most_away", most_away_},
          {"stations_failed", stations_failed_}};
}

}  // namespace vigil::runtime
