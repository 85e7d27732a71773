#include "vigil/adapters/sim/simulated_wind.hpp"

namespace vigil::sim {

SimulatedWind::SimulatedWind(const dynamics::Wind& wind, bool starts_flying, dynamics::RandomStream random)
    : wind_(wind), random_(random) {
  if (is_calm()) return;
  state_ = dynamics::settled_wind(wind_, draw());
  if (!starts_flying) state_.rejected.setZero();
}

bool SimulatedWind::is_calm() const noexcept { return wind_.gusts.sigma <= 0.0 && wind_.mean_m_s.isZero(0.0); }

/// The plane's two; nothing here moves up and down with the wind.
Vec3 SimulatedWind::draw() noexcept {
  const Vec2 normals = random_.normal(1.0);
  return {normals.x(), normals.y(), 0.0};
}

Vec2 SimulatedWind::advance(bool is_airborne, double dt_s) noexcept {
  if (is_calm()) return Vec2::Zero();
  const Vec2 push = dynamics::push_of(wind_, state_).head<2>();
  state_ = dynamics::advance(wind_, state_, draw(), dt_s);
  if (!is_airborne) state_.rejected.setZero();
  return push;
}

}  // namespace vigil::sim
