#include "vigil/core/dynamics/packet_link.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

struct Statistics {
  double loss = 0.0;
  double mean_burst = 0.0;
  double shortest_delay = 1e9;
  double longest_delay = 0.0;
};

Statistics of(const PacketLink& link, int packets) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  Statistics seen;
  PacketLinkState state;
  int lost = 0;
  int bursts = 0;
  bool was_lost = false;
  for (int i = 0; i < packets; ++i) {
    const double transition = uniform(random);
    const PacketFate fate = send(link, state, {transition, uniform(random)});
    state = fate.link;
    lost += fate.is_delivered ? 0 : 1;
    bursts += !fate.is_delivered && !was_lost ? 1 : 0;
    was_lost = !fate.is_delivered;
    if (!fate.is_delivered) continue;
    seen.shortest_delay = std::min(seen.shortest_delay, fate.delay_s);
    seen.longest_delay = std::max(seen.longest_delay, fate.delay_s);
  }
  seen.loss = static_cast<double>(lost) / packets;
  seen.mean_burst = static_cast<double>(lost) / std::max(1, bursts);
  return seen;
}

TEST(PacketLink, Loses_its_share_in_bursts_of_its_length) {
  for (const double burst : {2.0, 8.0}) {
    const Statistics seen = of(bursty_link(0.1, burst, 0.005, 0.01), 1'000'000);
    EXPECT_NEAR(seen.loss, 0.1, 0.004);
    EXPECT_NEAR(seen.mean_burst, burst, 0.03 * burst);
  }
}

TEST(PacketLink, Delays_between_its_delay_and_its_jitter_on_top) {
  const Statistics seen = of(bursty_link(0.1, 4.0, 0.005, 0.01), 100'000);
  EXPECT_GE(seen.shortest_delay, 0.005);
  EXPECT_LT(seen.shortest_delay, 0.0051);
  EXPECT_LE(seen.longest_delay, 0.015);
  EXPECT_GT(seen.longest_delay, 0.0149);
}

TEST(PacketLink, Without_loss_delivers_everything) { EXPECT_EQ(of(bursty_link(0.0, 5.0, 0.0, 0.0), 10'000).loss, 0.0); }

TEST(PacketLink, Changes_state_exactly_at_its_probabilities) {
  const PacketLink link{.p_close = 0.2, .p_open = 0.5};
  EXPECT_FALSE(send(link, {false}, {0.9 * 0.2, 0.0}).is_delivered);
  EXPECT_TRUE(send(link, {false}, {1.1 * 0.2, 0.0}).is_delivered);
  EXPECT_TRUE(send(link, {true}, {0.9 * 0.5, 0.0}).is_delivered);
  EXPECT_FALSE(send(link, {true}, {1.1 * 0.5, 0.0}).is_delivered);
}

}  // namespace
}  // namespace vigil::dynamics
