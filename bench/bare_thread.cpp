#include "bare_thread.hpp"

#include "vigil/runtime/thread_priority.hpp"

namespace vigil::bench {

BareThread::BareThread(std::chrono::nanoseconds period, bool has_priority)
    : thread_([this, period, has_priority](const std::stop_token& stop) {
        if (has_priority) runtime::take_real_time_priority();
        for (auto due = std::chrono::steady_clock::now() + period; !stop.stop_requested(); due += period) {
          std::this_thread::sleep_until(due);
          lateness_.add(std::chrono::steady_clock::now() - due);
        }
      }) {}

runtime::LatenessFigures BareThread::end() {
  thread_.request_stop();
  thread_.join();
  return lateness_.figures();
}

}  // namespace vigil::bench
