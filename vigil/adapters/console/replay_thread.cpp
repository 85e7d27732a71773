#include "vigil/adapters/console/replay_thread.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace vigil::console {
namespace {

using Clock = std::chrono::steady_clock;

void run(const std::stop_token& stop, ReplayDesk& desk) {
  while (!stop.stop_requested()) {
    const ReplayDesk::Time next = desk.turn(Clock::now().time_since_epoch());
    std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(next)));
  }
}

}  // namespace

ReplayThread::ReplayThread(ReplayDesk& desk, std::function<void(std::string)> trouble)
    : thread_([&desk, trouble = std::move(trouble)](const std::stop_token& stop) {
        try {
          run(stop, desk);
        } catch (const std::exception& error) {
          trouble(error.what());
        }
      }) {}

}  // namespace vigil::console
