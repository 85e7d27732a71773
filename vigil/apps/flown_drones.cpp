#include "vigil/apps/flown_drones.hpp"

#include <algorithm>

namespace vigil::apps {
namespace {

using swarm::VehicleMode;

/// An operator may let one take off meanwhile, and a full queue takes nothing.
constexpr int kAsksALanding = 10;

/// Not those of a pilot: they may be in the air for as long as he likes.
bool is_flown(const swarm::DroneSnapshot& drone) {
  return drone.mode == VehicleMode::kTakingOff || drone.mode == VehicleMode::kFlying ||
         drone.mode == VehicleMode::kLanding;
}

}  // namespace

void FlownDrones::watch(const std::shared_ptr<runtime::ShownFlight>& flight) {
  const std::lock_guard lock(mutex_);
  flight_ = flight;
}

std::shared_ptr<runtime::ShownFlight> FlownDrones::newest() const {
  const std::lock_guard lock(mutex_);
  return flight_.lock();
}

bool FlownDrones::any(bool (*predicate)(const swarm::DroneSnapshot&)) const {
  const std::shared_ptr<runtime::ShownFlight> flight = newest();
  if (!flight) return false;
  runtime::LiveFrame frame(flight->mission().drones.size());
  std::size_t version = 0;
  return flight->read(frame, version) && std::ranges::any_of(frame.snapshot.drones, predicate);
}

bool FlownDrones::are_in_the_air() const { return any(runtime::is_airborne); }

bool FlownDrones::are_down(const std::function<void()>& tell) {
  if (!any(is_flown)) return true;
  if (asked_ == 0) tell();
  if (asked_++ % kAsksALanding == 0) land();
  return false;
}

void FlownDrones::land() {
  runtime::LiveCommand all;
  all.swarm.kind = swarm::CommandKind::kLand;
  if (const std::shared_ptr<runtime::ShownFlight> flight = newest()) (void)flight->submit({all});
}

}  // namespace vigil::apps
