#pragma once

#include <array>
#include <cstddef>

#include "vigil/core/dynamics/velocity_loop.hpp"
#include "vigil/core/field/vec2.hpp"
#include "vigil/swarm/fault.hpp"

namespace vigil::swarm {

/// Where its orders lead a drone, and how far astray it may be because some of them got lost: equation [4] of
/// docs/derivations/faults.md. A value; it allocates nothing.
class OrderedFlight {
 public:
  /// What is the same for all drones. dt_s > 0: each order is flown for so long.
  struct Rules {
    Rules(const FaultParameters& parameters, double dt_s) noexcept;

    FaultParameters parameters;
    double dt_s;
    double keeps;       ///< what a tick leaves of a departure
    double spacing_s;   ///< between the orders that are held
    double limit_m_s2;  ///< of acceleration; infinite: none
  };

  /// One tick of one order.
  void fly(const Rules& rules, const Vec2& u) noexcept;
  /// From now on it counts from the origin, at this velocity. What of the vehicle's inner state is not known is
  /// explained as well.
  void restart(const Rules& rules, const Vec2& velocity) noexcept;

  /// From where it was restarted. m.
  [[nodiscard]] const Vec2& place() const noexcept { return model_.position; }
  [[nodiscard]] const Vec2& velocity() const noexcept { return model_.velocity; }
  /// So far a healthy drone may be from there, beside noise, gusts and the model's error. m.
  [[nodiscard]] double explained_m() const noexcept { return held_m_ + lost_m_ + blown_m_; }

 private:
  /// An order that it may still fly, because newer ones got lost, and how far that leads from the newer ones.
  struct HeldOrder {
    Vec2 u = Vec2::Zero();
    Vec2 astray = Vec2::Zero();
    double for_s = 0.0;
  };
  static constexpr std::size_t kHeldOrders = 8;

  void hold(const Rules& rules, const Vec2& u) noexcept;
  void blow(const Rules& rules, const Vec2& u) noexcept;

  dynamics::PlanarLoopState model_;
  std::array<HeldOrder, kHeldOrders> held_{};  ///< a ring
  std::size_t newest_ = 0;
  double held_m_ = 0.0;
  double lost_m_ = 0.0;
  double blown_m_s_ = 0.0;  ///< what gusts make of its velocity at most
  double blown_m_ = 0.0;    ///< beyond what the threshold for a vehicle within its limits has of it
};

}  // namespace vigil::swarm
