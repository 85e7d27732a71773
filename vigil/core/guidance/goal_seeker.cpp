#include "vigil/core/guidance/goal_seeker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace vigil::guidance {
namespace {

// In units of T = spacing / u_max and of spacings; docs/decisions/0005-goals-and-deadlocks.md has what was measured.
constexpr double kLeastShare = 0.3;    ///< of its wish; who is allowed less is blocked
constexpr double kPatience = 0.8;      ///< T, before a blocked drone turns
constexpr double kShortestTurn = 0.6;  ///< T
constexpr double kLongestTurn = 3.0;   ///< T
constexpr double kFirstTurn = 75.0 / 180.0 * std::numbers::pi;
constexpr double kWiderTurn = 15.0 / 180.0 * std::numbers::pi;  ///< by which each turn in vain is followed
constexpr double kWidestTurn = 150.0 / 180.0 * std::numbers::pi;
constexpr double kProgress = 0.8;      ///< spacings; what counts as coming nearer
constexpr double kLongPatience = 4.0;  ///< T, before it asks for room
constexpr double kEarshot = 1.6;       ///< spacings
constexpr double kYield = 1.6;         ///< T

Vec2 turned_right(const Vec2& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() + s * v.y(), -s * v.x() + c * v.y()};
}

/// The direction of v; the x axis for none.
Vec2 direction(const Vec2& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec2(v / length) : Vec2(1.0, 0.0);
}

/// Numbers in [0, 1) that fill it evenly, other ones for each drone (the golden section's sequence).
double next_share(std::size_t drone, unsigned count) {
  const double x = std::numbers::phi * static_cast<double>(count) + 0.7548776662466927 * static_cast<double>(drone);
  return x - std::floor(x);
}

}  // namespace

GoalSeeker::GoalSeeker(const SeekerParameters& parameters, std::size_t drones)
    : parameters_(parameters),
      approach_per_s_(std::min(parameters.u_max_m_s / parameters.spacing_m,
                               parameters.lag_s > 0.0 ? 0.5 / parameters.lag_s : HUGE_VAL)),
      journeys_(drones) {}

bool GoalSeeker::has_arrived(const Traveller& traveller) const noexcept {
  return !traveller.passes && (traveller.goal - traveller.position).norm() < arrival_distance_m();
}

void GoalSeeker::keep_track(const Traveller& traveller) noexcept {
  Journey& journey = journeys_[traveller.drone];
  const double distance = (traveller.goal - traveller.position).norm();
  if (!journey.has_begun || journey.goal != traveller.goal) {
    const unsigned turns = journey.turns;
    journey = {.goal = traveller.goal, .has_begun = true, .nearest_m = distance, .turns = turns};
    return;
  }
  journey.waiting_s += parameters_.dt_s;
  journey.yielding_s = std::max(0.0, journey.yielding_s - parameters_.dt_s);
  if (distance < journey.nearest_m - kProgress * parameters_.spacing_m) {
    journey.nearest_m = distance;
    journey.waiting_s = 0.0;
    journey.turn_rad = 0.0;
  }
}

void GoalSeeker::ask_for_room(const Traveller& asking, std::span<const Traveller> travellers) noexcept {
  const Vec2 ahead = direction(asking.goal - asking.position);
  for (const Traveller& other : travellers) {
    const Vec2 there = other.position - asking.position;
    const double distance = there.norm();
    if (other.drone == asking.drone || distance > kEarshot * parameters_.spacing_m || !has_arrived(other)) continue;
    const double along = ahead.dot(there);
    if (along < -kLeastShare * distance) continue;  // behind
    const Vec2 across = there - along * ahead;
    const Vec2 side =
        across.norm() > 0.1 * parameters_.spacing_m ? direction(across) : turned_right(ahead, 0.5 * std::numbers::pi);
    journeys_[other.drone].aside = direction(side + 0.4 * ahead);
    journeys_[other.drone].yielding_s = kYield * unit_s();
  }
}

/// The share of the last wish that was allowed decides; being held at the goal does not matter.
void GoalSeeker::notice_being_blocked(const Traveller& traveller, Journey& journey) noexcept {
  const double wished = journey.wish.squaredNorm();
  const bool is_blocked =
      wished > 0.0 && !has_arrived(traveller) && traveller.flown.dot(journey.wish) < kLeastShare * wished;
  journey.blocked_s = std::max(0.0, journey.blocked_s + (is_blocked ? parameters_.dt_s : -parameters_.dt_s));
  if (journey.blocked_s <= kPatience * unit_s()) return;
  const double share = next_share(traveller.drone, ++journey.turns);
  journey.turning_s = std::lerp(kShortestTurn, kLongestTurn, share) * unit_s();
  journey.turn_rad = std::min(kWidestTurn, journey.turn_rad > 0.0 ? journey.turn_rad + kWiderTurn : kFirstTurn);
  journey.blocked_s = 0.0;
}

Vec2 GoalSeeker::wish_of(const Traveller& traveller) noexcept {
  Journey& journey = journeys_[traveller.drone];
  if (journey.yielding_s > 0.0) {
    journey.wish.setZero();
    return parameters_.u_max_m_s * journey.aside;
  }
  if (journey.turning_s > 0.0)
    journey.turning_s -= parameters_.dt_s;
  else
    notice_being_blocked(traveller, journey);
  const Vec2 way = traveller.goal - traveller.position - parameters_.lag_s * traveller.velocity;
  if (journey.turning_s > 0.0)
    journey.wish = parameters_.u_max_m_s * turned_right(direction(way), journey.turn_rad);
  else if (traveller.passes)
    journey.wish = parameters_.u_max_m_s * direction(way);
  else
    journey.wish = std::min(approach_per_s_, parameters_.u_max_m_s / std::max(way.norm(), 1e-12)) * way;
  return journey.wish;
}

void GoalSeeker::steer(std::span<const Traveller> travellers, std::span<Vec2> u) noexcept {
  assert(travellers.size() == u.size());
  for (const Traveller& traveller : travellers) keep_track(traveller);
  for (const Traveller& traveller : travellers) {
    const Journey& journey = journeys_[traveller.drone];
    const bool is_stuck = journey.waiting_s > kLongPatience * unit_s() && !has_arrived(traveller);
    if (is_stuck && journey.yielding_s <= 0.0) ask_for_room(traveller, travellers);
  }
  for (std::size_t i = 0; i < travellers.size(); ++i) u[i] = wish_of(travellers[i]);
}

}  // namespace vigil::guidance
