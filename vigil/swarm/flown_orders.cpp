#include "vigil/swarm/flown_orders.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vigil::swarm {
namespace {

/// The exact motion under a constant order.
Motion advanced(const Motion& motion, const Vec2& u, double time_s, double lag_s) {
  if (lag_s <= 0.0) return {motion.position + time_s * u, u};
  const double fade = std::exp(-time_s / lag_s);
  return {motion.position + time_s * u + lag_s * (1.0 - fade) * (motion.velocity - u),
          u + fade * (motion.velocity - u)};
}

}  // namespace

FlownOrders::FlownOrders(std::size_t drones, double dt_s, double longest_s)
    : drones_(drones),
      dt_s_(dt_s),
      kept_(static_cast<std::size_t>(std::ceil(longest_s / dt_s)) + 1),
      velocities_(drones * kept_, Vec2::Zero()) {}

std::span<Vec2> FlownOrders::begin_tick() noexcept {
  newest_ = (newest_ + 1) % kept_;
  return std::span(velocities_).subspan(newest_ * drones_, drones_);
}

void FlownOrders::remember(std::span<const Vec2> u) noexcept {
  assert(u.size() == drones_);
  std::copy(u.begin(), u.end(), begin_tick().begin());
}

const Vec2& FlownOrders::ordered(std::size_t drone, std::size_t ticks_ago) const noexcept {
  const std::size_t ago = std::min(ticks_ago, kept_ - 1);
  return velocities_[(newest_ + kept_ - ago) % kept_ * drones_ + drone];
}

Motion FlownOrders::ahead(std::size_t drone, const Motion& seen, double span_s, double lag_s) const noexcept {
  constexpr double kRounding = 1e-6;  // of a tick: a span of whole ticks must not take in a sliver of another one
  const double span = std::min(span_s / dt_s_, static_cast<double>(kept_));
  const auto whole = static_cast<std::size_t>(span + kRounding);
  const double part = span - static_cast<double>(whole);
  Motion motion = seen;
  const auto fly = [&](std::size_t ticks_ago, double time_s) {
    const std::size_t row = (newest_ + kept_ - ticks_ago) % kept_;
    motion = advanced(motion, velocities_[row * drones_ + drone], time_s, lag_s);
  };
  if (part > kRounding && whole < kept_) fly(whole, part * dt_s_);
  for (std::size_t ago = whole; ago-- > 0;) fly(ago, dt_s_);
  return motion;
}

}  // namespace vigil::swarm
