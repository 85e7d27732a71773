#include "vigil/runtime/live_mission.hpp"

#include <chrono>
#include <utility>

#include "vigil/runtime/thread_priority.hpp"

namespace vigil::runtime {

void drive_in_real_time(const std::stop_token& stop, ControlLoop& loop) {
  using Clock = std::chrono::steady_clock;
  (void)take_real_time_priority();  // ticks are short and cannot wait; where they must, their lateness shows
  loop.begin(Clock::now().time_since_epoch());
  while (!stop.stop_requested()) {
    const ControlLoop::Time next = loop.turn(Clock::now().time_since_epoch());
    std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(next)));
  }
}

LiveMission::LiveMission(Mission mission, std::unique_ptr<Fleet> fleet, VirtualFleet* world,
                         std::unique_ptr<QueuedRecorder> recorder, const FlightStart& start, std::uint32_t epoch,
                         Drive drive, std::unique_ptr<parallel::Workers> workers)
    : mission_(std::move(mission)),
      workers_(std::move(workers)),
      fleet_(std::move(fleet)),
      recorder_(std::move(recorder)),
      epoch_(epoch),
      has_real_drones_(world == nullptr),
      flight_(mission_, *fleet_, world, recorder_.get(), start, workers_.get()),
      loop_(flight_, mission_.drones.size()),
      drive_(std::move(drive)) {}

LiveMission::~LiveMission() {
  thread_ = {};  // asks it to stop, and waits
}

void LiveMission::finish() {
  if (std::exchange(is_finished_, true)) return;
  thread_ = {};
  if (recorder_) recorder_->finish();
}

void LiveMission::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { drive_(stop, loop_); });
}

std::optional<swarm::SwarmState> LiveMission::copy_state(const std::atomic<bool>& cancelled) {
  using namespace std::chrono_literals;
  constexpr int kMostLooks = 1000;
  const std::lock_guard alone(asking_);
  loop_.ask_state();
  for (int looks = 0; looks < kMostLooks && !cancelled.load(std::memory_order_relaxed); ++looks) {
    if (std::optional<swarm::SwarmState> state = loop_.take_state()) return state;
    std::this_thread::sleep_for(1ms);
  }
  return std::nullopt;
}

}  // namespace vigil::runtime
