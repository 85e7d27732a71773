#include "vigil/swarm/ordered_flight.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/core/dynamics/planar_vehicle.hpp"

namespace vigil::swarm {

OrderedFlight::Rules::Rules(const FaultParameters& given, double tick_s) noexcept
    : parameters(given),
      dt_s(tick_s),
      keeps(std::exp(-given.bounds.residual_leak_per_s * tick_s)),
      spacing_s((given.bounds.held_s + tick_s) / static_cast<double>(kHeldOrders - 1)),
      limit_m_s2(given.acceleration_limit_m_s2.value_or(given.loop.acceleration_limit_m_s2)) {}

void OrderedFlight::fly(const Rules& rules, const Vec2& u) noexcept {
  const FaultParameters& parameters = rules.parameters;
  if (std::isfinite(rules.limit_m_s2)) blow(rules, u);
  if (parameters.acceleration_limit_m_s2) {
    const dynamics::PlanarVehicle vehicle{1.0 / parameters.loop.proportional_per_s, parameters.acceleration_limit_m_s2};
    const dynamics::PlanarState next = dynamics::advance(vehicle, {model_.position, model_.velocity}, u, rules.dt_s);
    model_.position = next.position;
    model_.velocity = next.velocity;
  } else {
    model_ = dynamics::advance(parameters.loop, model_, u, rules.dt_s);
  }
  hold(rules, u);
}

/// A vehicle that needs all its acceleration for its orders has none left against gusts: of the stiffness that holds
/// them, the slope of the limit remains.
void OrderedFlight::blow(const Rules& rules, const Vec2& u) noexcept {
  const dynamics::VelocityLoop& loop = rules.parameters.loop;
  const double drift_m_s = rules.parameters.bounds.drift_m_s;
  const double push_m_s2 = drift_m_s * (loop.proportional_per_s + loop.drag_per_s);
  const double share = loop.proportional_per_s * (loop.gain * u - model_.velocity).norm() / rules.limit_m_s2;
  const double squared = share * share;
  const double beyond = 1.0 + squared * squared;
  const double slope = 1.0 / (beyond * std::sqrt(std::sqrt(beyond)));
  const double stiffness_per_s = slope * loop.proportional_per_s + loop.drag_per_s;
  blown_m_s_ += rules.dt_s * (push_m_s2 - stiffness_per_s * blown_m_s_);
  blown_m_ = rules.keeps * blown_m_ + rules.dt_s * std::max(0.0, blown_m_s_ - drift_m_s);
}

/// Any of the orders of the last held_s may be flown still; eight of them stand for all.
void OrderedFlight::hold(const Rules& rules, const Vec2& u) noexcept {
  const dynamics::FaultBounds& bounds = rules.parameters.bounds;
  const double longest_s = bounds.held_s + rules.spacing_s + 1.5 * rules.dt_s;
  double astray_m2 = 0.0;
  for (HeldOrder& held : held_) {
    held.for_s += rules.dt_s;
    held.astray += rules.dt_s * (u - held.u);
    if (held.for_s <= longest_s) astray_m2 = std::max(astray_m2, held.astray.squaredNorm());
  }
  held_m_ = std::max(rules.keeps * held_m_, std::sqrt(astray_m2));
  const double lately = (u - held_[(newest_ + kHeldOrders - 1) % kHeldOrders].u).norm();
  lost_m_ = rules.keeps * lost_m_ + rules.dt_s * bounds.lost_share * lately;
  if (held_[newest_].for_s < rules.spacing_s - 0.5 * rules.dt_s) return;
  newest_ = (newest_ + 1) % kHeldOrders;
  held_[newest_] = {u, Vec2::Zero(), 0.0};
}

void OrderedFlight::restart(const Rules& rules, const Vec2& velocity) noexcept {
  const dynamics::VelocityLoop& loop = rules.parameters.loop;
  const double settles_s = dynamics::is_immediate(loop) ? 0.0 : 1.0 / loop.proportional_per_s;
  model_ = {};
  model_.velocity = velocity;
  held_m_ = std::max(held_m_, 2.0 * settles_s * velocity.norm());
}

}  // namespace vigil::swarm
