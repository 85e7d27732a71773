#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>

namespace vigil::console {

/// How much may be under way to a client that confirms what it has read: so little that it soon arrives, however slow
/// the way and whatever buffers lie on it, and enough for a fast way. The caller says what time it is. A value.
///
/// Bytes may be under way up to a window. A message that is confirmed later than kSoon after the least time that any
/// took has waited behind others: the window shrinks in proportion. It grows while messages come in time and it is what
/// holds others back.
class Pace {
 public:
  using Time = std::chrono::nanoseconds;  ///< monotonic

  static constexpr std::size_t kMostSnapshots = 2;  ///< under way at once
  static constexpr std::size_t kLeastBytes = std::size_t{2} << 10U;
  static constexpr std::size_t kFirstBytes = std::size_t{16} << 10U;
  static constexpr std::size_t kMostBytes = std::size_t{4} << 20U;
  static constexpr Time kSoon = std::chrono::milliseconds(100);
  /// Messages that may wait to be confirmed; with more of them the client cannot be relied upon.
  static constexpr std::size_t kMostMessages = 8192;

  /// Whether a message of this size may go now; if not, it may after a confirmation. With nothing under way any may.
  [[nodiscard]] bool admits(std::size_t bytes) noexcept;
  [[nodiscard]] bool admits_snapshot() const noexcept { return snapshots_ < kMostSnapshots; }
  /// A message of `whole` bytes goes in parts of at most this size, so that others come in between.
  [[nodiscard]] std::size_t part_bytes(std::size_t whole) const noexcept;
  [[nodiscard]] bool is_given_up() const noexcept { return under_way_.size() >= kMostMessages; }

  /// A message left; `ends_snapshot`: it is one, or the last part of one.
  void sent(std::size_t bytes, bool ends_snapshot, Time now);
  /// The client has read so many messages since the beginning. False where that cannot be: not more than before, or
  /// more than were sent.
  [[nodiscard]] bool confirm(std::uint64_t received, Time now);

  [[nodiscard]] std::size_t window_bytes() const noexcept { return window_; }
  [[nodiscard]] std::size_t bytes_under_way() const noexcept { return bytes_; }

 private:
  struct Message {
    std::size_t bytes;
    bool ends_snapshot;
    Time sent_at;
  };

  void adapt(Time sent_at, std::size_t confirmed_bytes, Time now) noexcept;

  std::deque<Message> under_way_;
  std::size_t bytes_ = 0;
  std::size_t snapshots_ = 0;
  std::uint64_t confirmed_ = 0;
  std::size_t window_ = kFirstBytes;
  bool holds_back_ = false;                            ///< since the window grew
  Time least_{std::numeric_limits<Time::rep>::max()};  ///< that a message took
  Time shrunk_at_{std::numeric_limits<Time::rep>::min()};
};

}  // namespace vigil::console
