#include "vigil/adapters/console/pace.hpp"

#include <algorithm>

namespace vigil::console {

bool Pace::admits(std::size_t bytes) noexcept {
  if (bytes_ == 0 || bytes_ + bytes <= window_) return true;
  holds_back_ = true;
  return false;
}

std::size_t Pace::part_bytes(std::size_t whole) const noexcept {
  if (whole <= window_) return std::max<std::size_t>(whole, 1);
  constexpr std::size_t kLeastPart = 1024;
  constexpr std::size_t kMostParts = 32;  // a window that a busy page keeps small must not make a picture of crumbs,
  constexpr std::size_t kMostBytesOfThose = std::size_t{4} << 10U;  // nor the past of a large swarm fill a slow way
  return std::max({kLeastPart, window_ / 4, std::min(whole / kMostParts, kMostBytesOfThose)});
}

void Pace::sent(std::size_t bytes, bool ends_snapshot, Time now) {
  under_way_.push_back({bytes, ends_snapshot, now});
  bytes_ += bytes;
  snapshots_ += ends_snapshot ? 1 : 0;
}

bool Pace::confirm(std::uint64_t received, Time now) {
  if (received <= confirmed_ || received - confirmed_ > under_way_.size()) return false;
  const std::size_t before = bytes_;
  Time sent_at{0};
  for (; confirmed_ < received; ++confirmed_) {
    const Message& message = under_way_.front();
    sent_at = message.sent_at;
    bytes_ -= message.bytes;
    snapshots_ -= message.ends_snapshot ? 1 : 0;
    under_way_.pop_front();
  }
  adapt(sent_at, before - bytes_, now);
  return true;
}

void Pace::adapt(Time sent_at, std::size_t confirmed_bytes, Time now) noexcept {
  const Time took = now - sent_at;
  least_ = std::min(least_, took);
  const Time waited = took - least_;
  if (waited <= kSoon) {
    if (holds_back_) window_ = std::min(kMostBytes, window_ + confirmed_bytes);
    holds_back_ = false;
  } else if (sent_at >= shrunk_at_) {  // what left before the last time says nothing of the window that is now
    const double share = static_cast<double>(kSoon.count()) / static_cast<double>(waited.count());
    window_ = std::max(kLeastBytes, static_cast<std::size_t>(share * static_cast<double>(window_)));
    shrunk_at_ = now;
  }
}

}  // namespace vigil::console
