#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vigil/runtime/live_flight.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/queued_recorder.hpp"

namespace vigil::runtime {

/// What a console shows and commands: a flight that goes on now, or one that was recorded. Nothing of it waits.
class ShownFlight {
 public:
  virtual ~ShownFlight() = default;

  [[nodiscard]] virtual const Mission& mission() const noexcept = 0;  ///< as it was at first
  /// Tells apart what one program shows one after the other.
  [[nodiscard]] virtual std::uint32_t epoch() const noexcept = 0;
  /// What happened in a recording cannot be changed; only its clock takes commands.
  [[nodiscard]] virtual bool is_recording() const noexcept = 0;
  /// Their time cannot be stopped or hurried: a paused clock would leave drones in the air to themselves.
  [[nodiscard]] virtual bool has_real_drones() const noexcept { return false; }

  // Any thread.
  /// As ControlLoop::submit().
  [[nodiscard]] virtual bool submit(std::vector<LiveCommand> commands) = 0;
  /// The newest frame; see Latest::read.
  virtual bool read(LiveFrame& into, std::size_t& version) const = 0;
  /// How the clock goes; see Latest::read.
  virtual bool read(ClockState& into, std::size_t& version) const = 0;

  // One thread of the others.
  [[nodiscard]] virtual const std::vector<LiveEvent>& take_events() = 0;
  [[nodiscard]] virtual std::size_t lost_events() const = 0;
  /// Null where nothing is being recorded.
  [[nodiscard]] virtual QueuedRecorder* recorder() noexcept = 0;
  [[nodiscard]] virtual const QueuedRecorder* recorder() const noexcept = 0;
};

}  // namespace vigil::runtime
