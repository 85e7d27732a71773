#include "vigil/apps/campaign_workers.hpp"

#include <utility>

namespace vigil::apps {
namespace {

constexpr std::size_t kMostLines = 64;

}  // namespace

CampaignWorkers::CampaignWorkers(std::vector<std::uint64_t> runs, unsigned threads, Fly fly)
    : runs_(std::move(runs)), fly_(std::move(fly)), working_(threads) {
  for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

CampaignWorkers::~CampaignWorkers() {
  stop();
  const std::lock_guard lock(mutex_);
  is_closing_ = true;
  line_went_.notify_all();
}

void CampaignWorkers::work() {
  try {
    while (!is_stopped_) {
      const std::size_t at = next_++;
      if (at >= runs_.size()) break;
      keep(fly_(runs_[at]));
    }
  } catch (...) {
    stop();
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  --working_;
  line_came_.notify_all();
}

void CampaignWorkers::keep(std::string line) {
  std::unique_lock lock(mutex_);
  line_went_.wait(lock, [this] { return lines_.size() < kMostLines || is_closing_; });
  lines_.push_back(std::move(line));
  line_came_.notify_all();
}

std::optional<std::string> CampaignWorkers::next_line(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  line_came_.wait_for(lock, patience, [this] { return !lines_.empty() || working_ == 0; });
  if (lines_.empty()) {
    if (working_ == 0 && failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return std::nullopt;
  }
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  line_went_.notify_one();
  return line;
}

bool CampaignWorkers::is_over() {
  const std::lock_guard lock(mutex_);
  return lines_.empty() && working_ == 0 && !failure_;
}

}  // namespace vigil::apps
