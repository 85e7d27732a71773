#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace vigil::apps {

/// Threads that fly runs, each a whole one at a time, and hand their lines to one reader. A reader that is slow makes
/// them wait: only so many lines are kept.
class CampaignWorkers {
 public:
  /// Flies one run; called from several threads at once.
  using Fly = std::function<std::string(std::uint64_t run)>;

  /// Begins at once. Precondition: threads > 0.
  CampaignWorkers(std::vector<std::uint64_t> runs, unsigned threads, Fly fly);
  CampaignWorkers(const CampaignWorkers&) = delete;
  CampaignWorkers& operator=(const CampaignWorkers&) = delete;
  ~CampaignWorkers();  ///< stops, and waits for the runs under way

  /// The line of a finished run; nothing where none came within `patience`, or at the end. Throws what a run threw.
  [[nodiscard]] std::optional<std::string> next_line(std::chrono::milliseconds patience);
  /// True once every line was taken and no other will come.
  [[nodiscard]] bool is_over();
  /// Lets no further run begin.
  void stop() noexcept { is_stopped_ = true; }

 private:
  void work();
  void keep(std::string line);

  std::vector<std::uint64_t> runs_;
  Fly fly_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> is_stopped_ = false;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable line_came_;
  std::condition_variable line_went_;
  std::deque<std::string> lines_;
  std::size_t working_ = 0;
  std::exception_ptr failure_;
  bool is_closing_ = false;
  std::vector<std::jthread> threads_;  ///< last: joined before the rest goes
};

}  // namespace vigil::apps
