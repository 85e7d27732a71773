#include "vigil/runtime/thread_priority.hpp"

#include <exception>
#include <pthread.h>
#include <sched.h>
#include <thread>

namespace vigil::runtime {

namespace {

bool take(int priority) noexcept {
  sched_param parameter{};
  parameter.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter) == 0;
}

}  // namespace

bool take_real_time_priority(Urgency urgency) noexcept {
  const int least = sched_get_priority_min(SCHED_FIFO);
  return (urgency == Urgency::kBeforeOthers && take(least + 1)) || take(least);
}

void start_with_real_time_priority(const std::function<void()>& start, Urgency urgency) {
  std::exception_ptr thrown;
  std::thread([&] {
    (void)take_real_time_priority(urgency);
    try {
      start();
    } catch (...) {
      thrown = std::current_exception();
    }
  }).join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace vigil::runtime
