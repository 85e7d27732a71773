#include "vigil/runtime/evasion.hpp"

#include <cmath>
#include <numbers>

namespace vigil::runtime {
namespace {

constexpr int kDirections = 72;
constexpr double kRounding = 1e-9;

bool keeps_away(const Evader& evader, const Vec2& order, std::span<const Vec2> places, double dt_s, const Keep& keep) {
  Vec2 place = evader.position;
  Vec2 velocity = evader.velocity;
  const Vec2 size(keep.field.length_x, keep.field.length_y);
  // One that is at a wall already cannot be asked for more room than it has; where it comes to one it flies along it.
  const Vec2 least = Vec2::Constant(keep.wall_distance_m).cwiseMin(place).cwiseMin(size - place);
  const double answer = evader.lag_s > 0.0 ? -std::expm1(-dt_s / evader.lag_s) : 1.0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    if ((place - places[n]).norm() < keep.distance_m - kRounding) return false;
    if (static_cast<double>(n) * dt_s >= evader.delay_s) velocity += answer * (order - velocity);
    place = (place + dt_s * velocity).cwiseMax(least).cwiseMin(size - least);
  }
  return true;
}

}  // namespace

bool could_evade(const Evader& evader, std::span<const Vec2> places, double dt_s, const Keep& keep) {
  if (keeps_away(evader, Vec2::Zero(), places, dt_s, keep)) return true;
  for (int n = 0; n < kDirections; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / kDirections;
    const Vec2 order = evader.speed_m_s * Vec2(std::cos(angle), std::sin(angle));
    if (keeps_away(evader, order, places, dt_s, keep)) return true;
  }
  return false;
}

}  // namespace vigil::runtime
