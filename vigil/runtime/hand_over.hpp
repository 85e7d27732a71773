#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

/// How the control thread and the others hand things over. The control thread's side never waits: where somebody else
/// holds the lock for the moment of a swap or a copy, it comes back at its next tick. Every buffer is sized once.
namespace vigil::runtime {

/// From many threads to the control thread, in order, bounded.
template <typename Item>
class Inbox {
 public:
  explicit Inbox(std::size_t capacity) : capacity_(capacity) {
    waiting_.reserve(capacity);
    taken_.reserve(capacity);
  }

  /// All of `items`, or nothing and false where there is no room for them. Any thread.
  [[nodiscard]] bool push(std::vector<Item> items) {
    const std::lock_guard lock(mutex_);
    if (items.size() > capacity_ - waiting_.size()) return false;
    for (Item& item : items) waiting_.push_back(std::move(item));
    return true;
  }

  /// What has arrived; valid until the next call. The control thread only.
  [[nodiscard]] const std::vector<Item>& take() noexcept {
    taken_.clear();
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) taken_.swap(waiting_);
    return taken_;
  }

 private:
  std::size_t capacity_;
  std::mutex mutex_;
  std::vector<Item> waiting_;
  std::vector<Item> taken_;
};

/// From the control thread to one other, in order, bounded: what finds no room is counted and lost.
template <typename Item>
class Outbox {
 public:
  explicit Outbox(std::size_t capacity) {
    mine_.reserve(capacity);
    waiting_.reserve(capacity);
    taken_.reserve(capacity);
  }

  /// Puts one aside until send(). The control thread only.
  void note(const Item& item) noexcept {
    if (mine_.size() < mine_.capacity())
      mine_.push_back(item);
    else
      ++lost_;
  }

  /// Makes what was noted visible, now or with a later call. The control thread only.
  void send() noexcept {
    if (mine_.empty()) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    for (Item& item : mine_) {
      if (waiting_.size() < waiting_.capacity())
        waiting_.push_back(std::move(item));
      else
        ++lost_;
    }
    mine_.clear();
    sent_lost_ = lost_;
  }

  /// What has arrived; valid until the next call. One other thread.
  [[nodiscard]] const std::vector<Item>& take() {
    taken_.clear();
    const std::lock_guard lock(mutex_);
    taken_.swap(waiting_);
    return taken_;
  }

  /// How many were lost until the last send(). Any thread.
  [[nodiscard]] std::size_t lost() const {
    const std::lock_guard lock(mutex_);
    return sent_lost_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Item> mine_;
  std::vector<Item> waiting_;
  std::vector<Item> taken_;
  std::size_t lost_ = 0;       // of the control thread
  std::size_t sent_lost_ = 0;  // of the lock
};

/// The newest value of the control thread, for any number of readers.
template <typename Value>
class Latest {
 public:
  /// Every value is made of the same arguments: a copy need not have an original's reserves.
  template <typename... Arguments>
  explicit Latest(const Arguments&... arguments) : mine_(arguments...), shared_(arguments...) {}

  /// What the next publish() will show. It holds an older value of any age: to be written whole. The control thread
  /// only.
  [[nodiscard]] Value& mine() noexcept { return mine_; }

  /// Shows mine() to readers; false where one is reading just now: then readers keep what they have.
  bool publish() noexcept {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return false;
    std::swap(mine_, shared_);
    ++version_;
    return true;
  }

  /// Copies the newest value to `into` where it is newer than `version`, which it brings up to date. Any thread.
  bool read(Value& into, std::size_t& version) const {
    const std::lock_guard lock(mutex_);
    if (version_ == version) return false;
    into = shared_;
    version = version_;
    return true;
  }

 private:
  mutable std::mutex mutex_;
  Value mine_;
  Value shared_;
  std::size_t version_ = 0;
};

/// A value of the control thread, copied where one other thread asks for it: nothing is copied otherwise.
template <typename Value>
class OnRequest {
 public:
  /// The value is made of the same arguments as the control thread's: a copy need not have an original's reserves.
  template <typename... Arguments>
  explicit OnRequest(const Arguments&... arguments) : value_(arguments...) {}

  /// From now on take() is empty until the control thread gave the value as it will be then. The other thread.
  void ask() {
    const std::lock_guard lock(mutex_);
    is_there_ = false;
    is_wanted_.store(true, std::memory_order_release);
  }

  /// Copies the value where somebody waits for it, now or with a later call. The control thread only.
  void give(const Value& value) noexcept {
    if (!is_wanted_.load(std::memory_order_acquire)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    value_ = value;
    is_there_ = true;
    is_wanted_.store(false, std::memory_order_relaxed);
  }

  /// What was given since ask(). The other thread.
  [[nodiscard]] std::optional<Value> take() const {
    const std::lock_guard lock(mutex_);
    return is_there_ ? std::optional(value_) : std::nullopt;
  }

 private:
  mutable std::mutex mutex_;
  std::atomic<bool> is_wanted_{false};
  bool is_there_ = false;
  Value value_;
};

}  // namespace vigil::runtime
