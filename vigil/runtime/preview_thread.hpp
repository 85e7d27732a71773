#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace vigil::runtime {

/// A thread for work that is worth nothing once newer work is asked for. It steps back where others want the processor,
/// as far as the system lets it.
class PreviewThread {
 public:
  /// Ends soon once the flag is true; called in any case, so that it can say that it was cancelled.
  using Job = std::function<void(const std::atomic<bool>& cancelled)>;
  static constexpr std::size_t kMostJobs = 64;

  PreviewThread();
  /// Cancels everything and ends.
  ~PreviewThread();
  PreviewThread(const PreviewThread&) = delete;
  PreviewThread& operator=(const PreviewThread&) = delete;

  /// Does the job after those of other askers that wait, and cancels what the same asker asked for before. False where
  /// too many wait. A job must not throw. Any thread.
  [[nodiscard]] bool submit(std::uint64_t asker, Job job);

 private:
  struct Entry {
    std::uint64_t asker = 0;
    Job job;
    std::shared_ptr<std::atomic<bool>> cancelled;
  };

  void run(const std::stop_token& stop);
  [[nodiscard]] Entry next(const std::stop_token& stop);
  void cancel_all();

  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<Entry> waiting_;
  Entry running_;  ///< without its job
  std::jthread thread_;
};

}  // namespace vigil::runtime
