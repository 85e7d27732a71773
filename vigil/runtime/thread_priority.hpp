#pragma once

#include <cstdint>
#include <functional>

namespace vigil::runtime {

/// Among threads of real-time priority.
enum class Urgency : std::uint8_t {
  kUsual,
  /// For a thread that holds locks for which others of such priority ask in a loop, and never yield: roscpp does. Needs
  /// a limit on rtprio above 1, and is as usual where there is none.
  kBeforeOthers
};

/// Asks the system to let the calling thread run before all others whenever it has something to do (SCHED_FIFO):
/// whether it does. It gives that to root, and to whoever has a limit on rtprio above 0 (`ulimit -r 1`).
bool take_real_time_priority(Urgency urgency = Urgency::kUsual) noexcept;

/// Calls `start` on a thread that has asked for that priority, and waits for its return: the threads that it starts
/// have what was given. What it throws, this throws.
void start_with_real_time_priority(const std::function<void()>& start, Urgency urgency = Urgency::kUsual);

}  // namespace vigil::runtime
