#include "vigil/adapters/ros/mistaken_bodies.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace vigil::ros_bridge {
namespace {

constexpr double kAMomentAgo = 0.02;

/// Drones in the air that are seen where they are expected.
std::vector<NamedBody> seen_at(const std::vector<Point>& places) {
  std::vector<NamedBody> bodies;
  for (const Point& place : places)
    bodies.push_back({.is_known = true,
                      .is_timely = true,
                      .is_airborne = true,
                      .unseen_s = kAMomentAgo,
                      .expected = place,
                      .seen = place});
  return bodies;
}

std::optional<std::size_t> judged(const std::vector<NamedBody>& bodies, std::size_t drone) {
  MistakenBodies mistaken(bodies.size());
  mistaken.judge(bodies);
  return mistaken.taken_for(drone);
}

TEST(MistakenBodies, Drones_that_are_seen_where_they_are_expected_have_their_names) {
  const auto bodies = seen_at({{0.0, 0.0, 0.5}, {0.1, 0.0, 0.5}});
  EXPECT_EQ(judged(bodies, 0), std::nullopt);
  EXPECT_EQ(judged(bodies, 1), std::nullopt);
}

TEST(MistakenBodies, Two_that_are_each_nearer_to_the_other_s_place_have_swapped_names_however_far_apart) {
  for (const double apart_m : {0.1, 0.3, 1.0, 20.0}) {
    auto bodies = seen_at({{0.0, 0.0, 0.5}, {apart_m, 0.0, 0.5}});
    std::swap(bodies[0].seen, bodies[1].seen);
    for (NamedBody& body : bodies) body.unseen_s = 2.0;  // long lost, or not
    EXPECT_EQ(judged(bodies, 0), 1U);
    EXPECT_EQ(judged(bodies, 1), 0U);
  }
}

TEST(MistakenBodies, A_body_in_the_place_where_another_was_a_moment_ago_is_the_other_s) {
  auto bodies = seen_at({{0.0, 0.0, 0.5}, {0.3, 0.0, 0.5}});
  bodies[0].seen = {0.31, 0.0, 0.5};
  EXPECT_EQ(judged(bodies, 0), 1U);
  EXPECT_EQ(judged(bodies, 1), std::nullopt);
  bodies[1].unseen_s = 0.3;  // it may have left meanwhile,
  bodies[0].unseen_s = 0.1;  // and this one have come
  EXPECT_EQ(judged(bodies, 0), std::nullopt);
  bodies[0].unseen_s = kAMomentAgo;  // but not in such a moment
  EXPECT_EQ(judged(bodies, 0), 1U);
}

TEST(MistakenBodies, Three_that_go_round_are_all_told) {
  const Point a{0.0, 0.0, 0.5};
  const Point b{0.2, 0.0, 0.5};
  const Point c{0.1, 0.18, 0.5};
  auto bodies = seen_at({a, b, c});
  bodies[0].seen = b;
  bodies[1].seen = c;
  bodies[2].seen = a;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(judged(bodies, i), (i + 1) % 3);
}

TEST(MistakenBodies, Who_was_mistaken_remains_so_until_it_is_seen_in_its_own_place) {
  auto bodies = seen_at({{0.0, 0.0, 0.5}, {0.3, 0.0, 0.5}});
  const auto right = bodies;
  MistakenBodies mistaken(2);
  bodies[0].seen = bodies[1].expected;
  mistaken.judge(bodies);
  ASSERT_EQ(mistaken.taken_for(0), 1U);
  bodies[1].unseen_s = 3.0;  // the other one has no name any more
  mistaken.judge(bodies);
  EXPECT_EQ(mistaken.taken_for(0), 1U);
  bodies[0].is_timely = false;
  bodies[0].seen = right[0].seen;  // what comes late says nothing
  mistaken.judge(bodies);
  EXPECT_EQ(mistaken.taken_for(0), 1U);
  mistaken.judge(right);
  EXPECT_EQ(mistaken.taken_for(0), std::nullopt);
}

TEST(MistakenBodies, Drones_on_the_ground_that_nobody_saw_for_a_moment_may_have_been_carried) {
  auto bodies = seen_at({{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}});
  std::swap(bodies[0].seen, bodies[1].seen);
  for (NamedBody& body : bodies) body.is_airborne = false;
  bodies[0].unseen_s = 0.2;
  EXPECT_EQ(judged(bodies, 0), std::nullopt);
  bodies[1].is_airborne = true;
  EXPECT_EQ(judged(bodies, 0), 1U);
}

TEST(MistakenBodies, Drones_on_the_ground_that_change_places_at_once_have_swapped_names_until_they_change_back) {
  auto bodies = seen_at({{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}});
  for (NamedBody& body : bodies) body.is_airborne = false;
  MistakenBodies mistaken(2);
  std::swap(bodies[0].seen, bodies[1].seen);
  for (const double unseen_s : {0.02, 0.5, 60.0}) {
    for (NamedBody& body : bodies) body.unseen_s = unseen_s;
    mistaken.judge(bodies);
    EXPECT_EQ(mistaken.taken_for(0), 1U);
    EXPECT_EQ(mistaken.taken_for(1), 0U);
  }
  std::swap(bodies[0].seen, bodies[1].seen);
  mistaken.judge(bodies);
  EXPECT_EQ(mistaken.taken_for(0), std::nullopt);
  EXPECT_EQ(mistaken.taken_for(1), std::nullopt);
}

TEST(MistakenBodies, One_on_the_ground_that_is_put_where_another_stood_is_carried) {
  auto bodies = seen_at({{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}});
  for (NamedBody& body : bodies) body.is_airborne = false;
  bodies[0].seen = {0.3, 0.0, 0.0};
  EXPECT_EQ(judged(bodies, 0), std::nullopt);
}

TEST(MistakenBodies, What_was_never_seen_is_mistaken_for_nobody) {
  auto bodies = seen_at({{0.0, 0.0, 0.5}, {0.3, 0.0, 0.5}});
  std::swap(bodies[0].seen, bodies[1].seen);
  bodies[0].is_known = false;
  EXPECT_EQ(judged(bodies, 0), std::nullopt);
  EXPECT_EQ(judged(bodies, 1), std::nullopt);
}

}  // namespace
}  // namespace vigil::ros_bridge
