#include "vigil/core/dynamics/vehicle_model.hpp"

#include <array>

#include "vigil/core/dynamics/loop_steps.hpp"

namespace vigil::dynamics {
namespace {

struct NamedKind {
  VehicleKind kind;
  std::string_view name;
};

constexpr std::array kNames = {
    NamedKind{VehicleKind::kIdeal, "ideal"},
    NamedKind{VehicleKind::kFirstOrderLag, "first_order_lag"},
    NamedKind{VehicleKind::kCrazyflie, "crazyflie"},
    NamedKind{VehicleKind::kArduCopter, "arducopter"},
    NamedKind{VehicleKind::kPx4, "px4"},
};

/// The part of a vector that one of the two loops moves: N components from `first` on.
template <int N>
loop_steps::State<N> part_of(const VehicleState& state, int first) {
  return {state.position.segment<N>(first), state.velocity.segment<N>(first), state.acceleration.segment<N>(first),
          state.correction.segment<N>(first)};
}

template <int N>
void put(const loop_steps::State<N>& part, int first, VehicleState& into) {
  into.position.segment<N>(first) = part.p;
  into.velocity.segment<N>(first) = part.v;
  into.acceleration.segment<N>(first) = part.a;
  into.correction.segment<N>(first) = part.i;
}

}  // namespace

VehicleModel ideal_vehicle() noexcept { return {}; }

VehicleModel first_order_lag_vehicle(double lag_s) noexcept {
  VelocityLoop loop;
  loop.proportional_per_s = 1.0 / lag_s;
  return {VehicleKind::kFirstOrderLag, loop, loop};
}

std::string_view name_of(VehicleKind kind) noexcept {
  for (const NamedKind& named : kNames)
    if (named.kind == kind) return named.name;
  return {};
}

std::optional<VehicleKind> vehicle_kind_of(std::string_view name) noexcept {
  for (const NamedKind& named : kNames)
    if (named.name == name) return named.kind;
  return std::nullopt;
}

VehicleState in_flight(const VehicleModel& model, const Vec3& position, const Vec3& velocity,
                       const Vec3& command) noexcept {
  VehicleState state{position, velocity};
  for (int axis = 0; axis < 3; ++axis) {
    const VelocityLoop& loop = axis < 2 ? model.horizontal : model.vertical;
    state.correction[axis] = in_flight(loop, velocity[axis], command[axis]).correction_m_s2;
  }
  return state;
}

VehicleState advance(const VehicleModel& model, const VehicleState& state, const Vec3& u, double dt_s,
                     const Vec3& push) noexcept {
  VehicleState after;
  put<2>(loop_steps::advanced<2>(model.horizontal, part_of<2>(state, 0), u.head<2>(), push.head<2>(), dt_s), 0, after);
  put<1>(loop_steps::advanced<1>(model.vertical, part_of<1>(state, 2), u.tail<1>(), push.tail<1>(), dt_s), 2, after);
  return after;
}

}  // namespace vigil::dynamics
