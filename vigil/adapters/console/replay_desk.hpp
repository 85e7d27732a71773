#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "vigil/adapters/console/desk.hpp"
#include "vigil/runtime/replay_loop.hpp"

namespace vigil::console {

/// What the desk is to a flight, for a recording: turns its clock and tells what clients are shown of the tick that it
/// comes to. One thread, the replay's, but for ask().
class ReplayDesk {
 public:
  using Tell = std::function<void(DeskNews)>;
  using Time = runtime::ReplayLoop::Time;

  /// `recording`: turned by nobody else.
  ReplayDesk(std::shared_ptr<runtime::ReplayLoop> recording, Tell tell);

  /// Tells RecordingNews and what is shown of the first tick.
  void begin();
  /// Goes on as far as is due at `now`, tells what is new, and says when to be called again. Throws what the recording
  /// throws.
  Time turn(Time now);
  /// Lets the next turn answer of the tick that is shown then; false where too many questions wait. Any thread.
  [[nodiscard]] bool ask(const WhyQuestion& question);

 private:
  void tell_targets();
  void tell_ground();
  void tell_history();
  void tell_progress();
  void answer_questions();
  [[nodiscard]] DeskNews answer_to(const WhyQuestion& question) const;
  [[nodiscard]] ReplayState state() const;
  [[nodiscard]] TrailRing trails();

  std::shared_ptr<runtime::ReplayLoop> recording_;
  Tell tell_;
  std::uint64_t told_revision_ = 0;
  std::uint64_t told_jumps_ = 0;
  std::uint64_t told_number_ = 0;
  std::size_t told_events_ = 0;
  bool is_arriving_ = true;  ///< since the last jump nothing was told of where it led
  Time next_look_{0};
  std::mutex mutex_;
  std::vector<WhyQuestion> questions_;  ///< that wait, under the lock
};

}  // namespace vigil::console
