#include "vigil/adapters/sim/simulated_link.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::sim {
namespace {

constexpr double kDt = 0.02;

LinkParameters lossy(double loss, double burst, double delay_s = 0.0, double jitter_s = 0.0) {
  return {.packets = dynamics::bursty_link(loss, burst, delay_s, jitter_s)};
}

dynamics::RandomStream stream(std::uint64_t number) { return {5, number, 4}; }

TEST(SimulatedLink, It_loses_its_share_in_bursts_of_its_length) {
  for (const auto& [loss, burst] : std::vector<std::pair<double, double>>{{0.1, 5.0}, {0.3, 2.0}, {0.02, 20.0}}) {
    SimulatedLink link(lossy(loss, burst), kDt, stream(1));
    constexpr int kPackets = 1'000'000;
    int lost = 0;
    int bursts = 0;
    bool was_lost = false;
    for (int i = 0; i < kPackets; ++i) {
      const bool is_lost = !link.send();
      lost += is_lost ? 1 : 0;
      bursts += is_lost && !was_lost ? 1 : 0;
      was_lost = is_lost;
    }
    EXPECT_NEAR(static_cast<double>(lost) / kPackets, loss, 0.05 * loss);
    EXPECT_NEAR(static_cast<double>(lost) / bursts, burst, 0.05 * burst);
  }
}

TEST(SimulatedLink, Delays_lie_between_delay_and_delay_plus_jitter_and_are_even) {
  SimulatedLink link(lossy(0.0, 1.0, 0.04, 0.08), kDt, stream(2));
  std::vector<int> counts(link.longest_ticks() + 1, 0);
  constexpr int kPackets = 100'000;
  for (int i = 0; i < kPackets; ++i) ++counts.at(link.send().value());
  ASSERT_EQ(counts.size(), 7U);
  EXPECT_EQ(counts[0] + counts[1], 0);
  // Uniform between 2 and 6 ticks, rounded: the ends have half a share.
  for (const std::size_t ticks : {3U, 4U, 5U}) EXPECT_NEAR(counts[ticks], kPackets / 4, kPackets / 100);
  for (const std::size_t ticks : {2U, 6U}) EXPECT_NEAR(counts[ticks], kPackets / 8, kPackets / 100);
}

TEST(SimulatedLink, Whole_delays_are_rounded_to_the_nearest_tick) {
  SimulatedLink link(lossy(0.0, 1.0, 0.051), kDt, stream(3));
  EXPECT_EQ(link.send(), std::optional<std::size_t>(3));
}

TEST(SimulatedLink, A_slow_one_sends_seldom) {
  LinkParameters slow;
  slow.packets_per_tick = 0.2;
  SimulatedLink link(slow, kDt, stream(4));
  for (int tick = 0; tick < 50; ++tick) EXPECT_EQ(link.send().has_value(), tick % 5 == 0);
}

TEST(SimulatedLink, While_it_is_cut_nothing_passes_and_afterwards_all_is_as_without) {
  SimulatedLink whole(lossy(0.3, 3.0), kDt, stream(5));
  SimulatedLink cut(lossy(0.3, 3.0), kDt, stream(5));
  cut.cut(1.0);
  for (int tick = 0; tick < 500; ++tick) {
    const bool passes = whole.send().has_value();
    EXPECT_EQ(cut.send().has_value(), passes && tick >= 50) << tick;
  }
}

TEST(Channel, The_newest_order_stands_whatever_overtakes_whatever) {
  Channel<int> channel(lossy(0.2, 2.0, 0.0, 0.2), kDt, stream(6));
  int newest = -1;
  int arrivals = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    const int* const packet = channel.pass(tick);
    if (packet == nullptr) continue;
    EXPECT_GT(*packet, newest);
    EXPECT_LE(tick - *packet, 10);
    newest = *packet;
    ++arrivals;
  }
  EXPECT_GT(arrivals, 2000);
  EXPECT_LT(arrivals, 8000);
}

}  // namespace
}  // namespace vigil::sim
