#include "vigil/core/guidance/way_finder.hpp"

#include <algorithm>
#include <cassert>

namespace vigil::guidance {
WayFinder::WayFinder(const WayParameters& parameters, std::size_t drones)
    : map_(parameters), close_m_(parameters.clearance_m), legs_(drones) {}

void WayFinder::ground_changed(std::span<const field::Segment> no_fly) noexcept {
  map_.begin(no_fly);
  for (Leg& leg : legs_) leg.is_known = false;
}

void WayFinder::work() noexcept {
  if (!map_.is_ready()) map_.work(kLooksATick);
}

double WayFinder::length_m(const Vec2& from, const Vec2& to) noexcept {
  const double straight_m = (to - from).norm();
  if (map_.corners().empty() || map_.sees(from, to)) return straight_m;
  const std::optional<Way> way = map_.way(from, to);
  return way ? way->length_m : straight_m;
}

void WayFinder::begin_tick(std::size_t travellers) noexcept {
  work();
  period_ = 1 + travellers * map_.looks_of_a_way() / kLooksATick;
  ++tick_;
  asked_ = 0;
}

bool WayFinder::keeps(const Leg& leg, const Vec2& position, const Vec2& goal) const noexcept {
  // Close to a corner the way is asked for in every tick: who is carried past it need not turn back.
  return leg.is_known && leg.goal == goal && (leg.corner - position).norm() > close_m_ &&
         map_.sees(position, leg.corner);
}

Vec2 WayFinder::next(std::size_t drone, const Vec2& position, const Vec2& goal) noexcept {
  assert(drone < legs_.size());
  Leg& leg = legs_[drone];
  const bool is_its_turn = (tick_ + asked_++) % period_ == 0;
  if (map_.corners().empty() || map_.sees(position, goal)) {
    leg.is_known = false;
    return goal;
  }
  if (keeps(leg, position, goal)) return leg.corner;
  if (!is_its_turn) return leg.is_known && leg.goal == goal ? leg.corner : goal;
  const std::optional<Way> way = map_.way(position, goal);
  leg = {.goal = goal, .corner = way ? way->next : goal, .is_known = way.has_value()};
  return leg.corner;
}

}  // namespace vigil::guidance
