#pragma once

namespace vigil::runtime {

/// Asks the system to let the calling thread run before all others whenever it has something to do (SCHED_FIFO):
/// whether it does. It gives that to root, and to whoever has a limit on rtprio above 0 (`ulimit -r 1`).
bool take_real_time_priority() noexcept;

}  // namespace vigil::runtime
