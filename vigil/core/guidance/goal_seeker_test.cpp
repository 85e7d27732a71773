#include "vigil/core/guidance/goal_seeker.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "vigil/core/safety/filter.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::guidance {
namespace {

constexpr double kDt = 0.02;
constexpr double kSpeed = 0.5;
constexpr double kSpacing = 0.25;

safety::BarrierParameters barrier() {
  safety::BarrierParameters parameters;
  parameters.separation_m = kSpacing;
  parameters.contact_distance_m = 0.5 * kSpacing;
  parameters.wall_distance_m = 0.1;
  parameters.u_max_m_s = kSpeed;
  parameters.dt_s = kDt;
  return parameters;
}

/// Ideal drones under the safety filter.
class Room {
 public:
  explicit Room(std::vector<Vec2> starts, std::vector<Vec2> goals)
      : seeker({.u_max_m_s = kSpeed, .spacing_m = kSpacing, .lag_s = 0.0, .dt_s = kDt}, starts.size()),
        filter_(barrier(), {6.0, 6.0}, starts.size()),
        travellers(starts.size()),
        bodies_(starts.size()),
        wishes(starts.size()),
        u_(starts.size()),
        reports_(starts.size()) {
    for (std::size_t i = 0; i < starts.size(); ++i)
      travellers[i] = {.drone = i, .position = starts[i], .goal = goals[i]};
  }

  void fly(double seconds) {
    for (int k = 0; k < static_cast<int>(seconds / kDt); ++k) tick();
  }

  void tick() {
    seeker.steer(travellers, wishes);
    if (is_plain)
      for (std::size_t i = 0; i < wishes.size(); ++i) wishes[i] = plain_wish(travellers[i]);
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].position = travellers[i].position;
    filter_.run(bodies_, {}, wishes, u_, reports_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      travellers[i].position += kDt * u_[i];
      travellers[i].velocity = u_[i];
      travellers[i].flown = u_[i];
    }
  }

  [[nodiscard]] bool all_arrived() const {
    return std::all_of(travellers.begin(), travellers.end(), [&](const Traveller& traveller) {
      return (traveller.goal - traveller.position).norm() < seeker.arrival_distance_m();
    });
  }

  GoalSeeker seeker;
  bool is_plain = false;  ///< straight to the goal, without any remedy

 private:
  static Vec2 plain_wish(const Traveller& traveller) {
    const Vec2 way = traveller.goal - traveller.position;
    return std::min(2.0, kSpeed / std::max(way.norm(), 1e-12)) * way;
  }

  safety::Filter filter_;

 public:
  std::vector<Traveller> travellers;

 private:
  std::vector<safety::Body> bodies_;

 public:
  std::vector<Vec2> wishes;

 private:
  std::vector<Vec2> u_;
  std::vector<safety::FilterReport> reports_;
};

Room circle_swap(std::size_t drones) {
  std::vector<Vec2> starts;
  std::vector<Vec2> goals;
  for (std::size_t i = 0; i < drones; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(drones);
    const Vec2 out(std::cos(angle), std::sin(angle));
    starts.emplace_back(Vec2(3.0, 3.0) + 1.5 * out);
    goals.emplace_back(Vec2(3.0, 3.0) - 1.5 * out);
  }
  return Room(starts, goals);
}

TEST(GoalSeeker, A_drone_that_is_alone_flies_straight_to_its_goal_and_stays) {
  Room room({Vec2(1.0, 1.0)}, {Vec2(4.0, 5.0)});
  room.fly(5.0);
  const Vec2 way = Vec2(4.0, 5.0) - room.travellers[0].position;
  EXPECT_NEAR(way.x() * 4.0, way.y() * 3.0, 1e-9);
  EXPECT_NEAR(5.0 - way.norm(), 2.5, 0.02);
  room.fly(15.0);
  EXPECT_LT((room.travellers[0].position - Vec2(4.0, 5.0)).norm(), 1e-6);
}

TEST(GoalSeeker, Two_that_meet_head_on_pass_each_other_where_without_remedies_they_freeze) {
  for (const bool is_plain : {true, false}) {
    Room room({Vec2(1.0, 3.0), Vec2(5.0, 3.0)}, {Vec2(5.0, 3.0), Vec2(1.0, 3.0)});
    room.is_plain = is_plain;
    room.fly(30.0);
    EXPECT_EQ(room.all_arrived(), !is_plain);
  }
}

TEST(GoalSeeker, They_pass_on_the_right) {
  Room room({Vec2(1.0, 3.0), Vec2(5.0, 3.0)}, {Vec2(5.0, 3.0), Vec2(1.0, 3.0)});
  double lowest = 3.0;
  for (int k = 0; k < 1000; ++k) {
    room.tick();
    lowest = std::min(lowest, room.travellers[0].position.y());
    EXPECT_LE(room.travellers[0].position.y(), 3.0 + 0.1);  // it never goes to its left
  }
  EXPECT_LT(lowest, 2.95);
}

TEST(GoalSeeker, Drones_on_a_circle_change_places) {
  for (const std::size_t drones : {2U, 4U, 8U, 16U}) {
    Room room = circle_swap(drones);
    room.fly(60.0);
    EXPECT_TRUE(room.all_arrived()) << drones;
  }
}

TEST(GoalSeeker, Who_waits_at_a_goal_makes_room_and_comes_back) {
  // A gap too narrow for a third one, closed by two that wait, across the only way between wall and wall.
  std::vector<Vec2> starts{Vec2(3.0, 1.0)};
  std::vector<Vec2> goals{Vec2(3.0, 5.0)};
  for (int i = 0; i < 13; ++i) {
    starts.emplace_back(0.3 + 0.45 * i, 3.0);
    goals.push_back(starts.back());
  }
  Room room(starts, goals);
  room.fly(40.0);
  EXPECT_TRUE(room.all_arrived());
  Room plain(starts, goals);
  plain.is_plain = true;
  plain.fly(40.0);
  EXPECT_FALSE(plain.all_arrived());
}

TEST(GoalSeeker, Wishes_are_finite_and_no_faster_than_allowed) {
  Room room = circle_swap(16);
  room.travellers[3].position = room.travellers[3].goal;
  for (int k = 0; k < 2000; ++k) {
    room.tick();
    for (const Vec2& wish : room.wishes) ASSERT_LE(wish.norm(), kSpeed * (1.0 + 1e-12));
  }
}

TEST(GoalSeeker, A_copy_goes_on_like_its_original) {
  Room room = circle_swap(8);
  room.fly(3.0);
  Room copy = room;
  room.fly(5.0);
  copy.fly(5.0);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(room.travellers[i].position, copy.travellers[i].position);
}

TEST(GoalSeeker, A_tick_allocates_nothing) {
  Room room = circle_swap(8);
  const testing::AllocationGuard guard;
  room.seeker.steer(room.travellers, room.wishes);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::guidance
