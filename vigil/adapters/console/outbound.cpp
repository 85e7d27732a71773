#include "vigil/adapters/console/outbound.hpp"

#include <algorithm>
#include <utility>

namespace vigil::console {

bool Outbound::say(SharedBytes text) {
  if (said_bytes_ + text->size() > kMostSaidBytes) return false;
  said_bytes_ += text->size();
  said_.push_back(std::move(text));
  return true;
}

void Outbound::show(ClientLine::Latest kind, SharedBytes bytes) {
  shown_.at(static_cast<std::size_t>(kind)) = std::move(bytes);
}

bool Outbound::is_empty() const {
  return said_.empty() && std::all_of(shown_.begin(), shown_.end(), [](const SharedBytes& one) { return !one; });
}

std::optional<Outbound::Message> Outbound::next() {
  if (!said_.empty()) {
    SharedBytes text = std::move(said_.front());
    said_.pop_front();
    said_bytes_ -= text->size();
    return Message{std::move(text), true};
  }
  for (std::size_t n = 0; n < kKinds; ++n) {
    turn_ = (turn_ + 1) % kKinds;
    if (!shown_[turn_]) continue;
    return Message{std::exchange(shown_[turn_], nullptr),
                   static_cast<ClientLine::Latest>(turn_) == ClientLine::Latest::kStatus};
  }
  return std::nullopt;
}

}  // namespace vigil::console
