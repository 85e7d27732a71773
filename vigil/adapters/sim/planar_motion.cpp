#include "vigil/adapters/sim/planar_motion.hpp"

#include <algorithm>

namespace vigil::sim {
namespace {

using dynamics::PlanarLoopState;

/// v' = (u - v) / lag + push is v' = ((u + lag push) - v) / lag.
PlanarLoopState moved(const dynamics::PlanarVehicle& vehicle, const PlanarLoopState& state, const Vec2& u, double dt_s,
                      const Vec2& push) {
  const Vec2 steady = push.isZero(0.0) ? u : Vec2(u + vehicle.lag_s * push);
  const dynamics::PlanarState after = dynamics::advance(vehicle, {state.position, state.velocity}, steady, dt_s);
  return {after.position, after.velocity, Vec2::Zero(), Vec2::Zero()};
}

PlanarLoopState moved(const dynamics::VelocityLoop& loop, const PlanarLoopState& state, const Vec2& u, double dt_s,
                      const Vec2& push) {
  return dynamics::advance(loop, state, u, dt_s, push);
}

}  // namespace

PlanarMotion::PlanarMotion(const MotionModel& model, std::size_t dead_ticks)
    : model_(model), commands_(dead_ticks + 1, Vec2::Zero()) {}

void PlanarMotion::rest_at(const Vec2& position) noexcept {
  state_ = {};
  state_.position = position;
  std::fill(commands_.begin(), commands_.end(), Vec2::Zero());
}

/// Takes this step's command and gives the one whose time has come: the oldest of the ring.
const Vec2& PlanarMotion::exchange(const Vec2& command) noexcept {
  commands_[next_] = command;
  next_ = next_ + 1 == commands_.size() ? 0 : next_ + 1;
  return commands_[next_];
}

void PlanarMotion::advance(const Vec2& command, double dt_s, const Vec2& push) noexcept {
  const Vec2& u = exchange(command);
  state_ = std::visit([&](const auto& model) { return moved(model, state_, u, dt_s, push); }, model_);
}

}  // namespace vigil::sim
