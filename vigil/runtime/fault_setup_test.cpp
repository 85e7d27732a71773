#include "vigil/runtime/fault_setup.hpp"

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

/// The paper's: a mission that says nothing of noise, delays and lag.
Mission ideal_mission() {
  Mission mission;
  mission.field.size_m = Vec2(3.0, 3.0);
  mission.control.speed_limit_m_s = 0.3;
  mission.drones = {{"a", Vec2(1.0, 1.0)}, {"b", Vec2(2.0, 2.0)}};
  return mission;
}

TEST(FaultSetup, Simulated_drones_are_held_against_what_the_mission_simulates) {
  const dynamics::FaultProblem problem = fault_problem(ideal_mission());
  EXPECT_EQ(problem.noise_m, 0.0);
  EXPECT_EQ(problem.held_s, 0.0);
  EXPECT_EQ(fault_parameters(ideal_mission()).bounds.residual_m, dynamics::fault_bounds(problem).residual_m);
}

/// The adapter lets positions pass that are 0.1 m off or 0.15 s late, and a Crazyflie flies 0.88 of what it is told.
TEST(FaultSetup, Real_drones_are_given_what_their_adapter_lets_pass) {
  const Mission mission = ideal_mission();
  const dynamics::FaultBounds bounds = real_fault_parameters(mission).bounds;
  EXPECT_GE(bounds.jump_m, 0.1);
  EXPECT_GE(bounds.residual_m, 0.1 + 0.12 * 0.3 / bounds.residual_leak_per_s);
  EXPECT_GE(bounds.held_s, 0.15);
  EXPECT_FALSE(bounds.never_repeats);
  EXPECT_LT(bounds.blind_s, 5.0);  // and it is still of use
}

}  // namespace
}  // namespace vigil::runtime
