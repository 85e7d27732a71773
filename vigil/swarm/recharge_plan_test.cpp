#include "vigil/swarm/recharge_plan.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "vigil/testing/allocation_guard.hpp"

namespace vigil::swarm {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::vector<RechargeTurn> planned(const std::vector<RechargeNeed>& needs, const std::vector<double>& free_at_s) {
  RechargePlanner planner(needs.size(), free_at_s.size());
  std::vector<RechargeTurn> turns(needs.size());
  planner.plan(needs, free_at_s, turns);
  return turns;
}

TEST(RechargePlan, A_drone_alone_leaves_as_late_as_it_may) {
  const auto turns = planned({{.latest_leave_s = 300.0, .way_s = 30.0, .charge_s = 600.0}}, {0.0});
  EXPECT_DOUBLE_EQ(turns[0].leave_s, 300.0);
  EXPECT_DOUBLE_EQ(turns[0].too_soon_s, 0.0);
}

TEST(RechargePlan, Of_two_that_need_one_place_at_once_one_goes_earlier_by_what_the_other_needs) {
  const RechargeNeed need{.latest_leave_s = 1000.0, .way_s = 30.0, .charge_s = 600.0};
  auto turns = planned({need, need}, {0.0});
  std::ranges::sort(turns, {}, &RechargeTurn::leave_s);
  EXPECT_DOUBLE_EQ(turns[0].leave_s, 400.0);
  EXPECT_DOUBLE_EQ(turns[1].leave_s, 1000.0);
}

TEST(RechargePlan, With_a_place_for_each_nobody_leaves_before_its_time) {
  const RechargeNeed need{.latest_leave_s = 500.0, .way_s = 30.0, .charge_s = 600.0};
  const auto turns = planned({need, need, need}, {0.0, 0.0, 0.0});
  for (const RechargeTurn& turn : turns) EXPECT_DOUBLE_EQ(turn.leave_s, 500.0);
}

TEST(RechargePlan, A_place_that_has_failed_is_given_to_nobody) {
  const RechargeNeed need{.latest_leave_s = 2000.0, .way_s = 30.0, .charge_s = 600.0};
  for (const RechargeTurn& turn : planned({need, need, need}, {0.0, kNever})) EXPECT_EQ(turn.place, 0U);
}

TEST(RechargePlan, Who_would_find_every_place_taken_is_told_by_how_much) {
  const auto turns = planned({{.latest_leave_s = 10.0, .way_s = 20.0, .charge_s = 600.0}}, {100.0, 90.0});
  EXPECT_EQ(turns[0].place, 1U);
  EXPECT_DOUBLE_EQ(turns[0].too_soon_s, 60.0);
}

/// The start of whoever begins first, where drones take places in this order, each as early as its place is free,
/// mirrored in time: as late as what comes after it allows.
double first_begin(const std::vector<RechargeNeed>& needs, const std::vector<std::size_t>& order,
                   const std::vector<std::size_t>& places) {
  std::vector<double> taken_from(3, kNever);
  double first = kNever;
  for (const std::size_t drone : order) {
    double& taken = taken_from[places[drone]];
    taken = std::min(needs[drone].latest_leave_s + needs[drone].way_s, taken - needs[drone].charge_s);
    first = std::min(first, taken);
  }
  return first;
}

double best_first_begin(const std::vector<RechargeNeed>& needs, std::size_t places) {
  double best = -kNever;
  std::vector<std::size_t> order(needs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t choices = 1;
  for (std::size_t i = 0; i < needs.size(); ++i) choices *= places;
  do {
    for (std::size_t choice = 0; choice < choices; ++choice) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0, rest = choice; i < needs.size(); ++i, rest /= places) chosen.push_back(rest % places);
      best = std::max(best, first_begin(needs, order, chosen));
    }
  } while (std::ranges::next_permutation(order).found);
  return best;
}

class RandomNeeds {
 public:
  explicit RandomNeeds(unsigned seed) : random_(seed) {}
  std::vector<RechargeNeed> draw(std::size_t count, bool charge_alike) {
    std::vector<RechargeNeed> needs;
    for (std::size_t i = 0; i < count; ++i)
      needs.push_back({.latest_leave_s = uniform(0.0, 2000.0),
                       .way_s = uniform(0.0, 60.0),
                       .charge_s = charge_alike ? 500.0 : uniform(100.0, 900.0)});
    return needs;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::mt19937_64 random_;
};

TEST(RechargePlan, Where_all_charge_alike_no_plan_lets_the_first_begin_later) {
  RandomNeeds random(5);
  for (int k = 0; k < 40; ++k) {
    const std::size_t places = 1 + static_cast<std::size_t>(k % 3);
    const auto needs = random.draw(5, true);
    const auto turns = planned(needs, std::vector<double>(places, -kNever));
    double first = kNever;
    for (std::size_t i = 0; i < needs.size(); ++i) first = std::min(first, turns[i].leave_s + needs[i].way_s);
    EXPECT_NEAR(first, best_first_begin(needs, places), 1e-9) << k;
  }
}

TEST(RechargePlan, Nobody_leaves_too_late_and_no_two_are_at_one_place) {
  RandomNeeds random(6);
  for (int k = 0; k < 200; ++k) {
    const auto needs = random.draw(30, false);
    const auto turns = planned(needs, {0.0, 0.0, 0.0, 0.0});
    for (std::size_t i = 0; i < needs.size(); ++i) {
      EXPECT_LE(turns[i].leave_s, needs[i].latest_leave_s + 1e-9);
      for (std::size_t j = 0; j < i; ++j) {
        if (turns[i].place != turns[j].place) continue;
        const double begin_i = turns[i].leave_s + needs[i].way_s;
        const double begin_j = turns[j].leave_s + needs[j].way_s;
        EXPECT_TRUE(begin_i + needs[i].charge_s <= begin_j + 1e-9 || begin_j + needs[j].charge_s <= begin_i + 1e-9);
      }
    }
  }
}

TEST(RechargePlan, Planning_allocates_nothing) {
  RandomNeeds random(7);
  const auto needs = random.draw(50, false);
  const std::vector<double> free_at_s(4, 0.0);
  RechargePlanner planner(50, 4);
  std::vector<RechargeTurn> turns(50);
  const testing::AllocationGuard guard;
  planner.plan(needs, free_at_s, turns);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace vigil::swarm
