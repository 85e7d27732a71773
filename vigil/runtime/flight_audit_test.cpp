#include "vigil/runtime/flight_audit.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

AuditLimits limits() {
  AuditLimits limits;
  limits.field = {3.0, 3.0};
  limits.separation_m = 0.2;
  limits.wall_distance_m = 0.17;
  limits.speed_limit_m_s = 0.3;
  return limits;
}

/// Drones in the air, active, flown by velocity.
struct Scene {
  explicit Scene(const std::vector<Vec2>& places) : truth(places.size()), snapshot(places.size()) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      truth[i].position = places[i];
      truth[i].height_m = 1.0;
      truth[i].mode = swarm::VehicleMode::kFlying;
      snapshot.drones[i].activity = swarm::Activity::kActive;
      snapshot.drones[i].order.action = swarm::Action::kVelocity;
    }
  }
  void land(std::size_t drone) {
    truth[drone].height_m = 0.0;
    truth[drone].mode = swarm::VehicleMode::kGrounded;
    snapshot.drones[drone].activity = swarm::Activity::kGrounded;
  }
  std::vector<TruthSample> truth;
  swarm::Snapshot snapshot;
};

AuditTotals judged(const Scene& scene, const AuditLimits& by = limits()) {
  FlightAudit audit(by, scene.truth.size());
  audit.judge(scene.truth, scene.snapshot);
  return audit.totals();
}

TEST(FlightAudit, A_pair_closer_than_R_s_is_a_violation_and_one_at_R_s_is_not) {
  EXPECT_EQ(judged(Scene({{1.0, 1.0}, {1.199, 1.0}})).separation_violations, 1U);
  EXPECT_EQ(judged(Scene({{1.0, 1.0}, {1.2, 1.0}})).separation_violations, 0U);
}

TEST(FlightAudit, No_pair_is_missed_in_any_crowd) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-0.3, 3.3);  // some are outside
  std::uniform_int_distribution<int> die(0, 5);
  for (const std::size_t drones : {2U, 3U, 7U, 40U, 300U}) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Vec2> places;
      for (std::size_t i = 0; i < drones; ++i) places.emplace_back(place(random), place(random));
      Scene scene(places);
      for (std::size_t i = 0; i < drones; ++i) {
        if (die(random) == 0) scene.land(i);
        if (die(random) < trial % 6) scene.snapshot.drones[i].activity = swarm::Activity::kHeld;
      }
      const auto is_up = [&](std::size_t i) { return scene.truth[i].mode == swarm::VehicleMode::kFlying; };
      const auto covers = [&](std::size_t i) { return scene.snapshot.drones[i].activity == swarm::Activity::kActive; };
      std::uint64_t violations = 0;
      double airborne_m = HUGE_VAL;
      double active_m = HUGE_VAL;
      for (std::size_t a = 0; a < drones; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          if (!is_up(a) || !is_up(b)) continue;
          const double distance = (places[a] - places[b]).norm();
          violations += distance < limits().separation_m - 1e-9 ? 1U : 0U;
          airborne_m = std::min(airborne_m, distance);
          if (covers(a) && covers(b)) active_m = std::min(active_m, distance);
        }
      }
      const AuditTotals totals = judged(scene);
      ASSERT_EQ(totals.separation_violations, violations) << drones << " drones, trial " << trial;
      ASSERT_EQ(totals.least.airborne_pair_m, airborne_m);
      ASSERT_EQ(totals.least.active_pair_m, active_m);
    }
  }
}

TEST(FlightAudit, A_landed_drone_comes_too_close_to_nobody) {
  Scene scene({{1.0, 1.0}, {1.05, 1.0}, {2.0, 2.0}});
  scene.land(1);
  const AuditTotals totals = judged(scene);
  EXPECT_EQ(totals.separation_violations, 0U);
  EXPECT_NEAR(totals.least.airborne_pair_m, std::sqrt(2.0), 1e-12);
}

TEST(FlightAudit, A_failed_drone_in_the_air_counts_among_the_airborne_but_not_among_the_active) {
  Scene scene({{1.0, 1.0}, {1.05, 1.0}, {2.0, 1.0}});
  scene.snapshot.drones[1].activity = swarm::Activity::kVehicleFailed;
  const AuditTotals totals = judged(scene);
  EXPECT_EQ(totals.separation_violations, 1U);
  EXPECT_NEAR(totals.least.airborne_pair_m, 0.05, 1e-12);
  EXPECT_NEAR(totals.least.active_pair_m, 1.0, 1e-12);
}

