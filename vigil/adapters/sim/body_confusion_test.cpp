#include "vigil/adapters/sim/body_confusion.hpp"

#include <gtest/gtest.h>

namespace vigil::sim {
namespace {

constexpr double kDt = 0.02;

/// Two pairs, far from each other.
std::vector<runtime::TruthSample> two_pairs() {
  std::vector<runtime::TruthSample> truth(4);
  truth[0].position = {0.0, 0.0};
  truth[1].position = {9.0, 0.0};
  truth[2].position = {0.5, 0.0};
  truth[3].position = {9.5, 0.0};
  return truth;
}

TEST(BodyConfusion, Two_that_are_near_are_exchanged_and_come_back) {
  BodyConfusion confusion({.swaps_per_h = 360.0, .swap_s = 0.5}, 4, dynamics::RandomStream(1, 0, 6));
  int confused = 0;
  int begun = 0;
  constexpr int kTicks = 500'000;
  bool was = false;
  for (int i = 0; i < kTicks; ++i) {
    confusion.advance(two_pairs(), kDt);
    for (const std::size_t drone : {0U, 1U}) {
      const std::size_t partner = drone + 2;
      const bool is = confusion.body_of(drone) != drone;
      ASSERT_EQ(confusion.body_of(drone), is ? partner : drone);
      ASSERT_EQ(confusion.body_of(partner), is ? drone : partner);
    }
    const bool is = confusion.body_of(0) != 0;
    confused += is ? 1 : 0;
    begun += is && !was ? 1 : 0;
    was = is;
  }
  // A tenth a second in the fleet, half of them here, less those that begin while one is under way.
  EXPECT_NEAR(begun, kTicks * kDt * 0.05, 50.0);
  EXPECT_EQ(confused, 25 * begun);
}

TEST(BodyConfusion, One_alone_is_never_confused) {
  BodyConfusion confusion({.swaps_per_h = 36'000.0, .swap_s = 0.5}, 1, dynamics::RandomStream(1, 0, 6));
  const std::vector<runtime::TruthSample> truth(1);
  for (int i = 0; i < 1000; ++i) {
    confusion.advance(truth, kDt);
    ASSERT_EQ(confusion.body_of(0), 0U);
  }
}

}  // namespace
}  // namespace vigil::sim
