#include "vigil/core/dynamics/velocity_loop.hpp"

#include <cmath>

#include "vigil/core/dynamics/loop_steps.hpp"

namespace vigil::dynamics {
namespace {

using Scalar = loop_steps::Vector<1>;

}  // namespace

bool is_immediate(const VelocityLoop& loop) noexcept { return std::isinf(loop.proportional_per_s); }

bool is_linear(const VelocityLoop& loop) noexcept {
  return std::isinf(loop.acceleration_limit_m_s2) && std::isinf(loop.jerk_limit_m_s3);
}

double steady_gain(const VelocityLoop& loop) noexcept {
  if (is_immediate(loop) || loop.integral_per_s2 > 0.0) return loop.gain;
  return loop.gain * loop.proportional_per_s / (loop.proportional_per_s + loop.drag_per_s);
}

AxisState in_flight(const VelocityLoop& loop, double velocity_m_s, double command_m_s) noexcept {
  AxisState state{.velocity_m_s = velocity_m_s};
  if (loop.integral_per_s2 > 0.0)
    state.correction_m_s2 =
        loop.drag_per_s * velocity_m_s - loop.proportional_per_s * (loop.gain * command_m_s - velocity_m_s);
  return state;
}

AxisState advance(const VelocityLoop& loop, const AxisState& state, double command_m_s, double dt_s,
                  double push_m_s2) noexcept {
  const loop_steps::State<1> before{Scalar(state.position_m), Scalar(state.velocity_m_s),
                                    Scalar(state.acceleration_m_s2), Scalar(state.correction_m_s2)};
  const loop_steps::State<1> after =
      loop_steps::advanced<1>(loop, before, Scalar(command_m_s), Scalar(push_m_s2), dt_s);
  return {after.p.x(), after.v.x(), after.a.x(), after.i.x()};
}

PlanarLoopState advance(const VelocityLoop& loop, const PlanarLoopState& state, const Vec2& command_m_s, double dt_s,
                        const Vec2& push_m_s2) noexcept {
  const loop_steps::State<2> before{state.position, state.velocity, state.acceleration, state.correction};
  const loop_steps::State<2> after = loop_steps::advanced<2>(loop, before, command_m_s, push_m_s2, dt_s);
  return {after.p, after.v, after.a, after.i};
}

}  // namespace vigil::dynamics
