#include "vigil/runtime/thread_priority.hpp"

#include <exception>
#include <pthread.h>
#include <sched.h>
#include <thread>

namespace vigil::runtime {

bool take_real_time_priority() noexcept {
  sched_param priority{};
  priority.sched_priority = sched_get_priority_min(SCHED_FIFO);
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
}

void start_with_real_time_priority(const std::function<void()>& start) {
  std::exception_ptr thrown;
  std::thread([&] {
    (void)take_real_time_priority();
    try {
      start();
    } catch (...) {
      thrown = std::current_exception();
    }
  }).join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace vigil::runtime
