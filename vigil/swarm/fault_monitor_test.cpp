#include "vigil/swarm/fault_monitor.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/random_stream.hpp"

namespace vigil::swarm {
namespace {

constexpr double kStep = 0.02;
constexpr double kNoise = 0.002;
constexpr double kSpeed = 0.5;

WatchSetup setup() {
  WatchSetup result;
  dynamics::FaultProblem problem;
  problem.u_max_m_s = kSpeed;
  problem.noise_m = kNoise;
  problem.velocity_noise_m_s = 0.02;
  result.parameters.watches = true;
  result.parameters.bounds = dynamics::fault_bounds(problem);
  result.field = {.length_x = 10.0, .length_y = 10.0};
  result.dt_s = kStep;
  return result;
}

/// Drones that fly exactly what they are ordered, seen with noise and without delay, and what a test does to them.
class World {
 public:
  explicit World(std::size_t drones)
      : monitor(setup(), drones),
        truth(drones),
        orders(drones, Vec2(0.3, 0.0)),
        flown(drones, kStep, 1.0),
        memory_(drones),
        seen(drones),
        random_(3, 1, 1) {
    for (std::size_t i = 0; i < drones; ++i) truth[i] = Vec2(1.0, 1.0 + static_cast<double>(i));
    for (DroneMemory& drone : memory_) {
      drone.activity = Activity::kActive;
      drone.intent = Intent::kCover;
    }
  }

  template <class Spoil>
  void fly(double for_s, const Spoil& spoil) {
    for (double left_s = for_s; left_s > 0.5 * kStep; left_s -= kStep) {
      for (std::size_t i = 0; i < truth.size(); ++i) see(i);
      spoil(*this);
      std::vector<Motion> expected;
      for (const Vec2& place : truth) expected.push_back({place, Vec2::Zero()});
      monitor.look(seen, memory_, expected, flown);
      flown.remember(orders);
      for (std::size_t i = 0; i < truth.size(); ++i) truth[i] += kStep * orders[i] + kStep * astray;
    }
  }
  void fly(double for_s) {
    fly(for_s, [](World&) {});
  }
  [[nodiscard]] Fault fault(std::size_t drone = 0) const { return monitor.report(drone).kind; }
  [[nodiscard]] DroneMemory& memory(std::size_t drone) { return memory_[drone]; }

  FaultMonitor monitor;
  std::vector<Vec2> truth;
  std::vector<Vec2> orders;
  Vec2 astray = Vec2::Zero();  ///< of all drones
  FlownOrders flown;

 private:
  void see(std::size_t i) {
    seen[i].position = truth[i] + random_.normal(kNoise);
    seen[i].velocity = orders[i] + astray + random_.normal(0.02);
    seen[i].age_s = 0.0;
    seen[i].link_age_s = 0.0;
    seen[i].mode = VehicleMode::kFlying;
  }

  std::vector<DroneMemory> memory_;

 public:
  std::vector<DroneObservation> seen;

