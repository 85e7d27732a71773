#pragma once

#include <array>
#include <chrono>
#include <cstdint>

namespace vigil::runtime {

/// How late ticks began, since the last clear(), microseconds.
struct LatenessFigures {
  std::uint64_t ticks = 0;
  double p50_us = 0.0;
  double p99_us = 0.0;
  double p999_us = 0.0;
  double max_us = 0.0;
};

/// A histogram of latenesses, or of how long ticks take: 32 bins an octave from 1 us to over an hour, so that quantiles
/// are known to 2.2 %. Nothing allocates: a day takes no more memory than a second. One thread.
class Lateness {
 public:
  void add(std::chrono::nanoseconds late) noexcept;
  void add(const Lateness& others) noexcept;
  void clear() noexcept { *this = Lateness(); }
  /// Quantiles are upper ends of their bins, never more than the worst.
  [[nodiscard]] LatenessFigures figures() const noexcept;

 private:
  [[nodiscard]] double quantile_us(double share) const noexcept;

  std::array<std::uint64_t, 1024> bins_{};
  std::uint64_t count_ = 0;
  double max_us_ = 0.0;
};

}  // namespace vigil::runtime
