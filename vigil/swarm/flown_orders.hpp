#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vigil/core/field/vec2.hpp"

namespace vigil::swarm {

/// A drone in motion, field frame.
struct Motion {
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
};

/// The velocities that drones were ordered to fly lately: what of them has not shown yet in what is known of a drone
/// can be added to it, since z = p + lag v moves by exactly what was ordered, z' = u. That makes up for the time that
/// observations and orders take, as far as orders arrive. A value; remember() and ahead() allocate nothing.
class FlownOrders {
 public:
  /// Remembers `longest_s` of orders, each held for dt_s.
  FlownOrders(std::size_t drones, double dt_s, double longest_s);

  /// The orders of one tick, one per drone; zero for one that is not ordered to fly anywhere.
  void remember(std::span<const Vec2> u) noexcept;
  /// The same: what is returned has to be filled, in any order.
  [[nodiscard]] std::span<Vec2> begin_tick() noexcept;

  /// What a drone was ordered to fly so many ticks before the newest; what exceeds the memory is the oldest.
  [[nodiscard]] const Vec2& ordered(std::size_t drone, std::size_t ticks_ago) const noexcept;

  /// Where a drone that was seen like `seen`, and that has flown the orders of the last `span_s` seconds since, is, if
  /// its velocity follows them with v' = (u - v)/lag. With span_s = age of the observation + delay of commands that is
  /// the moment at which the next order begins to act. Before the first order it stood still. Precondition: lag_s >= 0,
  /// 0 <= span_s; what exceeds the memory is left out.
  [[nodiscard]] Motion ahead(std::size_t drone, const Motion& seen, double span_s, double lag_s) const noexcept;

 private:
  std::size_t drones_;
  double dt_s_;
  std::size_t kept_;              ///< ticks
  std::vector<Vec2> velocities_;  ///< ring of kept_ rows of drones_
  std::size_t newest_ = 0;
};

}  // namespace vigil::swarm
