#include "vigil/core/guidance/step_aside.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::guidance {
namespace {

/// Of u_max. What is slower takes so long that the filter, which gives way at once, has room enough.
constexpr double kFast = 0.2;
/// How many times as early as it must.
constexpr double kEarly = 2.0;

/// Beyond what is kept from walls; negative where there is none.
double spare_m(const AsideParameters& parameters, const Vec2& place) {
  const double least =
      std::min({place.x(), place.y(), parameters.field.length_x - place.x(), parameters.field.length_y - place.y()});
  return least - parameters.wall_distance_m;
}

}  // namespace

bool is_fast(const AsideParameters& parameters, const Stray& stray) noexcept {
  return stray.velocity.norm() >= kFast * parameters.u_max_m_s;
}

std::optional<Vec2> step_aside(const AsideParameters& parameters, const Stray& stray, const Vec2& place) noexcept {
  if (!is_fast(parameters, stray)) return std::nullopt;
  const double speed_m_s = stray.velocity.norm();
  const Vec2 ahead = stray.velocity / speed_m_s;
  const Vec2 left(-ahead.y(), ahead.x());
  const Vec2 from = place - stray.position;
  const double ahead_m = from.dot(ahead);
  const double left_m = from.dot(left);
  const double lacking_m = parameters.room_m - std::abs(left_m);
  const double early_s = kEarly * (parameters.answer_s + lacking_m / parameters.u_max_m_s);
  const bool is_past = ahead_m < -parameters.room_m;
  if (lacking_m <= 0.0 || is_past || ahead_m > speed_m_s * early_s + parameters.room_m) return std::nullopt;

  const auto end = [&](double side) -> Vec2 { return place + (side * parameters.room_m - left_m) * left; };
  double side = left_m >= 0.0 ? 1.0 : -1.0;
  const double spare_there_m = spare_m(parameters, end(side));
  if (spare_there_m < 0.0 && spare_m(parameters, end(-side)) > spare_there_m) side = -side;
  return side * parameters.u_max_m_s * left;
}

}  // namespace vigil::guidance
