#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "vigil/runtime/live_mission.hpp"

namespace vigil::ros_bridge {

/// Shows over ROS what is being flown, ten times a second, on a thread of its own: no display ever delays a tick.
/// Needs a Session.
class LiveView {
 public:
  LiveView();
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  // Any thread.
  /// Another mission is flown from now on.
  void watch(std::shared_ptr<runtime::LiveMission> flight);
  /// Its targets are these now.
  void aim(const runtime::Mission& mission);
  /// No flight is looked at any more; it may end.
  void stop();

 private:
  class Painter;
  void run(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<runtime::LiveMission> flight_;
  bool is_other_flight_ = false;
  std::optional<runtime::Mission> aimed_at_;  ///< not shown yet
  std::jthread thread_;
};

}  // namespace vigil::ros_bridge
