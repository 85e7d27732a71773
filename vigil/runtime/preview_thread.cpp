#include "vigil/runtime/preview_thread.hpp"

#include <sys/resource.h>
#include <unistd.h>
#include <utility>

namespace vigil::runtime {
namespace {

/// On Linux a thread has a niceness of its own. What it is refused it does without.
void step_back() {
  constexpr int kNice = 10;
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
}

}  // namespace

PreviewThread::PreviewThread() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

PreviewThread::~PreviewThread() {
  thread_.request_stop();
  cancel_all();
}

void PreviewThread::cancel_all() {
  const std::lock_guard lock(mutex_);
  for (const Entry& entry : waiting_) entry.cancelled->store(true, std::memory_order_relaxed);
  if (running_.cancelled) running_.cancelled->store(true, std::memory_order_relaxed);
}

bool PreviewThread::submit(std::uint64_t asker, Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostJobs) return false;
    for (const Entry& entry : waiting_)
      if (entry.asker == asker) entry.cancelled->store(true, std::memory_order_relaxed);
    if (running_.cancelled && running_.asker == asker) running_.cancelled->store(true, std::memory_order_relaxed);
    waiting_.push_back({asker, std::move(job), std::make_shared<std::atomic<bool>>(false)});
  }
  arrived_.notify_one();
  return true;
}

/// The next job; one without where the thread is to end.
PreviewThread::Entry PreviewThread::next(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  running_ = {};
  arrived_.wait(lock, stop, [this] { return !waiting_.empty(); });
  if (waiting_.empty()) return {};
  Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  running_ = {entry.asker, nullptr, entry.cancelled};
  return entry;
}

void PreviewThread::run(const std::stop_token& stop) {
  step_back();
  while (true) {
    const Entry entry = next(stop);
    if (!entry.job) return;
    entry.job(*entry.cancelled);
  }
}

}  // namespace vigil::runtime
