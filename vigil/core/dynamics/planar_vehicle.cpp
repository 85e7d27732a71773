#include "vigil/core/dynamics/planar_vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::dynamics {
namespace {

/// v' = (u - v) / lag:  v(t) = u - e exp(-t/lag),  p(t) = p + u t - e lag (1 - exp(-t/lag)),  e = u - v(0).
PlanarState advance_exponentially(const PlanarState& state, const Vec2& u, double lag_s, double dt_s) {
  const Vec2 error = u - state.velocity;
  const double decay = std::exp(-dt_s / lag_s);
  return {state.position + u * dt_s - error * (lag_s * (1.0 - decay)), u - error * decay};
}

}  // namespace

PlanarState advance(const PlanarVehicle& vehicle, const PlanarState& state, const Vec2& u, double dt_s) noexcept {
  if (vehicle.lag_s <= 0.0) return {state.position + u * dt_s, u};
  if (!vehicle.acceleration_limit_m_s2) return advance_exponentially(state, u, vehicle.lag_s, dt_s);

  const double limit = *vehicle.acceleration_limit_m_s2;
  const Vec2 error = u - state.velocity;
  const double length = error.norm();
  const double saturated_s = std::clamp(length / limit - vehicle.lag_s, 0.0, dt_s);
  if (saturated_s <= 0.0) return advance_exponentially(state, u, vehicle.lag_s, dt_s);

  const Vec2 acceleration = error * (limit / length);
  const PlanarState turned{
      state.position + state.velocity * saturated_s + acceleration * (0.5 * saturated_s * saturated_s),
      state.velocity + acceleration * saturated_s};
  return advance_exponentially(turned, u, vehicle.lag_s, dt_s - saturated_s);
}

}  // namespace vigil::dynamics
