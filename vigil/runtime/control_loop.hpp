#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vigil/runtime/hand_over.hpp"
#include "vigil/runtime/live_flight.hpp"
#include "vigil/runtime/tick_pacer.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// A live flight in time: lets ticks begin when they are due, commands take effect at the next one, and shows what came
/// of it. turn() and what it calls belong to the control thread; it waits for nobody.
class ControlLoop {
 public:
  using Time = std::chrono::nanoseconds;  ///< of a monotonic clock

  /// Precondition: the flight outlives this.
  ControlLoop(LiveFlight& flight, std::size_t drones);

  /// The first tick is due at `now`. Before the first turn().
  void begin(Time now) noexcept;

  /// Does what is due at `now`, at most one tick, and says when to be called again.
  Time turn(Time now) noexcept;

  // Any thread.
  /// All of `commands`, in order and in one tick where it can tell their answers apart, or false where the queue is
  /// full.
  /// Precondition: either all of kind kSwarm, or none.
  [[nodiscard]] bool submit(std::vector<LiveCommand> commands);
  /// The newest frame; see Latest::read.
  bool read(LiveFrame& into, std::size_t& version) const { return frames_.read(into, version); }
  /// How the clock goes; see Latest::read.
  bool read(ClockState& into, std::size_t& version) const { return clocks_.read(into, version); }

  // One thread of the others.
  /// Asks for the swarm's state as the control thread next leaves it, within milliseconds; see OnRequest.
  void ask_state() { states_.ask(); }
  /// The state that was asked for; empty until it is there.
  [[nodiscard]] std::optional<swarm::SwarmState> take_state() const { return states_.take(); }

  // One thread of the others.
  [[nodiscard]] const std::vector<LiveEvent>& take_events() { return outbox_.take(); }
  [[nodiscard]] std::size_t lost_events() const { return outbox_.lost(); }

 private:
  void take_commands() noexcept;
  void obey_the_clock(const LiveCommand& command, Time now) noexcept;
  [[nodiscard]] std::span<const LiveCommand> due_commands() noexcept;
  void tick(Time now) noexcept;
  void publish(Time now) noexcept;
  void measure(Time now) noexcept;

  LiveFlight& flight_;
  TickPacer pacer_;
  Lateness lateness_;  ///< of the period that is being measured
  Lateness lateness_before_;
  Lateness lateness_long_ago_;
  LatenessFigures figures_;       ///< of the first two
  LatenessFigures figures_ever_;  ///< of all
  Time period_began_{0};
  Time figures_made_{0};
  Inbox<LiveCommand> inbox_;
  Inbox<LiveCommand> clock_inbox_;  ///< apart: who pauses must be able to resume, whatever waits for a tick
  Outbox<LiveEvent> outbox_;
  Latest<LiveFrame> frames_;
  Latest<ClockState> clocks_;
  OnRequest<swarm::SwarmState> states_;
  std::vector<LiveCommand> waiting_;  ///< for their tick; those before next_ are done
  std::size_t next_ = 0;
  bool has_new_frame_ = false;
};

}  // namespace vigil::runtime
