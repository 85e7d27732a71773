#include "vigil/adapters/console/outbound.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/adapters/console/trail_ring.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Latest = ClientLine::Latest;

SharedBytes bytes(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

TEST(OutboundTest, What_is_said_comes_whole_and_in_order_before_any_frame) {
  Outbound outbound;
  outbound.show(Latest::kSnapshot, bytes("s1"));
  ASSERT_TRUE(outbound.say(bytes("a")));
  ASSERT_TRUE(outbound.say(bytes("b")));
  EXPECT_EQ(*outbound.next(0s)->bytes, "a");
  EXPECT_EQ(*outbound.next(0s)->bytes, "b");
  const auto frame = outbound.next(0s);
  EXPECT_EQ(*frame->bytes, "s1");
  EXPECT_FALSE(frame->is_text);
  EXPECT_FALSE(outbound.next(0s));
  EXPECT_TRUE(outbound.is_empty());
}

TEST(OutboundTest, Of_each_kind_only_the_newest_waits) {
  Outbound outbound;
  for (int n = 0; n < 1000; ++n) outbound.show(Latest::kSnapshot, bytes("s" + std::to_string(n)));
  outbound.show(Latest::kAge, bytes("age"));
  std::vector<std::string> sent;
  while (const auto message = outbound.next(0s)) sent.push_back(*message->bytes);
  EXPECT_EQ(sent.size(), 2U);
  EXPECT_NE(std::find(sent.begin(), sent.end(), "s999"), sent.end());
}

TEST(OutboundTest, A_frame_that_is_always_new_does_not_keep_the_others_waiting) {
  Outbound outbound;
  outbound.show(Latest::kTrails, bytes("trails"));
  std::size_t snapshots_before_trails = 0;
  while (true) {
    outbound.show(Latest::kSnapshot, bytes("s"));
    if (*outbound.next(0s)->bytes == "trails") break;
    ASSERT_LT(++snapshots_before_trails, 2U);
  }
}

TEST(OutboundTest, Who_lets_too_much_lie_is_given_up) {
  Outbound outbound;
  const SharedBytes mebibyte = bytes(std::string(1 << 20, 'x'));
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(outbound.say(mebibyte));
  EXPECT_FALSE(outbound.say(bytes("x")));
  (void)outbound.next(0s);
  EXPECT_TRUE(outbound.say(bytes("x")));
}

swarm::Snapshot at(double time_s, double x) {
  swarm::Snapshot snapshot(2);
  snapshot.time_s = time_s;
  snapshot.drones[0].position = {x, 1.0};
  snapshot.drones[1].age_s = std::numeric_limits<double>::infinity();
  return snapshot;
}

TEST(TrailRingTest, The_newest_points_are_kept_oldest_first_drone_by_drone) {
  TrailRing ring(2);
  const double spacing = ring.trails().spacing_s;
  constexpr int kMore = 1000;
  for (int n = 0; n < kMore; ++n) {
    ring.add(at(n * spacing, n));
    ring.add(at((n + 0.5) * spacing, -1.0));  // too early for a point
  }
  const Trails trails = ring.trails();
  ASSERT_LT(trails.points, static_cast<std::size_t>(kMore));
  ASSERT_EQ(trails.xy.size(), 4 * trails.points);
  EXPECT_EQ(trails.newest_s, (kMore - 1) * spacing);
  for (std::size_t n = 0; n < trails.points; ++n) {
    EXPECT_EQ(trails.xy[2 * n], static_cast<float>(kMore - trails.points + n));
    EXPECT_TRUE(std::isnan(trails.xy[2 * trails.points + 2 * n]));
  }
}

TEST(TrailRingTest, Where_the_clock_runs_fast_points_between_two_snapshots_lie_on_the_way) {
  constexpr double kRadians = 0.6;  // a second
  TrailRing ring(1);
  for (int n = 0; n <= 60; ++n) {
    swarm::Snapshot snapshot(1);
    snapshot.time_s = n;
    snapshot.drones[0].age_s = 0.0;
    snapshot.drones[0].position = {std::cos(kRadians * n), std::sin(kRadians * n)};
    snapshot.drones[0].velocity = kRadians * Vec2(-std::sin(kRadians * n), std::cos(kRadians * n));
    ring.add(snapshot);
  }
  const Trails trails = ring.trails();
  ASSERT_EQ(trails.points, static_cast<std::size_t>(60.0 / trails.spacing_s) + 1);
  for (std::size_t k = 0; k < trails.points; ++k) {
    const double time_s = trails.newest_s - static_cast<double>(trails.points - 1 - k) * trails.spacing_s;
    EXPECT_NEAR(trails.xy[2 * k], std::cos(kRadians * time_s), 1e-3);
    EXPECT_NEAR(trails.xy[2 * k + 1], std::sin(kRadians * time_s), 1e-3);
  }
}

TEST(TrailRingTest, After_a_leap_in_time_a_trail_begins_anew) {
  TrailRing ring(2);
  ring.add(at(10.0, 1.0));
  ring.add(at(10'000.0, 2.0));
  EXPECT_EQ(ring.trails().points, 1U);
  ring.add(at(0.0, 3.0));
  EXPECT_EQ(ring.trails().points, 1U);
  EXPECT_EQ(ring.trails().newest_s, 0.0);
}

TEST(TrailRingTest, However_many_drones_there_are_the_memory_is_bounded) {
  EXPECT_LE(TrailRing(10'000).trails().points, 480U);
  TrailRing crowd(10'000);
  for (int n = 0; n < 100; ++n)
    crowd.add([n] {
      swarm::Snapshot snapshot(10'000);
      snapshot.time_s = 100.0 * n;
      return snapshot;
    }());
  EXPECT_LE(crowd.trails().xy.size(), 2U * 400'000U);
}

}  // namespace
}  // namespace vigil::console
