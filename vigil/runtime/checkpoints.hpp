#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace vigil::runtime {

/// Copies of a value that changes tick by tick, kept at even distances: where they become too many, every other one
/// goes. Two of these that are offered the same numbers keep the same ones.
template <typename Value>
class Checkpoints {
 public:
  struct One {
    std::uint64_t number = 0;
    Value value;
  };

  /// Keeps what `copy()` gives where the newest copy is old enough. The first number is 0 and always kept.
  template <typename Copy>
  void offer(std::uint64_t number, const Copy& copy) {
    const bool is_newer = kept_.empty() || number >= kept_.back().number + apart_;
    if (!is_newer) return;
    kept_.push_back({number, copy()});
    if (kept_.size() <= kMost) return;
    apart_ *= 2;
    std::erase_if(kept_, [this](const One& one) { return one.number % apart_ != 0; });
  }

  /// The last one not after `number`. Precondition: there is one.
  [[nodiscard]] const One& before(std::uint64_t number) const {
    return *std::prev(std::ranges::upper_bound(kept_, number, {}, &One::number));
  }

 private:
  static constexpr std::size_t kMost = 64;
  static constexpr std::uint64_t kFirstApart = 256;

  std::uint64_t apart_ = kFirstApart;
  std::vector<One> kept_;
};

}  // namespace vigil::runtime
