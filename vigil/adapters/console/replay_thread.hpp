#pragma once

#include <functional>
#include <string>
#include <thread>

#include "vigil/adapters/console/replay_desk.hpp"

namespace vigil::console {

/// The thread of a recording's clock.
class ReplayThread {
 public:
  /// The desk outlives this. `trouble`: told once what the recording threw, on this thread, which then ends.
  ReplayThread(ReplayDesk& desk, std::function<void(std::string)> trouble);

 private:
  std::jthread thread_;
};

}  // namespace vigil::console
