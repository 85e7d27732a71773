#pragma once

#include <functional>

namespace vigil::runtime {

/// Asks the system to let the calling thread run before all others whenever it has something to do (SCHED_FIFO):
/// whether it does. It gives that to root, and to whoever has a limit on rtprio above 0 (`ulimit -r 1`).
bool take_real_time_priority() noexcept;

/// Calls `start` on a thread that has asked for that priority, and waits for its return: the threads that it starts
/// have what was given. What it throws, this throws.
void start_with_real_time_priority(const std::function<void()>& start);

}  // namespace vigil::runtime
