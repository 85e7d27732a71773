#include "vigil/adapters/ros/mistaken_bodies.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vigil::ros_bridge {
namespace {

/// What a tracker, and the expectation of a drone that was seen lately, err together: bodies are wider.
constexpr double kErrorM = 0.02;
/// So near to a drone's expected place there is room for no other body.
constexpr double kSamePlaceM = 0.05;
/// An older expectation does not say that a body is right there,
constexpr double kFreshS = 0.1;
/// unless this drone's own is so new that it cannot have got there, and there was a body not long ago.
constexpr double kNewS = 0.05;
constexpr double kNotLongAgoS = 0.5;

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

double own_error(const NamedBody& body) { return distance(body.seen, body.expected); }

bool is_like(const NamedBody& body, const NamedBody& other) {
  return own_error(body) > distance(body.seen, other.expected) + kErrorM;
}

bool is_in_the_place_of(const NamedBody& body, const NamedBody& other) {
  const bool is_there = other.unseen_s <= kFreshS || (body.unseen_s <= kNewS && other.unseen_s <= kNotLongAgoS);
  return is_there && distance(body.seen, other.expected) <= kSamePlaceM;
}

bool are_on_the_ground(const NamedBody& body, const NamedBody& other) {
  return !body.is_airborne && !other.is_airborne;
}

/// People carry drones over the ground, but no two to each other's places from one position to the next.
bool can_have_been_carried(const NamedBody& body, const NamedBody& other) {
  return are_on_the_ground(body, other) && std::max(body.unseen_s, other.unseen_s) > kFreshS;
}

}  // namespace

void MistakenBodies::judge(std::span<const NamedBody> bodies) noexcept {
  assert(bodies.size() == taken_for_.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].is_timely) continue;
    std::optional<std::size_t>& other = taken_for_[i];
    const bool goes_on = other && is_like(bodies[i], bodies[*other]);
    if (!goes_on) other = whose(bodies, i);
  }
}

std::optional<std::size_t> MistakenBodies::whose(std::span<const NamedBody> bodies, std::size_t drone) noexcept {
  const NamedBody& body = bodies[drone];
  if (!body.is_known || own_error(body) <= kErrorM) return std::nullopt;  // nearly always
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const NamedBody& other = bodies[i];
    if (i == drone || !other.is_known || can_have_been_carried(body, other) || !is_like(body, other)) continue;
    const bool is_swapped = other.is_timely && is_like(other, body);
    if (is_swapped || (!are_on_the_ground(body, other) && is_in_the_place_of(body, other))) return i;
  }
  return std::nullopt;
}

}  // namespace vigil::ros_bridge
