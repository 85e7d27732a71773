#include "vigil/adapters/sim/in_transit.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/sim/beat.hpp"

namespace vigil::sim {
namespace {

/// What arrives in one tick; -1 for nothing.
int received(InTransit<int>& transit) {
  const int* const packet = transit.receive();
  return packet == nullptr ? -1 : *packet;
}

TEST(InTransit, A_packet_arrives_after_its_ticks_and_once) {
  InTransit<int> transit(3);
  transit.send(7, 2);
  EXPECT_EQ(received(transit), -1);
  EXPECT_EQ(received(transit), -1);
  EXPECT_EQ(received(transit), 7);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(received(transit), -1);
}

TEST(InTransit, Without_delay_every_packet_arrives_at_once) {
  InTransit<int> transit(0);
  for (int i = 0; i < 10; ++i) {
    transit.send(i, 0);
    EXPECT_EQ(received(transit), i);
  }
}

TEST(InTransit, What_is_overtaken_is_dropped) {
  InTransit<int> transit(3);
  transit.send(1, 3);
  EXPECT_EQ(received(transit), -1);
  transit.send(2, 1);  // overtakes
  EXPECT_EQ(received(transit), -1);
  EXPECT_EQ(received(transit), 2);
  EXPECT_EQ(received(transit), -1);  // the first one comes now, too late
}

TEST(InTransit, Of_two_that_arrive_together_the_newer_is_received) {
  InTransit<int> transit(2);
  transit.send(1, 2);
  EXPECT_EQ(received(transit), -1);
  transit.send(2, 1);
  EXPECT_EQ(received(transit), -1);
  EXPECT_EQ(received(transit), 2);
}

TEST(Beat, It_comes_as_often_as_asked_for_and_evenly) {
  for (const double rate : {0.2, 0.3, 0.07, 1.0 / 3.0}) {
    Beat beat(rate);
    int beats = 0;
    int longest = 0;
    int since = 0;
    for (int tick = 0; tick < 30'000; ++tick) {
      const bool is_due = beat.next();
      if (tick == 0) {
        EXPECT_TRUE(is_due);
      }
      since = is_due ? 0 : since + 1;
      longest = std::max(longest, since);
      beats += is_due ? 1 : 0;
    }
    EXPECT_NEAR(beats, 30'000 * rate, 1.0);
    EXPECT_LE(longest, static_cast<int>(1.0 / rate));
  }
}

TEST(Beat, It_is_never_more_often_than_ticks) {
  Beat beat(2.5);
  for (int tick = 0; tick < 10; ++tick) EXPECT_TRUE(beat.next());
}

}  // namespace
}  // namespace vigil::sim
