#include "vigil/core/dynamics/vehicle_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vigil/core/dynamics/planar_vehicle.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::dynamics {
namespace {

const std::vector<VehicleModel>& every_model() {
  static const std::vector<VehicleModel> models = {ideal_vehicle(), first_order_lag_vehicle(0.3), crazyflie_vehicle(),
                                                   arducopter_vehicle(), px4_vehicle()};
  return models;
}

double difference(const VehicleState& a, const VehicleState& b) {
  return std::max({(a.position - b.position).norm(), (a.velocity - b.velocity).norm(),
                   (a.acceleration - b.acceleration).norm(), (a.correction - b.correction).norm()});
}

/// Three seconds under a command that turns every half second, and a push, in steps of dt.
VehicleState flown(const VehicleModel& model, int steps_in_half_a_second) {
  VehicleState state;
  for (int half = 0; half < 6; ++half) {
    const Vec3 u(3.0 * std::cos(2.0 * half), 3.0 * std::sin(2.0 * half), half % 2 == 0 ? 1.0 : -1.0);
    for (int i = 0; i < steps_in_half_a_second; ++i)
      state = advance(model, state, u, 0.5 / steps_in_half_a_second, Vec3(0.3, -0.2, 0.1));
  }
  return state;
}

TEST(VehicleModel, The_result_does_not_depend_on_the_step) {
  for (const VehicleModel& model : every_model()) {
    const VehicleState finest = flown(model, 5000);
    for (const int steps : {5, 10, 25, 60, 128, 500}) EXPECT_LT(difference(flown(model, steps), finest), 1e-6);
  }
}

TEST(VehicleModel, Two_half_steps_equal_one_step) {
  const VehicleState start{Vec3(1, 2, 3), Vec3(-1, 0.5, 0.2), Vec3(0.1, 0.2, -0.3), Vec3(0.1, 0, 0)};
  const Vec3 u(2.0, -1.0, 0.5);
  for (const VehicleModel& model : every_model()) {
    const VehicleState once = advance(model, start, u, 0.08);
    EXPECT_LT(difference(advance(model, advance(model, start, u, 0.04), u, 0.04), once), 1e-12);
  }
}

TEST(VehicleModel, Turning_the_plane_turns_the_flight) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  for (const VehicleModel& model : every_model()) {
    const VehicleState start = in_flight(model, Vec3::Zero(), Vec3(1, 2, 0.3), Vec3(1, 1, 0.1));
    const VehicleState turned = in_flight(model, Vec3::Zero(), turn * start.velocity, turn * Vec3(1, 1, 0.1));
    const VehicleState after = advance(model, start, Vec3(-3, 2, 0), 0.7);
    const VehicleState after_turned = advance(model, turned, turn * Vec3(-3, 2, 0), 0.7);
    EXPECT_LT((after_turned.position - turn * after.position).norm(), 1e-12);
    EXPECT_LT((after_turned.velocity - turn * after.velocity).norm(), 1e-12);
  }
}

TEST(VehicleModel, In_the_plane_the_simple_kinds_are_the_planar_vehicle) {
  const VehicleState start{Vec3(0.1, 0.2, 0.0), Vec3(0.3, -0.2, 0.0)};
  const Vec3 u(0.5, 0.4, 0.0);
  for (const double lag : {0.0, 0.25}) {
    const VehicleModel model = lag > 0.0 ? first_order_lag_vehicle(lag) : ideal_vehicle();
    const VehicleState after = advance(model, start, u, 0.06);
    const PlanarState planar = advance(
        PlanarVehicle{lag, {}}, PlanarState{start.position.head<2>(), start.velocity.head<2>()}, u.head<2>(), 0.06);
    EXPECT_LT((after.position.head<2>() - planar.position).norm(), 1e-15);
    EXPECT_LT((after.velocity.head<2>() - planar.velocity).norm(), 1e-15);
  }
}

TEST(VehicleModel, Its_horizontal_loop_alone_moves_it_in_the_plane) {
  const Vec2 u(2.0, -1.0);
  const Vec2 push(0.3, 0.1);
  for (const VehicleModel& model : every_model()) {
    VehicleState whole{Vec3(1, 2, 3), Vec3(-1, 0.5, 0.2), Vec3(0.1, 0.2, -0.3), Vec3(0.1, 0, 0)};
    PlanarLoopState plane{Vec2(1, 2), Vec2(-1, 0.5), Vec2(0.1, 0.2), Vec2(0.1, 0)};
    for (int i = 0; i < 50; ++i) {
      whole = advance(model, whole, Vec3(u.x(), u.y(), 0.0), 0.02, Vec3(push.x(), push.y(), 0.0));
      plane = advance(model.horizontal, plane, u, 0.02, push);
    }
    EXPECT_EQ(plane.position, whole.position.head<2>());
    EXPECT_EQ(plane.velocity, whole.velocity.head<2>());
  }
}

TEST(VehicleModel, Wind_that_pushes_for_long_moves_a_vehicle_with_an_integral_no_more) {
  VehicleState state;
  for (int i = 0; i < 1200; ++i) state = advance(px4_vehicle(), state, Vec3::Zero(), 0.1, Vec3(0.5, 0.0, 0.0));
  EXPECT_LT(state.velocity.norm(), 1e-4);
  EXPECT_NEAR(state.correction.x(), -0.5, 1e-3);
}

TEST(VehicleModel, Advancing_allocates_nothing) {
  VehicleState state;
  const testing::AllocationGuard guard;
  for (const VehicleModel& model :
       {ideal_vehicle(), first_order_lag_vehicle(0.3), crazyflie_vehicle(), arducopter_vehicle(), px4_vehicle()})
    state = advance(model, state, Vec3(1, 2, 3), 0.02);
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(state.position.allFinite());
}

TEST(VehicleModel, Every_kind_is_known_by_its_name) {
  for (const VehicleModel& model : every_model()) EXPECT_EQ(vehicle_kind_of(name_of(model.kind)), model.kind);
  EXPECT_EQ(vehicle_kind_of("balloon"), std::nullopt);
}

}  // namespace
}  // namespace vigil::dynamics