 private:
  dynamics::RandomStream random_;
};

TEST(FaultMonitor, Nothing_is_wrong_with_drones_that_turn_and_stop_as_they_are_told) {
  World world(3);
  for (int turn = 0; turn < 200; ++turn) {
    const double angle = 2.4 * turn;
    world.orders.assign(3, turn % 5 == 0 ? Vec2(Vec2::Zero()) : kSpeed * Vec2(std::cos(angle), std::sin(angle)));
    world.fly(0.3);
    for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(world.fault(i), Fault::kNone) << turn;
  }
}

TEST(FaultMonitor, A_place_out_of_reach_is_not_believed_and_is_a_fault_when_it_stays) {
  World world(1);
  world.fly(1.0);
  const Vec2 shift(0.4, 0.0);
  world.fly(kStep, [&](World& w) { w.seen[0].position += shift; });
  EXPECT_FALSE(world.monitor.believed(0).position.allFinite());
  EXPECT_EQ(world.fault(), Fault::kNone);
  world.fly(0.2, [&](World& w) { w.seen[0].position += shift; });
  EXPECT_EQ(world.fault(), Fault::kJumped);
  EXPECT_GT(world.monitor.report(0).measured, world.monitor.report(0).threshold);
}

TEST(FaultMonitor, A_single_stray_measurement_is_screened_and_no_fault) {
  World world(1);
  world.fly(1.0);
  world.fly(kStep, [](World& w) { w.seen[0].position += Vec2(1.0, 1.0); });
  EXPECT_FALSE(world.monitor.believed(0).position.allFinite());
  world.fly(kStep);
  EXPECT_TRUE(world.monitor.believed(0).position.allFinite());
  world.fly(0.3);
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, A_drone_is_believed_at_once_when_its_place_leaps_back) {
  World world(1);
  world.fly(1.0);
  world.fly(0.3, [](World& w) { w.seen[0].position += Vec2(1.0, 1.0); });
  ASSERT_EQ(world.fault(), Fault::kJumped);
  world.fly(kStep);
  EXPECT_EQ(world.fault(), Fault::kNone);
  EXPECT_TRUE(world.monitor.believed(0).position.allFinite());
}

TEST(FaultMonitor, A_lasting_offset_is_never_believed_in_the_air) {
  World world(1);
  world.fly(1.0);
  world.orders[0].setZero();
  world.fly(30.0, [](World& w) { w.seen[0].position += Vec2(1.0, 1.0); });
  EXPECT_EQ(world.fault(), Fault::kJumped);
  world.memory(0).activity = Activity::kLanding;  // an operator lands it
  world.fly(kStep, [](World& w) {
    w.seen[0].position += Vec2(1.0, 1.0);
    w.seen[0].mode = VehicleMode::kLanding;
  });
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, Two_exchanged_drones_are_named_with_each_other_until_their_names_are_right) {
  World world(3);
  world.fly(1.0);
  const auto exchange = [](World& w) {
    std::swap(w.seen[0].position, w.seen[2].position);
    std::swap(w.seen[0].velocity, w.seen[2].velocity);
  };
  world.fly(0.2, exchange);
  EXPECT_EQ(world.fault(0), Fault::kSwapped);
  EXPECT_EQ(world.fault(1), Fault::kNone);
  EXPECT_EQ(world.fault(2), Fault::kSwapped);
  EXPECT_EQ(world.monitor.report(0).other, DroneId(2));
  EXPECT_EQ(world.monitor.report(2).other, DroneId(0));
  world.orders.assign(3, Vec2::Zero());
  world.fly(20.0, exchange);
  EXPECT_EQ(world.fault(0), Fault::kSwapped);
  world.fly(kStep);
  EXPECT_EQ(world.fault(0), Fault::kNone);
  EXPECT_EQ(world.fault(2), Fault::kNone);
}

TEST(FaultMonitor, A_frozen_place_is_as_old_as_its_first_appearance) {
  World world(1);
  world.fly(1.0);
  const Vec2 last = world.seen[0].position;
  const auto freeze = [&](World& w) { w.seen[0].position = last; };
  const double frozen_s = setup().parameters.bounds.frozen_s;
  world.fly(frozen_s - 2.0 * kStep, freeze);
  EXPECT_EQ(world.fault(), Fault::kNone);
  world.fly(3.0 * kStep, freeze);
  EXPECT_EQ(world.fault(), Fault::kFrozen);
  EXPECT_NEAR(world.monitor.believed(0).age_s, frozen_s + kStep, 2.0 * kStep);
  world.fly(0.1);
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, A_drone_that_drifts_beside_its_orders_does_not_follow_them) {
  World world(1);
  world.fly(1.0);
  world.astray = Vec2(0.0, 0.3);
  const dynamics::FaultBounds bounds = setup().parameters.bounds;
  const double leak = bounds.residual_leak_per_s;
  const double needed_s = -std::log1p(-leak * bounds.residual_m / 0.3) / leak;
  world.fly(kStep);
  EXPECT_EQ(world.fault(), Fault::kNone);
  world.fly(2.0 * needed_s);
  EXPECT_EQ(world.fault(), Fault::kNotFollowing);
  world.astray.setZero();
  world.fly(20.0);
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, A_velocity_that_is_not_that_of_the_places_disagrees) {
  World world(1);
  world.fly(1.0);
  world.fly(0.5, [](World& w) { w.seen[0].velocity += Vec2(0.5, 0.0); });
  EXPECT_EQ(world.fault(), Fault::kDisagreeing);
  EXPECT_GT(world.monitor.report(0).measured, world.monitor.report(0).threshold);
}

TEST(FaultMonitor, A_drone_whose_velocity_alone_is_wrong_has_the_one_that_its_orders_give_it) {
  World world(1);
  world.fly(1.0);
  world.fly(2.0, [](World& w) { w.seen[0].velocity += Vec2(0.0, 0.5); });
  ASSERT_EQ(world.fault(), Fault::kDisagreeing);
  EXPECT_NEAR((world.monitor.believed(0).velocity - world.orders[0]).norm(), 0.0, 0.01);
  EXPECT_TRUE(world.monitor.believed(0).position.allFinite());
  world.orders[0].setZero();
  world.fly(30.0);
  ASSERT_EQ(world.fault(), Fault::kNone);
  EXPECT_EQ(world.monitor.believed(0).velocity, world.seen[0].velocity);
}

TEST(FaultMonitor, A_drone_that_neither_follows_its_orders_nor_flies_as_it_says_is_taken_at_its_word) {
  World world(1);
  world.fly(1.0);
  world.astray = Vec2(0.0, 0.4);
  world.fly(3.0, [](World& w) { w.seen[0].velocity += Vec2(0.5, 0.0); });
  ASSERT_NE(world.fault(), Fault::kNone);
  EXPECT_EQ(world.monitor.believed(0).velocity, world.seen[0].velocity);
}

TEST(FaultMonitor, A_drone_beyond_the_border_is_outside_until_it_is_back) {
  World world(1);
  world.truth[0] = Vec2(9.9, 5.0);
  world.fly(0.3);
  EXPECT_EQ(world.fault(), Fault::kNone);
  world.fly(0.3);
  EXPECT_EQ(world.fault(), Fault::kOutside);
  world.orders[0] = Vec2(-0.3, 0.0);
  world.fly(1.0);
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, A_drone_that_lands_unasked_changed_its_mode_by_itself) {
  World world(2);
  world.fly(1.0);
  world.memory(1).intent = Intent::kLand;
  const auto land = [](World& w) {
    for (DroneObservation& drone : w.seen) drone.mode = VehicleMode::kLanding;
  };
  world.fly(kStep, land);
  EXPECT_EQ(world.fault(0), Fault::kOwnMode);
  EXPECT_EQ(world.fault(1), Fault::kNone);
  world.fly(kStep, [](World& w) { w.seen[0].mode = VehicleMode::kGrounded; });
  EXPECT_EQ(world.fault(0), Fault::kNone);
}

TEST(FaultMonitor, A_repeated_observation_that_grows_older_says_nothing) {
  World world(1);
  world.fly(1.0);
  const DroneObservation last = world.seen[0];
  double age_s = 0.0;
  world.fly(3.0, [&](World& w) {
    w.seen[0] = last;
    w.seen[0].age_s = age_s += kStep;
  });
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, Nothing_from_outside_breaks_it) {
  World world(1);
  world.fly(1.0);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  world.fly(0.1, [&](World& w) { w.seen[0].position = Vec2(bad, 0.0); });
  world.fly(0.1, [&](World& w) { w.seen[0].age_s = -1.0; });
  world.fly(0.1, [&](World& w) { w.seen[0].age_s = DroneObservation::kNever; });
  world.fly(0.1, [&](World& w) { w.seen[0].velocity = Vec2(bad, bad); });
  world.fly(0.5);
  EXPECT_EQ(world.fault(), Fault::kNone);
}

TEST(FaultMonitor, Without_thresholds_it_does_not_look) { EXPECT_FALSE(FaultMonitor({}, 5).watches()); }

}  // namespace
}  // namespace vigil::swarm
