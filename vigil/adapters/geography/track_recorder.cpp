#include "vigil/adapters/geography/track_recorder.hpp"

#include <new>
#include <stdexcept>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::geography {

void TrackRecorder::begin(const runtime::Mission& mission, const runtime::FlightStart& /*start*/) {
  frame_ = runtime::world_frame(mission);
  freshness_s_ = mission.health.tracking_timeout_s;
  for (const runtime::DroneEntry& drone : mission.drones) tracks_.push_back({drone.id, {}});
  is_known_.assign(tracks_.size(), false);
  last_targets_ = runtime::targets_of(mission);
}

void TrackRecorder::record(const runtime::TickRecord& tick) noexcept {
  if (!has_begun_) began_s_ = next_s_ = tick.snapshot.time_s;
  has_begun_ = true;
  if (tick.snapshot.time_s < next_s_) return;
  next_s_ += step_s_;
  try {
    add(tick.snapshot);
  } catch (const std::bad_alloc&) {
    is_short_of_memory_ = true;
  }
}

void TrackRecorder::add(const swarm::Snapshot& snapshot) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const swarm::DroneSnapshot& drone = snapshot.drones[i];
    const bool is_known = drone.age_s <= freshness_s_;
    if (is_known) {
      auto& pieces = tracks_[i].pieces;
      if (!is_known_[i]) pieces.emplace_back();
      pieces.back().push_back({snapshot.time_s - began_s_, frame_.point_to_world(drone.position), drone.height_m});
    }
    is_known_[i] = is_known;
  }
}

void TrackRecorder::log(const runtime::LoggedEvent& /*event*/) noexcept {}

void TrackRecorder::targets(double /*time_s*/, const runtime::MissionTargets& targets) noexcept {
  try {
    last_targets_ = targets;
  } catch (const std::bad_alloc&) {
    is_short_of_memory_ = true;
  }
}

void TrackRecorder::finish() {
  if (is_short_of_memory_) throw std::runtime_error("the tracks do not fit into memory; take a larger --track-step");
  for (Track& track : tracks_) std::erase_if(track.pieces, [](const auto& piece) { return piece.size() < 2; });
}

}  // namespace vigil::geography
