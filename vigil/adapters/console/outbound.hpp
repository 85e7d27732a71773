#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "vigil/adapters/console/hub.hpp"

namespace vigil::console {

/// What waits to be sent to one client: everything that was said, in order, and of each kind of frame only the newest.
/// So a client that reads slowly gets fewer frames, never old ones, and costs a bounded memory. A value without
/// sockets.
class Outbound {
 public:
  /// Said and not sent, at most; then the client is given up.
  static constexpr std::size_t kMostSaidBytes = std::size_t{4} << 20U;

  struct Message {
    SharedBytes bytes;
    bool is_text = true;
  };

  /// False where too much waits already.
  [[nodiscard]] bool say(SharedBytes text);
  void show(ClientLine::Latest kind, SharedBytes bytes);
  /// The next one to be sent: what was said first, then frames by turns.
  [[nodiscard]] std::optional<Message> next();
  [[nodiscard]] bool is_empty() const;

 private:
  static constexpr auto kKinds = static_cast<std::size_t>(ClientLine::Latest::kCount);

  std::deque<SharedBytes> said_;
  std::size_t said_bytes_ = 0;
  std::array<SharedBytes, kKinds> shown_;
  std::size_t turn_ = 0;
};

}  // namespace vigil::console
