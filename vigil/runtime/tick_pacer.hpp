#pragma once

#include <chrono>
#include <cstdint>

namespace vigil::runtime {

/// When ticks are due: every dt of mission time, at a factor of real time, or not at all while paused. It only reckons:
/// the caller says what time it is. One thread.
class TickPacer {
 public:
  using Time = std::chrono::nanoseconds;  ///< of a monotonic clock

  /// So far behind, the schedule begins anew: a swarm must not hurry through ticks it missed.
  static constexpr Time kGiveUp = std::chrono::milliseconds(100);

  /// The first tick is due at `now`. Precondition: dt_s > 0.
  TickPacer(double dt_s, Time now);

  [[nodiscard]] double speed() const noexcept { return speed_; }
  [[nodiscard]] bool is_paused() const noexcept { return is_paused_; }
  /// From the next tick on. Precondition: factor > 0.
  void set_speed(double factor, Time now) noexcept;
  void pause() noexcept { is_paused_ = true; }
  void resume(Time now) noexcept;

  /// When the next tick is due; meaningless while paused.
  [[nodiscard]] Time next_due() const noexcept;
  [[nodiscard]] bool is_due(Time now) const noexcept { return !is_paused_ && now >= next_due(); }
  /// A tick begins at `now`: how late that is. Precondition: is_due(now).
  Time begin_tick(Time now) noexcept;
  /// How often the schedule was given up.
  [[nodiscard]] std::uint64_t gave_up() const noexcept { return gave_up_; }

 private:
  void anchor(Time at) noexcept;

  double dt_s_;
  double speed_ = 1.0;
  bool is_paused_ = false;
  Time anchor_;
  std::uint64_t ticks_since_anchor_ = 0;  // counted, so that rounding does not add up
  std::uint64_t gave_up_ = 0;
};

}  // namespace vigil::runtime
