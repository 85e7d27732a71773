#include "vigil/runtime/tick_pacer.hpp"

#include <cassert>

namespace vigil::runtime {

TickPacer::TickPacer(double dt_s, Time now) : dt_s_(dt_s), anchor_(now) { assert(dt_s > 0.0); }

void TickPacer::anchor(Time at) noexcept {
  anchor_ = at;
  ticks_since_anchor_ = 0;
}

void TickPacer::set_speed(double factor, Time now) noexcept {
  assert(factor > 0.0);
  speed_ = factor;
  anchor(now);
}

void TickPacer::resume(Time now) noexcept {
  if (is_paused_) anchor(now);
  is_paused_ = false;
}

TickPacer::Time TickPacer::next_due() const noexcept {
  const std::chrono::duration<double> since_anchor(static_cast<double>(ticks_since_anchor_) * dt_s_ / speed_);
  return anchor_ + std::chrono::round<Time>(since_anchor);
}

TickPacer::Time TickPacer::begin_tick(Time now) noexcept {
  const Time late = now - next_due();
  if (late > kGiveUp) {
    anchor(now);
    ++gave_up_;
  }
  ++ticks_since_anchor_;
  return late;
}

}  // namespace vigil::runtime
