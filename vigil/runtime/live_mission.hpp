#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "vigil/runtime/control_loop.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/queued_recorder.hpp"
#include "vigil/runtime/shown_flight.hpp"

namespace vigil::runtime {

/// What lets time pass for a control loop, on the control thread, until it is asked to stop.
using Drive = std::function<void(const std::stop_token& stop, ControlLoop& loop)>;

/// The system's monotonic clock, and sleep in between.
void drive_in_real_time(const std::stop_token& stop, ControlLoop& loop);

/// A mission that is being flown by a control thread of its own.
class LiveMission final : public ShownFlight {
 public:
  /// `world`: the fleet where it is a simulated one, otherwise null. `epoch` tells missions apart that one program
  /// flies one after the other. The recorder may be null, and so may the workers, who share a tick with the control
  /// thread.
  LiveMission(Mission mission, std::unique_ptr<Fleet> fleet, VirtualFleet* world,
              std::unique_ptr<QueuedRecorder> recorder, const FlightStart& start, std::uint32_t epoch,
              Drive drive = drive_in_real_time, std::unique_ptr<parallel::Workers> workers = nullptr);
  /// Ends the control thread.
  ~LiveMission() override;
  LiveMission(const LiveMission&) = delete;
  LiveMission& operator=(const LiveMission&) = delete;

  /// Lets the first tick begin. Call once.
  void start();
  /// Ends the control thread, then the recording; what the recorder throws where it could not keep everything. Nothing
  /// the second time.
  void finish();

  /// The swarm's state as the control thread leaves it after this call: waits for it, at most a second. None where
  /// there is no control thread, or `cancelled` becomes true meanwhile. Any thread but the control thread; several take
  /// turns.
  [[nodiscard]] std::optional<swarm::SwarmState> copy_state(const std::atomic<bool>& cancelled);

  [[nodiscard]] ControlLoop& loop() noexcept { return loop_; }
  [[nodiscard]] const ControlLoop& loop() const noexcept { return loop_; }

  [[nodiscard]] const Mission& mission() const noexcept override { return mission_; }
  [[nodiscard]] std::uint32_t epoch() const noexcept override { return epoch_; }
  [[nodiscard]] bool is_recording() const noexcept override { return false; }
  [[nodiscard]] bool has_real_drones() const noexcept override { return has_real_drones_; }
  [[nodiscard]] bool submit(std::vector<LiveCommand> commands) override { return loop_.submit(std::move(commands)); }
  bool read(LiveFrame& into, std::size_t& version) const override { return loop_.read(into, version); }
  bool read(ClockState& into, std::size_t& version) const override { return loop_.read(into, version); }
  [[nodiscard]] const std::vector<LiveEvent>& take_events() override { return loop_.take_events(); }
  [[nodiscard]] std::size_t lost_events() const override { return loop_.lost_events(); }
  [[nodiscard]] QueuedRecorder* recorder() noexcept override { return recorder_.get(); }
  [[nodiscard]] const QueuedRecorder* recorder() const noexcept override { return recorder_.get(); }

 private:
  Mission mission_;
  std::unique_ptr<parallel::Workers> workers_;
  std::unique_ptr<Fleet> fleet_;  ///< may be theirs, too
  std::unique_ptr<QueuedRecorder> recorder_;
  std::uint32_t epoch_;
  bool has_real_drones_;
  LiveFlight flight_;
  ControlLoop loop_;
  Drive drive_;
  std::mutex asking_;
  std::jthread thread_;
  bool is_finished_ = false;
};

}  // namespace vigil::runtime
