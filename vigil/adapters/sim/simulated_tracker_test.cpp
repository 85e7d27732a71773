#include "vigil/adapters/sim/simulated_tracker.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::sim {
namespace {

constexpr double kDt = 0.02;

SimulatedTracker tracker_with(const TrackerParameters& parameters, std::uint64_t drone = 0) {
  return {parameters, kDt, dynamics::RandomStream(3, drone, 1), dynamics::RandomStream(3, drone, 2)};
}

/// At x = 1 m/s times the time.
runtime::TruthSample moving(int tick) {
  runtime::TruthSample truth;
  truth.position = {tick * kDt, 0.0};
  truth.velocity = {1.0, 0.0};
  return truth;
}

TEST(SimulatedTracker, A_slow_one_measures_seldom_and_says_how_old_it_is) {
  SimulatedTracker tracker = tracker_with({.measurements_per_tick = 0.2});
  for (int tick = 0; tick < 100; ++tick) {
    tracker.measure(moving(tick));
    EXPECT_NEAR(tracker.newest().age_s, (tick % 5) * kDt, 1e-12);
    EXPECT_NEAR(tracker.newest().position.x(), tick * kDt - tracker.newest().age_s, 1e-12);
  }
}

TEST(SimulatedTracker, With_jitter_a_position_is_as_old_as_it_says_and_never_older_than_the_one_before) {
  SimulatedTracker tracker = tracker_with({.delay_s = 0.04, .jitter_s = 0.1});
  double before = -1.0;
  double oldest = 0.0;
  for (int tick = 0; tick < 5000; ++tick) {
    tracker.measure(moving(tick));
    const Sighting& seen = tracker.newest();
    if (seen.age_s == swarm::DroneObservation::kNever) continue;
    EXPECT_NEAR(seen.position.x(), tick * kDt - seen.age_s, 1e-9);
    EXPECT_GE(seen.position.x(), before);
    EXPECT_GE(seen.age_s, 0.04 - 1e-12);
    before = seen.position.x();
    oldest = std::max(oldest, seen.age_s);
  }
  EXPECT_GT(oldest, 0.06);
  EXPECT_LE(oldest, 0.14 + 1e-9);
}

TEST(SimulatedTracker, The_bias_has_its_size_from_the_start_and_wanders_over_its_time) {
  const TrackerParameters parameters{.bias = {.sigma = 2.0, .time_s = 1.0}};
  constexpr int kLag = 50;  // of one correlation time
  double squares = 0.0;
  double products = 0.0;
  double products_at_start = 0.0;
  constexpr int kTrackers = 4000;
  for (int i = 0; i < kTrackers; ++i) {
    SimulatedTracker tracker = tracker_with(parameters, static_cast<std::uint64_t>(i));
    tracker.measure({});
    const Vec2 first = tracker.newest().position;
    tracker.measure({});
    const Vec2 second = tracker.newest().position;
    for (int tick = 2; tick <= kLag; ++tick) tracker.measure({});
    squares += first.squaredNorm() / (2 * kTrackers);
    products_at_start += first.dot(second) / (2 * kTrackers);
    products += first.dot(tracker.newest().position) / (2 * kTrackers);
  }
  EXPECT_NEAR(squares, 4.0, 0.2);
  EXPECT_NEAR(products_at_start / squares, std::exp(-kDt), 0.005);
  EXPECT_NEAR(products / squares, std::exp(-1.0), 0.05);
}

}  // namespace
}  // namespace vigil::sim
