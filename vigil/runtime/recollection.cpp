#include "vigil/runtime/recollection.hpp"

#include "vigil/swarm/activity.hpp"

namespace vigil::runtime {
namespace {

void show(const swarm::DroneMemory& memory, double reserve, swarm::DroneSnapshot& drone) noexcept {
  const swarm::DroneObservation& known = memory.last_good;
  drone.position = known.position;
  drone.velocity = known.velocity;
  drone.height_m = known.height_m;
  drone.age_s = known.age_s;
  drone.link_age_s = known.link_age_s;
  drone.battery = known.battery;
  drone.mode = known.mode;
  drone.time_left = memory.energy.time_to(reserve);
}

}  // namespace

Recollection::Recollection(const RecordingHead& head)
    : dt_s_(head.parameters.dt_s),
      reserve_(head.parameters.health.battery_reserve),
      is_thinned_(head.keep_every > 1),
      drones_(head.parameters.drones) {
  const std::vector<Vec2>& starts = head.parameters.starts;
  for (std::size_t i = 0; i < starts.size() && i < drones_.size(); ++i) drones_[i].last_good.position = starts[i];
}

void Recollection::complete(RecordedTick& tick) noexcept {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    if (is_thinned_)
      drones_[i].last_good = tick.observations[i];
    else
      swarm::remember(drones_[i], tick.observations[i], dt_s_);
    show(drones_[i], reserve_, tick.snapshot.drones[i]);
  }
}

}  // namespace vigil::runtime
