#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "vigil/adapters/console/desk.hpp"

namespace vigil::console {

/// The thread of a desk: does tasks in their order, and lets the desk look around a few times a second.
class DeskThread {
 public:
  using Task = std::function<void(Desk&)>;
  static constexpr std::size_t kMostTasks = 256;

  /// The desk outlives this. `trouble`: told what a task threw, on the desk's thread.
  DeskThread(Desk& desk, std::function<void(std::string)> trouble);
  /// Ends after the task that is being done.
  ~DeskThread();
  DeskThread(const DeskThread&) = delete;
  DeskThread& operator=(const DeskThread&) = delete;

  /// False where too many wait. Any thread.
  [[nodiscard]] bool post(Task task);

 private:
  void run(const std::stop_token& stop);
  [[nodiscard]] Task next(const std::stop_token& stop);
  void attempt(const Task& task);

  Desk& desk_;
  std::function<void(std::string)> trouble_;
  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<Task> tasks_;
  std::jthread thread_;
};

}  // namespace vigil::console
