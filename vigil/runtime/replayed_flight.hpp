#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "vigil/runtime/checkpoints.hpp"
#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/recollection.hpp"
#include "vigil/runtime/recorded_tick.hpp"
#include "vigil/runtime/tick_difference.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// A recorded flight, flown again by the same ticks from what they were given: any moment of it, with all that the
/// controller knew and decided there. Seeking goes on from a copy of the state kept nearby. One thread at a time;
/// throws what the recording throws.
class ReplayedFlight {
 public:
  /// Stands before the first tick. Throws std::runtime_error where the recording's beginning makes no sense.
  explicit ReplayedFlight(std::unique_ptr<FlightRecording> recording);

  [[nodiscard]] const FlightRecording& recording() const noexcept { return *recording_; }
  [[nodiscard]] std::uint64_t tick_count() const { return recording_->tick_count(); }
  /// How many of the recording's ticks are behind; the newest is number() - 1.
  [[nodiscard]] std::uint64_t number() const noexcept { return next_; }

  /// Goes on by one tick; false, and nothing changed, at the end.
  bool step();
  /// So that number() == `number`, at most tick_count(). Takes as long as the ticks since the next copy before it.
  void seek(std::uint64_t number);
  /// The first part of seek(): goes to the copy from which step() comes to `number` soonest, or stays. Afterwards
  /// number() < `number`, but for 0 and where it was reached already.
  void approach(std::uint64_t number);

  // Of the newest tick. Precondition: number() > 0.
  /// As recomputed; where that is not possible, as recorded.
  [[nodiscard]] const swarm::Snapshot& snapshot() const noexcept { return snapshot_; }
  /// As recorded.
  [[nodiscard]] const RecordedTick& recorded() const noexcept { return recorded_; }
  /// Where what was recomputed is not what was recorded; always nothing where nothing was recomputed.
  [[nodiscard]] std::optional<TickDifference> difference() const;
  /// Whether ticks up to here can be recomputed: false where only every nth tick was kept, and from a gap on.
  [[nodiscard]] bool is_recomputed() const noexcept { return state_.has_value(); }

  /// After the newest tick. Precondition: is_recomputed().
  [[nodiscard]] const swarm::SwarmState& state() const { return *state_; }

 private:
  /// A state to go on from.
  struct Checkpoint {
    std::optional<swarm::SwarmState> state;
    Recollection recollection;
  };

  [[nodiscard]] std::optional<swarm::SwarmState> first_state() const;
  void keep_checkpoint();
  void go_to(const Checkpoints<Checkpoint>::One& checkpoint);
  void recompute();

  std::unique_ptr<FlightRecording> recording_;
  std::optional<swarm::SwarmState> state_;
  Recollection recollection_;
  RecordedTick recorded_;
  swarm::Snapshot snapshot_;
  std::uint64_t next_ = 0;
  Checkpoints<Checkpoint> checkpoints_;
};

}  // namespace vigil::runtime
