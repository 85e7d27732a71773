#pragma once

#include <cstdint>

namespace vigil::sim {

/// What comes round more seldom than ticks do: at the first tick, and then so often per tick on average, at the first
/// tick that is not too early. Every tick where it is once a tick or more.
class Beat {
 public:
  explicit Beat(double beats_per_tick) : per_tick_(beats_per_tick) {}

  /// One tick: whether it is one.
  [[nodiscard]] bool next() noexcept {
    if (per_tick_ >= 1.0) return true;
    constexpr double kRounding = 1e-9;
    const double beats = static_cast<double>(ticks_++) * per_tick_ + kRounding;
    const bool is_due = beats >= next_;
    if (is_due) next_ += 1.0;
    return is_due;
  }

 private:
  double per_tick_;
  double next_ = 0.0;
  std::uint64_t ticks_ = 0;
};

}  // namespace vigil::sim
