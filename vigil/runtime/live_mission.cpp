#include "vigil/runtime/live_mission.hpp"

#include <chrono>
#include <pthread.h>
#include <sched.h>
#include <utility>

namespace vigil::runtime {
namespace {

using Clock = std::chrono::steady_clock;

/// Before everybody else, where the system lets it (root, or a limit on rtprio): ticks are short and cannot wait.
/// Elsewhere ticks take their turn, and their lateness shows.
void ask_for_priority() {
  sched_param priority{};
  priority.sched_priority = sched_get_priority_min(SCHED_FIFO);
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
}

void run(const std::stop_token& stop, ControlLoop& loop) {
  ask_for_priority();
  loop.begin(Clock::now().time_since_epoch());
  while (!stop.stop_requested()) {
    const ControlLoop::Time next = loop.turn(Clock::now().time_since_epoch());
    std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(next)));
  }
}

}  // namespace

LiveMission::LiveMission(Mission mission, std::unique_ptr<Fleet> fleet, VirtualFleet* world,
                         std::unique_ptr<QueuedRecorder> recorder, const FlightStart& start, std::uint32_t epoch)
    : mission_(std::move(mission)),
      fleet_(std::move(fleet)),
      recorder_(std::move(recorder)),
      epoch_(epoch),
      flight_(mission_, *fleet_, world, recorder_.get(), start),
      loop_(flight_, mission_.drones.size()) {}

LiveMission::~LiveMission() {
  thread_ = {};  // asks it to stop, and waits
}

void LiveMission::finish() {
  if (std::exchange(is_finished_, true)) return;
  thread_ = {};
  if (recorder_) recorder_->finish();
}

void LiveMission::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop, loop_); });
}

}  // namespace vigil::runtime
