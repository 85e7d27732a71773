#pragma once

#include <chrono>
#include <thread>

#include "vigil/runtime/lateness.hpp"

namespace vigil::bench {

/// A thread that does nothing but wake up every `period` by the steady clock, with real-time priority where asked for
/// and granted: how late it wakes is what the machine, not a program, is to blame for.
class BareThread {
 public:
  BareThread(std::chrono::nanoseconds period, bool has_priority);

  /// Ends it. Once.
  [[nodiscard]] runtime::LatenessFigures end();

 private:
  runtime::Lateness lateness_;
  std::jthread thread_;
};

}  // namespace vigil::bench
