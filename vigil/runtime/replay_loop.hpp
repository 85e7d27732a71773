#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "vigil/runtime/hand_over.hpp"
#include "vigil/runtime/replay_scene.hpp"
#include "vigil/runtime/shown_flight.hpp"

namespace vigil::runtime {

/// A recording in time: plays at a factor of the time it took, stands still, goes to any of its ticks, and shows where
/// it is as a live flight does. It begins paused at its first tick and pauses itself at its last one. begin(), turn()
/// and scene() belong to one thread, the replay's; they throw what the recording throws.
class ReplayLoop final : public ShownFlight {
 public:
  using Time = std::chrono::nanoseconds;  ///< of a monotonic clock

  static constexpr double kLeastSpeed = 0.1;
  static constexpr double kMostSpeed = 100.0;

  /// As ReplayScene.
  ReplayLoop(Mission mission, const ReplayScene::Open& open, std::uint32_t epoch);

  /// Takes in commands and goes as far as is due at `now`, at most so far as takes some tens of milliseconds; says when
  /// to be called again.
  Time turn(Time now);

  [[nodiscard]] ReplayScene& scene() noexcept { return scene_; }
  [[nodiscard]] const ReplayScene& scene() const noexcept { return scene_; }
  /// How often it went elsewhere than on to the next tick.
  [[nodiscard]] std::uint64_t jumps() const noexcept { return jumps_; }
  /// On its way to a tick that was sought; what it shows meanwhile lies before it.
  [[nodiscard]] bool is_seeking() const noexcept { return goal_.has_value(); }
  /// How much of that way is behind, [0, 1]; 1 where it is on none.
  [[nodiscard]] double progress() const noexcept;
  [[nodiscard]] bool is_at_end() const noexcept;

  [[nodiscard]] const Mission& mission() const noexcept override { return scene_.first_mission(); }
  [[nodiscard]] std::uint32_t epoch() const noexcept override { return epoch_; }
  [[nodiscard]] bool is_recording() const noexcept override { return true; }
  [[nodiscard]] bool submit(std::vector<LiveCommand> commands) override { return inbox_.push(std::move(commands)); }
  bool read(LiveFrame& into, std::size_t& version) const override { return frames_.read(into, version); }
  bool read(ClockState& into, std::size_t& version) const override { return clocks_.read(into, version); }
  [[nodiscard]] const std::vector<LiveEvent>& take_events() override { return outbox_.take(); }
  [[nodiscard]] std::size_t lost_events() const override { return outbox_.lost(); }
  [[nodiscard]] QueuedRecorder* recorder() noexcept override { return nullptr; }
  [[nodiscard]] const QueuedRecorder* recorder() const noexcept override { return nullptr; }

 private:
  void obey(const LiveCommand& command, Time now);
  void seek(std::uint64_t number);
  void play_on(Time now);
  void approach_goal(Time now);
  void play(Time now);
  void publish(Time now);
  [[nodiscard]] bool step();

  ReplayScene scene_;
  std::uint32_t epoch_;
  std::uint64_t steps_a_turn_;
  std::optional<std::uint64_t> goal_;
  std::uint64_t way_from_ = 0;  ///< where the way to goal_ began
  std::uint64_t jumps_ = 0;
  double speed_ = 1.0;
  bool is_paused_ = true;
  Time anchor_{0};         ///< when the tick at anchor_s_ was due
  double anchor_s_ = 0.0;  ///< mission time
  bool has_new_frame_ = true;
  Inbox<LiveCommand> inbox_;
  Outbox<LiveEvent> outbox_;
  Latest<LiveFrame> frames_;
  Latest<ClockState> clocks_;
};

}  // namespace vigil::runtime
