#pragma once

#include <algorithm>
#include <chrono>

namespace vigil::console {

/// So many things a second on average, so many at once. The caller says what time it is. A value.
class RateLimit {
 public:
  RateLimit(double a_second, double at_once) : a_second_(a_second), at_once_(at_once), left_(at_once) {}

  /// Whether one more is allowed at `now`, which is then counted.
  [[nodiscard]] bool admit(std::chrono::nanoseconds now) noexcept {
    const std::chrono::duration<double> passed = now - last_;
    left_ = std::min(at_once_, left_ + a_second_ * std::max(0.0, passed.count()));
    last_ = now;
    if (left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
  }

 private:
  double a_second_;
  double at_once_;
  double left_;
  std::chrono::nanoseconds last_{0};
};

}  // namespace vigil::console
