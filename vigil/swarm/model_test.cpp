// A copy of the swarm that is run ahead.
#include <gtest/gtest.h>

#include "vigil/swarm/ideal_world_for_tests.hpp"

namespace vigil::swarm {
namespace {

CoverageTarget somewhere(const ergodic::Basis& basis) {
  CoverageTarget target;
  target.phi_k = basis.evaluate(Vec2(2.2, 0.8)) / 9.0;
  target.has_targets = true;
  return target;
}

IdealWorld flying() {
  IdealWorld world(laboratory(3), {{0.5, 0.5}, {1.5, 1.5}, {2.5, 2.0}});
  world.step({{.kind = CommandKind::kSetTarget,
               .drone = {},
               .target = std::make_shared<CoverageTarget>(somewhere(world.state.basis()))}});
  world.run(2.0);
  return world;
}

TEST(SwarmModelTest, The_next_motion_is_where_an_ideal_drone_is_when_the_next_tick_begins) {
  IdealWorld world = flying();
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((world.state.next_motion(DroneId(i)).position - world.observations[i].position).norm(), 1e-12);
}

TEST(SwarmModelTest, A_model_of_the_same_tick_goes_on_with_the_same_orders) {
  IdealWorld world = flying();
  IdealWorld model = world;
  model.state.become_model(kDt);
  for (int n = 0; n < 100; ++n) {
    world.step();
    model.step();
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_EQ(world.snapshot.drones[i].order.velocity, model.snapshot.drones[i].order.velocity) << n;
  }
}

TEST(SwarmModelTest, A_model_of_longer_ticks_keeps_drones_apart) {
  IdealWorld world = flying();
  SwarmState model = world.state;
  const double dt_s = 5.0 * kDt;
  model.become_model(dt_s);
  EXPECT_EQ(model.parameters().dt_s, dt_s);
  EXPECT_EQ(world.state.parameters().dt_s, kDt);
  for (int n = 0; n < 400; ++n) {
    tick(model, world.observations, {}, world.snapshot);
    for (std::size_t i = 0; i < 3; ++i)
      world.observations[i].position += dt_s * world.snapshot.drones[i].order.velocity;
    for (std::size_t i = 0; i < 3; ++i) ASSERT_GE(world.distance(i, (i + 1) % 3), 0.2 - 1e-9) << n;
  }
}

}  // namespace
}  // namespace vigil::swarm
