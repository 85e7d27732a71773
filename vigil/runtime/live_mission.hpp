#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "vigil/runtime/control_loop.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/queued_recorder.hpp"

namespace vigil::runtime {

/// What lets time pass for a control loop, on the control thread, until it is asked to stop.
using Drive = std::function<void(const std::stop_token& stop, ControlLoop& loop)>;

/// The system's monotonic clock, and sleep in between.
void drive_in_real_time(const std::stop_token& stop, ControlLoop& loop);

/// A mission that is being flown by a control thread of its own.
class LiveMission {
 public:
  /// `world`: the fleet where it is a simulated one, otherwise null. `epoch` tells missions apart that one program
  /// flies one after the other. The recorder may be null.
  LiveMission(Mission mission, std::unique_ptr<Fleet> fleet, VirtualFleet* world,
              std::unique_ptr<QueuedRecorder> recorder, const FlightStart& start, std::uint32_t epoch,
              Drive drive = drive_in_real_time);
  /// Ends the control thread.
  ~LiveMission();
  LiveMission(const LiveMission&) = delete;
  LiveMission& operator=(const LiveMission&) = delete;

  /// Lets the first tick begin. Call once.
  void start();
  /// Ends the control thread, then the recording; what the recorder throws where it could not keep everything. Nothing
  /// the second time.
  void finish();

  [[nodiscard]] const Mission& mission() const noexcept { return mission_; }  ///< as it was at first
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }
  [[nodiscard]] ControlLoop& loop() noexcept { return loop_; }
  [[nodiscard]] const ControlLoop& loop() const noexcept { return loop_; }
  [[nodiscard]] const QueuedRecorder* recorder() const noexcept { return recorder_.get(); }
  [[nodiscard]] QueuedRecorder* recorder() noexcept { return recorder_.get(); }

 private:
  Mission mission_;
  std::unique_ptr<Fleet> fleet_;
  std::unique_ptr<QueuedRecorder> recorder_;
  std::uint32_t epoch_;
  LiveFlight flight_;
  ControlLoop loop_;
  Drive drive_;
  std::jthread thread_;
  bool is_finished_ = false;
};

}  // namespace vigil::runtime
