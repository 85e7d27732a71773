#include "vigil/runtime/thread_priority.hpp"

#include <pthread.h>
#include <sched.h>

namespace vigil::runtime {

bool take_real_time_priority() noexcept {
  sched_param priority{};
  priority.sched_priority = sched_get_priority_min(SCHED_FIFO);
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
}

}  // namespace vigil::runtime
