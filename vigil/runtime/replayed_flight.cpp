#include "vigil/runtime/replayed_flight.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace vigil::runtime {
namespace {

constexpr std::uint64_t kFirstApart = 256;
constexpr std::size_t kMostCheckpoints = 64;

}  // namespace

ReplayedFlight::ReplayedFlight(std::unique_ptr<FlightRecording> recording)
    : recording_(std::move(recording)),
      state_(first_state()),
      recollection_(recording_->head()),
      recorded_(recording_->head().parameters.drones),
      snapshot_(recording_->head().parameters.drones),
      apart_(kFirstApart) {
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

/// At even distances; where they become too many, every other one goes.
void ReplayedFlight::keep_checkpoint() {
  const bool is_newer = checkpoints_.empty() || next_ >= checkpoints_.back().number + apart_;
  if (!is_newer) return;
  checkpoints_.push_back({next_, state_, recollection_});
  if (checkpoints_.size() <= kMostCheckpoints) return;
  apart_ *= 2;
  std::erase_if(checkpoints_, [this](const Checkpoint& one) { return one.number % apart_ != 0; });
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

void ReplayedFlight::go_back_to(const Checkpoint& checkpoint) {
  next_ = checkpoint.number;
  state_ = checkpoint.state;
  recollection_ = checkpoint.recollection;
}

void ReplayedFlight::seek(std::uint64_t number) {
  number = std::min(number, tick_count());
  if (number == next_) return;
  // What the newest tick shows must be computed, not only its state: from one tick before.
  const std::uint64_t before = number == 0 ? 0 : number - 1;
  const auto after = std::ranges::upper_bound(checkpoints_, before, {}, &Checkpoint::number);
  const Checkpoint& nearest = *std::prev(after);
  if (before < next_ || nearest.number > next_) go_back_to(nearest);
  while (next_ < number) step();
}

std::optional<TickDifference> ReplayedFlight::difference() const {
  return state_ ? first_difference(recorded_, snapshot_) : std::nullopt;
}

}  // namespace vigil::runtime
