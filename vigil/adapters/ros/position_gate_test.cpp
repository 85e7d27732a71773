#include "vigil/adapters/ros/position_gate.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace vigil::ros_bridge {
namespace {

using Verdict = PositionGate::Verdict;

/// A tracker that sends a hundred positions a second.
class Tracker {
 public:
  Sighting at(const Point& place, double late_s = 0.0) {
    now_s_ += 0.01;
    return {place, now_s_ - late_s, now_s_, ++number_};
  }
  /// The same place, but for what no tracker sees twice.
  Sighting near(Point place) {
    place.x += 1e-5 * static_cast<double>(number_ % 7);
    return at(place);
  }
  [[nodiscard]] double now_s() const { return now_s_; }

 private:
  double now_s_ = 1000.0;
  std::uint64_t number_ = 0;
};

const GateParameters kParameters{.reach_m_s = 1.0};

TEST(PositionGate, A_drone_that_flies_is_followed_with_its_velocity) {
  PositionGate gate(kParameters);
  Tracker tracker;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(gate.look(tracker.at({0.003 * i, 0.0, 0.5}), true), Verdict::kBelieved);
  EXPECT_NEAR(gate.velocity().x, 0.3, 1e-3);
  EXPECT_NEAR(gate.place().x, 0.297, 1e-12);
  EXPECT_NEAR(gate.age_s(tracker.now_s() + 0.02), 0.02, 1e-9);
}

TEST(PositionGate, Nothing_is_known_before_the_first_position) {
  const PositionGate gate(kParameters);
  EXPECT_FALSE(gate.has_seen());
  EXPECT_EQ(gate.age_s(5.0), swarm::DroneObservation::kNever);
}

TEST(PositionGate, A_jump_in_the_air_is_not_believed_however_long_it_lasts) {
  PositionGate gate(kParameters);
  Tracker tracker;
  gate.look(tracker.near({0.0, 0.0, 0.5}), true);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(gate.look(tracker.near({1.5, 0.0, 0.5}), true), Verdict::kJumped);
  EXPECT_EQ(gate.place().x, 0.0);
  EXPECT_GT(gate.age_s(tracker.now_s()), 9.9);
}

TEST(PositionGate, After_a_jump_the_old_place_is_believed_again_at_once) {
  PositionGate gate(kParameters);
  Tracker tracker;
  gate.look(tracker.near({0.0, 0.0, 0.5}), true);
  for (int i = 0; i < 100; ++i) gate.look(tracker.near({2.0, 0.0, 0.5}), true);
  EXPECT_EQ(gate.look(tracker.near({0.05, 0.0, 0.5}), true), Verdict::kBelieved);
}

TEST(PositionGate, Nine_tenths_of_what_a_drone_can_have_flown_are_believed_and_eleven_tenths_are_not) {
  for (const double share : {0.9, 1.1}) {
    PositionGate gate(kParameters);
    Tracker tracker;
    gate.look(tracker.near({0.0, 0.0, 0.5}), true);
    for (int i = 0; i < 49; ++i) gate.look(tracker.near({9.0, 0.0, 0.5}), true);
    const double reach_m = kParameters.slack_m + kParameters.reach_m_s * 0.5;
    EXPECT_EQ(gate.look(tracker.at({share * reach_m, 0.0, 0.5}), true),
              share < 1.0 ? Verdict::kBelieved : Verdict::kJumped);
  }
}

TEST(PositionGate, A_drone_that_is_carried_over_the_ground_is_believed_once_it_lies_still) {
  PositionGate gate(kParameters);
  Tracker tracker;
  gate.look(tracker.near({0.0, 0.0, 0.0}), false);
  int looks = 1;
  while (gate.look(tracker.near({2.0, 1.0, 0.0}), false) == Verdict::kJumped) ++looks;
  EXPECT_NEAR(0.01 * looks, kParameters.settled_s, 0.03);
  EXPECT_NEAR(gate.place().x, 2.0, 1e-3);
}

TEST(PositionGate, The_same_bits_again_and_again_are_no_news) {
  PositionGate gate(kParameters);
  Tracker tracker;
  for (int i = 0; i < 100; ++i) gate.look(tracker.at({0.1, 0.2, 0.5}), true);
  EXPECT_NEAR(gate.age_s(tracker.now_s()), 0.99 - kParameters.frozen_s, 0.02);
  EXPECT_EQ(gate.look(tracker.at({0.1, 0.2, 0.5}), true), Verdict::kFrozen);
  EXPECT_EQ(gate.look(tracker.at({0.1, 0.2001, 0.5}), true), Verdict::kBelieved);
}

TEST(PositionGate, Positions_that_come_late_are_not_used) {
  PositionGate gate(kParameters);
  Tracker tracker;
  gate.look(tracker.near({0.0, 0.0, 0.5}), true);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(gate.look(tracker.at({1e-3 * i, 0.0, 0.5}, 0.3), true), Verdict::kLate);
  EXPECT_NEAR(gate.age_s(tracker.now_s()), 1.0, 1e-6);
  EXPECT_EQ(gate.look(tracker.near({0.0, 0.0, 0.5}), true), Verdict::kBelieved);
}

TEST(PositionGate, A_position_is_as_old_as_its_stamp) {
  PositionGate gate(kParameters);
  Tracker tracker;
  gate.look(tracker.at({0.0, 0.0, 0.5}, 0.04), true);
  EXPECT_NEAR(gate.age_s(tracker.now_s()), 0.04, 1e-9);
}

TEST(PositionGate, A_stamp_from_the_future_counts_as_now) {
  for (const double ahead_s : {0.01, 5.0, 1e6}) {
    PositionGate gate(kParameters);
    Tracker tracker;
    EXPECT_EQ(gate.look(tracker.at({0.0, 0.0, 0.5}, -ahead_s), true), Verdict::kBelieved);
    EXPECT_NEAR(gate.age_s(tracker.now_s()), 0.0, 1e-9);
  }
}

TEST(PositionGate, A_stamp_far_behind_is_late_and_no_sign_of_another_clock) {
  for (const double behind_s : {9.0, 11.0, 60.0, 1e6}) {
    PositionGate gate(kParameters);
    Tracker tracker;
    EXPECT_EQ(gate.look(tracker.at({0.0, 0.0, 0.5}, behind_s), true), Verdict::kLate);
    EXPECT_FALSE(gate.has_seen());
  }
}

TEST(PositionGate, A_wall_clock_that_is_set_back_leaves_positions_fresh_and_followed) {
  PositionGate gate(kParameters);
  double wall_s = 1.7e9;
  for (std::uint64_t i = 1; i <= 400; ++i) {
    const double steady_s = 50.0 + 0.01 * static_cast<double>(i);
    wall_s += i == 200 ? -20.0 : 0.01;
    const Point place{0.002 * static_cast<double>(i), 0.0, 0.5};
    const Sighting sighting{place, measured_at(steady_s, wall_s, wall_s - 0.004), steady_s, i};
    EXPECT_EQ(gate.look(sighting, true), Verdict::kBelieved);
    EXPECT_EQ(gate.place().x, place.x);
    EXPECT_NEAR(gate.age_s(steady_s), 0.004, 1e-6);
  }
  EXPECT_NEAR(gate.velocity().x, 0.2, 1e-3);
}

TEST(PositionGate, What_is_older_than_what_is_known_is_told_apart_and_ages_go_on) {
  PositionGate gate(kParameters);
  EXPECT_EQ(gate.look({{0.0, 0.0, 0.5}, 10.0, 10.0, 1}, true), Verdict::kBelieved);
  EXPECT_EQ(gate.look({{0.01, 0.0, 0.5}, 9.95, 10.01, 2}, true), Verdict::kOlder);
  EXPECT_EQ(gate.place().x, 0.0);
  EXPECT_NEAR(gate.age_s(10.01), 0.01, 1e-9);
  EXPECT_EQ(gate.look({{0.02, 0.0, 0.5}, 10.02, 10.02, 3}, true), Verdict::kBelieved);
}

TEST(PositionGate, What_is_not_a_number_is_not_believed) {
  PositionGate gate(kParameters);
  Tracker tracker;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gate.look(tracker.at({nan, 0.0, 0.0}), true), Verdict::kNotANumber);
  EXPECT_FALSE(gate.has_seen());
}

}  // namespace
}  // namespace vigil::ros_bridge
