#include "vigil/core/dynamics/wind.hpp"

#include <cmath>

namespace vigil::dynamics {

WindState settled_wind(const Wind& wind, const Vec3& normals) noexcept {
  return {Vec3(wind.gusts.sigma * normals.x(), wind.gusts.sigma * normals.y(), wind.vertical_gusts.sigma * normals.z()),
          wind.mean_m_s};
}

WindState advance(const Wind& wind, const WindState& state, const Vec3& normals, double dt_s) noexcept {
  WindState after = state;
  after.gust = {advance(wind.gusts, state.gust.x(), normals.x(), dt_s),
                advance(wind.gusts, state.gust.y(), normals.y(), dt_s),
                advance(wind.vertical_gusts, state.gust.z(), normals.z(), dt_s)};
  after.rejected += -std::expm1(-dt_s / wind.rejection_time_s) * (air_velocity(wind, after) - state.rejected);
  return after;
}

Vec3 air_velocity(const Wind& wind, const WindState& state) noexcept { return wind.mean_m_s + state.gust; }

Vec3 push_of(const Wind& wind, const WindState& state) noexcept {
  return wind.drag_per_s * (air_velocity(wind, state) - state.rejected);
}

}  // namespace vigil::dynamics
