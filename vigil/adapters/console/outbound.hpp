#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "vigil/adapters/console/hub.hpp"
#include "vigil/adapters/console/pace.hpp"

namespace vigil::console {

/// What waits to be sent to one client: everything that was said, in order, and of each kind of frame only the newest.
/// So a client that reads slowly gets fewer frames and costs a bounded memory. Frames that were sent grow old in the
/// buffers on their way: of a client that confirms what it has read only so much is under way as `Pace` admits, so
/// what it reads is never much older than the way takes, and what is said is never long behind frames. A value without
/// sockets.
class Outbound {
 public:
  using Time = Pace::Time;

  /// Said and not sent, at most; then the client is given up.
  static constexpr std::size_t kMostSaidBytes = std::size_t{4} << 20U;

  struct Message {
    SharedBytes bytes;
    bool is_text = true;
  };

  /// From now on the client confirms what it has read. Precondition: nothing was sent.
  void pace() { pace_.emplace(); }
  /// The client has read so many messages. False where that cannot be, or nobody asked it to confirm.
  [[nodiscard]] bool confirm(std::uint64_t received, Time now) { return pace_ && pace_->confirm(received, now); }

  /// False where too much waits already.
  [[nodiscard]] bool say(SharedBytes text);
  void show(ClientLine::Latest kind, SharedBytes bytes);
  /// The next one to be sent now: what was said first, then frames, of which every second one is a snapshot where there
  /// is a new one. To a client that confirms, large frames go in parts, and none may be given back though some wait.
  [[nodiscard]] std::optional<Message> next(Time now);
  [[nodiscard]] bool is_empty() const;

 private:
  static constexpr auto kKinds = static_cast<std::size_t>(ClientLine::Latest::kCount);

  /// The newest that waits, and the one of which parts are under way.
  struct Shown {
    SharedBytes newest;
    SharedBytes begun;
    std::size_t done = 0;  ///< bytes of `begun` that were sent
  };

  [[nodiscard]] bool may_send(std::size_t kind) const;
  [[nodiscard]] std::optional<Message> next_of(std::size_t kind, Time now);
  [[nodiscard]] std::optional<Message> whole_of(std::size_t kind);
  [[nodiscard]] std::optional<Message> part_of(std::size_t kind, Time now);
  void count(std::size_t kind, std::size_t bytes);

  std::optional<Pace> pace_;
  std::deque<SharedBytes> said_;
  std::size_t said_bytes_ = 0;
  std::array<Shown, kKinds> shown_;
  std::size_t turn_ = 0;  ///< the kind that was sent last of those that are no snapshot
  /// Bytes of snapshots that the other frames have not made up for yet, at their share; the turn is theirs while > 0.
  std::int64_t ahead_ = 0;
};

}  // namespace vigil::console
