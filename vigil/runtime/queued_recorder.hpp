#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "vigil/runtime/hand_over.hpp"
#include "vigil/runtime/recorder.hpp"

namespace vigil::runtime {

/// Records through another recorder, on a thread of its own, so that no disk ever delays a tick: record(), log() and
/// targets() never wait; what finds the queue full is lost and counted. record() belongs to the control thread; log()
/// and targets() to any thread but for the order among them.
class QueuedRecorder final : public Recorder {
 public:
  /// Ticks that wait for the disk use at most about this much memory.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20U;

  /// What was given is flushed so often, so that this is about all that is lost with the program.
  static constexpr std::chrono::milliseconds kFlushEvery{40};

  /// Calls inner->begin(mission, start) at once: its exceptions are the caller's.
  QueuedRecorder(std::unique_ptr<Recorder> inner, const Mission& mission, const FlightStart& start);
  ~QueuedRecorder() override;
  QueuedRecorder(const QueuedRecorder&) = delete;
  QueuedRecorder& operator=(const QueuedRecorder&) = delete;

  void begin(const Mission& /*mission*/, const FlightStart& /*start*/) override {}
  void record(const TickRecord& tick) noexcept override;
  void log(const LoggedEvent& event) noexcept override;
  void targets(double time_s, const MissionTargets& targets) noexcept override;
  /// What `given` stands for: written as the targets that hold from the first kept tick on that was given it. To be
  /// said before any tick can be. Any thread.
  void expect(std::shared_ptr<const swarm::CoverageTarget> given, const MissionTargets& targets) noexcept;
  /// Writes what waits and ends the recording; whatever inner->finish() throws, or an exception that says how many
  /// ticks were lost.
  void finish() override;

  // Any thread.
  [[nodiscard]] std::uint64_t kept_ticks() const noexcept { return kept_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t lost_ticks() const noexcept { return lost_.load(std::memory_order_relaxed); }
  /// The inner recorder's, as of its last flush.
  [[nodiscard]] std::string trouble() const override;

 private:
  /// A tick as it waits; slots are made once and used again.
  struct Slot {
    swarm::Snapshot snapshot;
    std::vector<swarm::DroneObservation> observations;
    std::vector<swarm::Command> commands;
    std::vector<TruthSample> truth;
    Clearances clearances;
    std::shared_ptr<const swarm::CoverageTarget> target;  ///< the last that was given in this tick or before
  };
  struct NewTargets {
    double time_s = 0.0;
    MissionTargets targets;
  };
  struct ExpectedTargets {
    std::shared_ptr<const swarm::CoverageTarget> given;
    MissionTargets targets;
  };
  using Note = std::variant<LoggedEvent, NewTargets, ExpectedTargets>;

  void write_notes();
  void write_targets(const Slot& slot);
  bool write_tick();
  void flush_inner();
  void run(const std::stop_token& stop);

  std::unique_ptr<Recorder> inner_;
  std::vector<Slot> slots_;
  std::atomic<std::uint64_t> written_{0};                  ///< slots filled, by the control thread
  std::atomic<std::uint64_t> taken_{0};                    ///< slots emptied, by this recorder's thread
  std::shared_ptr<const swarm::CoverageTarget> in_force_;  ///< the control thread's
  Inbox<Note> notes_;
  std::deque<ExpectedTargets> expected_;                ///< this recorder's thread's, oldest first
  std::shared_ptr<const swarm::CoverageTarget> noted_;  ///< likewise: whose targets were written last
  std::atomic<std::uint64_t> kept_{0};
  std::atomic<std::uint64_t> lost_{0};
  mutable std::mutex trouble_mutex_;
  std::string trouble_;
  std::jthread thread_;
};

}  // namespace vigil::runtime