TEST(FlightAudit, The_border_counts_from_both_sides) {
  EXPECT_EQ(judged(Scene({{0.16, 1.0}})).wall_violations, 1U);
  const AuditTotals outside = judged(Scene({{3.5, 1.0}}));
  EXPECT_EQ(outside.wall_violations, 1U);
  EXPECT_NEAR(outside.least.wall_m, -0.5, 1e-12);
  EXPECT_EQ(judged(Scene({{0.17, 0.17}})).wall_violations, 0U);
}

TEST(FlightAudit, A_no_fly_polygon_is_violated_within_its_buffer) {
  AuditLimits by = limits();
  by.no_fly = {{{{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}}}};
  by.no_fly_buffer_m = 0.1;
  EXPECT_EQ(judged(Scene({{0.95, 1.5}}), by).no_fly_violations, 1U);
  EXPECT_EQ(judged(Scene({{0.85, 1.5}}), by).no_fly_violations, 0U);
  EXPECT_NEAR(judged(Scene({{1.5, 1.4}}), by).least.no_fly_m, -0.4, 1e-12);
}

TEST(FlightAudit, A_vehicle_that_cannot_follow_exactly_is_judged_by_its_order) {
  Scene scene({{1.0, 1.0}});
  scene.truth[0].velocity = Vec2(0.0, 0.33);  // it overshoots
  scene.snapshot.drones[0].order.velocity = Vec2(0.0, 0.3);
  EXPECT_EQ(judged(scene).speed_violations, 1U);
  AuditLimits lenient = limits();
  lenient.follows_exactly = false;
  EXPECT_EQ(judged(scene, lenient).speed_violations, 0U);
  scene.snapshot.drones[0].order.velocity = Vec2(0.0, 0.31);
  EXPECT_EQ(judged(scene, lenient).speed_violations, 1U);
}

TEST(FlightAudit, Only_drones_that_the_controller_steers_can_break_its_speed_limit) {
  Scene scene({{1.0, 1.0}, {2.0, 2.0}});
  scene.truth[0].velocity = Vec2(0.4, 0.0);
  scene.truth[1].velocity = Vec2(0.5, 0.0);
  scene.snapshot.drones[1].order.action = swarm::Action::kNone;  // a pilot has it
  const AuditTotals totals = judged(scene);
  EXPECT_EQ(totals.speed_violations, 1U);
  EXPECT_DOUBLE_EQ(totals.max_speed_m_s, 0.4);
}

TEST(FlightAudit, Where_a_pilot_flies_is_the_pilots_until_the_drone_is_back_within_the_limits) {
  Scene scene({{-0.5, 1.0}});
  FlightAudit audit(limits(), 1);
  scene.truth[0].mode = swarm::VehicleMode::kManual;
  scene.truth[0].velocity = Vec2(5.0, 0.0);
  audit.judge(scene.truth, scene.snapshot);
  scene.truth[0].mode = swarm::VehicleMode::kFlying;  // given back, still outside
  audit.judge(scene.truth, scene.snapshot);
  EXPECT_EQ(audit.totals().wall_violations + audit.totals().speed_violations, 0U);
  scene.truth[0].position = Vec2(1.0, 1.0);
  scene.truth[0].velocity.setZero();
  audit.judge(scene.truth, scene.snapshot);
  scene.truth[0].position = Vec2(0.1, 1.0);  // the controller's own doing
  audit.judge(scene.truth, scene.snapshot);
  EXPECT_EQ(audit.totals().wall_violations, 1U);
}

TEST(FlightAudit, The_sweep_finds_what_looking_at_every_pair_finds) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> coordinate(0.0, 3.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> places;
    for (int i = 0; i < 30; ++i) places.emplace_back(coordinate(random), coordinate(random));
    Scene scene(places);
    for (std::size_t i = 0; i < 30; i += 3) scene.snapshot.drones[i].activity = swarm::Activity::kHeld;
    double airborne = std::numeric_limits<double>::infinity();
    double active = airborne;
    std::uint64_t violations = 0;
    for (std::size_t i = 0; i < 30; ++i) {
      for (std::size_t j = i + 1; j < 30; ++j) {
        const double distance = (places[i] - places[j]).norm();
        airborne = std::min(airborne, distance);
        if (i % 3 != 0 && j % 3 != 0) active = std::min(active, distance);
        violations += distance < 0.2 ? 1U : 0U;
      }
    }
    const AuditTotals totals = judged(scene);
    ASSERT_EQ(totals.least.airborne_pair_m, airborne);
    ASSERT_EQ(totals.least.active_pair_m, active);
    ASSERT_EQ(totals.separation_violations, violations);
  }
}

}  // namespace
}  // namespace vigil::runtime
