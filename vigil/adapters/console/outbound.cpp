#include "vigil/adapters/console/outbound.hpp"

#include <algorithm>
#include <utility>

#include "vigil/adapters/console/frames.hpp"

namespace vigil::console {
namespace {

constexpr auto kSnapshot = static_cast<std::size_t>(ClientLine::Latest::kSnapshot);
constexpr auto kStatus = static_cast<std::size_t>(ClientLine::Latest::kStatus);

}  // namespace

bool Outbound::say(SharedBytes text) {
  if (said_bytes_ + text->size() > kMostSaidBytes || (pace_ && pace_->is_given_up())) return false;
  said_bytes_ += text->size();
  said_.push_back(std::move(text));
  return true;
}

void Outbound::show(ClientLine::Latest kind, SharedBytes bytes) {
  shown_.at(static_cast<std::size_t>(kind)).newest = std::move(bytes);
}

bool Outbound::is_empty() const {
  const auto has_nothing = [](const Shown& one) { return !one.newest && !one.begun; };
  return said_.empty() && std::all_of(shown_.begin(), shown_.end(), has_nothing);
}

std::optional<Outbound::Message> Outbound::next(Time now) {
  if (!said_.empty()) {
    SharedBytes text = std::move(said_.front());
    said_.pop_front();
    said_bytes_ -= text->size();
    if (pace_) pace_->sent(text->size(), false, now);
    return Message{std::move(text), true};
  }
  if (ahead_ <= 0 && may_send(kSnapshot)) return next_of(kSnapshot, now);
  for (std::size_t n = 1; n <= kKinds; ++n) {
    const std::size_t kind = (turn_ + n) % kKinds;
    // What has its turn and no room waits for it: smaller ones would take it away for ever.
    if (kind != kSnapshot && may_send(kind)) return next_of(kind, now);
  }
  return may_send(kSnapshot) ? next_of(kSnapshot, now) : std::nullopt;
}

/// Whether there is something of it, and it is not held back until the client has confirmed those before.
bool Outbound::may_send(std::size_t kind) const {
  const Shown& shown = shown_[kind];
  if (shown.begun) return true;
  return shown.newest && (kind != kSnapshot || !pace_ || pace_->admits_snapshot());
}

std::optional<Outbound::Message> Outbound::next_of(std::size_t kind, Time now) {
  std::optional<Message> message = pace_ ? part_of(kind, now) : whole_of(kind);
  if (!message) return std::nullopt;
  count(kind, message->bytes->size());
  if (kind != kSnapshot) turn_ = kind;
  return message;
}

/// Of a way that is full three quarters are the snapshots': the past may take its time, the present may not.
void Outbound::count(std::size_t kind, std::size_t bytes) {
  constexpr std::int64_t kOthersWeigh = 3;
  constexpr std::int64_t kFurthest = 32'768;  // who had nothing to send for long gets no more than that at once
  const auto size = static_cast<std::int64_t>(bytes);
  ahead_ = std::clamp(ahead_ + (kind == kSnapshot ? size : -kOthersWeigh * size), -kFurthest, kFurthest);
}

std::optional<Outbound::Message> Outbound::whole_of(std::size_t kind) {
  return Message{std::exchange(shown_[kind].newest, nullptr), kind == kStatus};
}

std::optional<Outbound::Message> Outbound::part_of(std::size_t kind, Time now) {
  Shown& shown = shown_[kind];
  const std::size_t whole = shown.begun ? shown.begun->size() : shown.newest->size();
  const std::size_t size = std::min(whole - shown.done, pace_->part_bytes(whole));
  if (!pace_->admits(size)) return std::nullopt;
  if (!shown.begun) shown.begun = std::exchange(shown.newest, nullptr);
  const std::size_t offset = std::exchange(shown.done, shown.done + size);
  const bool ends = shown.done == whole;
  pace_->sent(size, ends && kind == kSnapshot, now);
  SharedBytes bytes = shown.begun;
  if (ends) shown.begun.reset(), shown.done = 0;
  if (size == whole) return Message{std::move(bytes), kind == kStatus};
  const Part part{static_cast<std::uint8_t>(kind), offset, size};
  return Message{std::make_shared<const std::string>(part_frame(*bytes, part)), false};
}

}  // namespace vigil::console
