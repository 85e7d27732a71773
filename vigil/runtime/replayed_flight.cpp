#include "vigil/runtime/replayed_flight.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace vigil::runtime {

ReplayedFlight::ReplayedFlight(std::unique_ptr<FlightRecording> recording)
    : recording_(std::move(recording)),
      state_(first_state()),
      recollection_(recording_->head()),
      recorded_(recording_->head().parameters.drones),
      snapshot_(recording_->head().parameters.drones) {
  keep_checkpoint();
}

std::optional<swarm::SwarmState> ReplayedFlight::first_state() const {
  const RecordingHead& head = recording_->head();
  if (head.keep_every > 1) return std::nullopt;
  swarm::SwarmState state(head.parameters);
  if (head.start.past && !state.read_past(*head.start.past))
    throw std::runtime_error("the recording's past does not fit its parameters; it is damaged");
  return state;
}

void ReplayedFlight::keep_checkpoint() {
  checkpoints_.offer(next_, [this] { return Checkpoint{state_, recollection_}; });
}

void ReplayedFlight::recompute() {
  // A number that is damaged is the difference itself, no gap.
  const bool is_next = recorded_.damage || recorded_.snapshot.tick == state_->ticks();
  if (!is_next) return state_.reset();
  swarm::tick(*state_, recorded_.observations, recorded_.commands, snapshot_);
}

bool ReplayedFlight::step() {
  if (next_ >= recording_->tick_count()) return false;
  recording_->read(next_, recorded_);
  recollection_.complete(recorded_);
  if (state_) recompute();
  if (!state_) snapshot_ = recorded_.snapshot;
  ++next_;
  keep_checkpoint();
  return true;
}

void ReplayedFlight::go_to(const Checkpoints<Checkpoint>::One& checkpoint) {
  next_ = checkpoint.number;
  state_ = checkpoint.value.state;
  recollection_ = checkpoint.value.recollection;
}

void ReplayedFlight::approach(std::uint64_t number) {
  number = std::min(number, tick_count());
  if (number == next_) return;
  // What the newest tick shows must be computed, not only its state: from one tick before.
  const std::uint64_t before = number == 0 ? 0 : number - 1;
  const auto& nearest = checkpoints_.before(before);
  if (before < next_ || nearest.number > next_) go_to(nearest);
}

void ReplayedFlight::seek(std::uint64_t number) {
  number = std::min(number, tick_count());
  approach(number);
  while (next_ < number) step();
}

std::optional<TickDifference> ReplayedFlight::difference() const {
  return state_ ? first_difference(recorded_, snapshot_) : std::nullopt;
}

}  // namespace vigil::runtime
