#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace vigil::apps {

/// A line on a terminal that says how far long work is and when it will be done. Silent where stderr is no terminal.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();  ///< wipes the line

  /// share in [0, 1]; draws at most ten times a second. `note` stands behind the bar.
  void show(double share, const std::string& note);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool is_terminal_;
  Clock::time_point began_;
  Clock::time_point drawn_;
};

}  // namespace vigil::apps
