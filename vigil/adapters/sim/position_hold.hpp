#pragma once

#include <algorithm>
#include <optional>

#include "vigil/core/field/vec2.hpp"

namespace vigil::sim {

/// What an autopilot does about wind while it takes off, lands, or hovers because nobody commands it: it brakes, and
/// then keeps the place where it had nearly stopped, with a velocity of gain times the way back to it.
class PositionHold {
 public:
  static constexpr double kStill = 0.8;    ///< m/s: slower than this it has stopped braking
  static constexpr double kFastest = 1.0;  ///< m/s

  /// gain 0: it only brakes.
  explicit PositionHold(double gain_per_s) : gain_per_s_(gain_per_s) {}

  /// The velocity that it asks of its own loop.
  [[nodiscard]] Vec2 command(const Vec2& position, const Vec2& velocity) noexcept {
    if (gain_per_s_ == 0.0) return Vec2::Zero();
    if (!place_ && velocity.norm() < kStill) place_ = position;
    if (!place_) return Vec2::Zero();
    const Vec2 wanted = gain_per_s_ * (*place_ - position);
    return wanted * std::min(1.0, kFastest / std::max(wanted.norm(), 1e-12));
  }

  void release() noexcept { place_.reset(); }

 private:
  double gain_per_s_;
  std::optional<Vec2> place_;
};

}  // namespace vigil::sim
