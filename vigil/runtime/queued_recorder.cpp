#include "vigil/runtime/queued_recorder.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostNotes = 10'000;
/// Lists of targets that no tick was given yet; more wait only where edits come quicker than ticks.
constexpr std::size_t kMostExpected = 64;
/// The recorder looks for ticks instead of being woken: waking a thread may cost the control thread a system call.
constexpr auto kLookEvery = 10ms;

std::size_t slot_count(std::size_t drones) {
  const std::size_t slot_bytes =
      64 + drones * (sizeof(swarm::DroneSnapshot) + sizeof(swarm::DroneObservation) + sizeof(swarm::Command) +
                     sizeof(TruthSample) + 4 * sizeof(swarm::Event));
  return std::clamp<std::size_t>(QueuedRecorder::kMostBytes / slot_bytes, 4, 1024);
}

}  // namespace

QueuedRecorder::QueuedRecorder(std::unique_ptr<Recorder> inner, const Mission& mission, const FlightStart& start)
    : inner_(std::move(inner)), notes_(kMostNotes) {
  inner_->begin(mission, start);
  const std::size_t drones = mission.drones.size();
  const std::size_t slots = slot_count(drones);
  slots_.reserve(slots);
  for (std::size_t n = 0; n < slots; ++n) {
    slots_.push_back({swarm::Snapshot(drones), {}, {}, {}, {}, {}});
    slots_.back().observations.reserve(drones);
    slots_.back().commands.reserve(drones + 64);
    slots_.back().truth.reserve(drones);
    slots_.back().snapshot.events.reserve(4 * drones + 64);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

QueuedRecorder::~QueuedRecorder() { thread_ = {}; }

void QueuedRecorder::record(const TickRecord& tick) noexcept {
  for (const swarm::Command& command : tick.commands)
    if (command.kind == swarm::CommandKind::kSetTarget) in_force_ = command.target;
  const std::uint64_t number = written_.load(std::memory_order_relaxed);
  if (number - taken_.load(std::memory_order_acquire) >= slots_.size()) {
    lost_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  Slot& slot = slots_[number % slots_.size()];
  slot.snapshot = tick.snapshot;
  slot.observations.assign(tick.observations.begin(), tick.observations.end());
  slot.commands.assign(tick.commands.begin(), tick.commands.end());
  slot.truth.assign(tick.truth.begin(), tick.truth.end());
  slot.clearances = tick.clearances;
  slot.target = in_force_;
  written_.store(number + 1, std::memory_order_release);
}

void QueuedRecorder::log(const LoggedEvent& event) noexcept {
  std::vector<Note> note;
  note.emplace_back(event);
  if (!notes_.push(std::move(note))) lost_.fetch_add(1, std::memory_order_relaxed);
}

void QueuedRecorder::targets(double time_s, const MissionTargets& targets) noexcept {
  std::vector<Note> note;
  note.emplace_back(NewTargets{time_s, targets});
  if (!notes_.push(std::move(note))) lost_.fetch_add(1, std::memory_order_relaxed);
}

void QueuedRecorder::expect(std::shared_ptr<const swarm::CoverageTarget> given,
                            const MissionTargets& targets) noexcept {
  std::vector<Note> note;
  note.emplace_back(ExpectedTargets{std::move(given), targets});
  if (!notes_.push(std::move(note))) lost_.fetch_add(1, std::memory_order_relaxed);
}

void QueuedRecorder::write_notes() {
  for (const Note& note : notes_.take()) {
    if (const auto* event = std::get_if<LoggedEvent>(&note)) inner_->log(*event);
    if (const auto* change = std::get_if<NewTargets>(&note)) inner_->targets(change->time_s, change->targets);
    if (const auto* expected = std::get_if<ExpectedTargets>(&note)) expected_.push_back(*expected);
    if (expected_.size() > kMostExpected) expected_.pop_front();
  }
}

/// The importance map takes its time to draw, and a tick is only given it then: the list holds from that tick on.
void QueuedRecorder::write_targets(const Slot& slot) {
  if (slot.target == noted_) return;
  write_notes();  // what was expected before the tick was is there now
  noted_ = slot.target;
  const auto expected = std::ranges::find(expected_, noted_, &ExpectedTargets::given);
  if (expected == expected_.end()) return;
  inner_->targets(slot.snapshot.time_s, expected->targets);
  expected_.erase(expected_.begin(), std::next(expected));
}

bool QueuedRecorder::write_tick() {
  const std::uint64_t number = taken_.load(std::memory_order_relaxed);
  if (number == written_.load(std::memory_order_acquire)) return false;
  Slot& slot = slots_[number % slots_.size()];
  write_targets(slot);
  inner_->record({slot.snapshot, slot.observations, slot.commands, slot.truth, slot.clearances});
  slot.target.reset();
  slot.commands.clear();  // here, so that targets that nobody needs any more are not freed by the control thread
  taken_.store(number + 1, std::memory_order_release);
  if (inner_->trouble().empty()) kept_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

void QueuedRecorder::flush_inner() {
  inner_->flush();
  const std::lock_guard lock(trouble_mutex_);
  trouble_ = inner_->trouble();
}

std::string QueuedRecorder::trouble() const {
  const std::lock_guard lock(trouble_mutex_);
  return trouble_;
}

void QueuedRecorder::run(const std::stop_token& stop) {
  auto flush_at = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    write_notes();
    while (std::chrono::steady_clock::now() < flush_at && write_tick()) write_notes();
    if (std::chrono::steady_clock::now() >= flush_at) {
      flush_inner();
      flush_at = std::chrono::steady_clock::now() + kFlushEvery;
      if (written_.load(std::memory_order_acquire) != taken_.load(std::memory_order_relaxed)) continue;
    }
    std::this_thread::sleep_for(kLookEvery);
  }
}

void QueuedRecorder::finish() {
  thread_ = {};
  write_notes();
  while (write_tick()) {
  }
  inner_->finish();
  if (lost_ticks() > 0)
    throw std::runtime_error(fmt::format(
        "{} ticks could not be recorded as quickly as they came; record every Nth, or to a faster disk", lost_ticks()));
}

}  // namespace vigil::runtime
