#include "vigil/swarm/ordered_flight.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::swarm {
namespace {

constexpr double kStep = 0.02;
constexpr double kHeld = 0.7;

OrderedFlight::Rules rules() {
  FaultParameters parameters;
  parameters.bounds.held_s = kHeld;
  parameters.bounds.residual_leak_per_s = 1.0;
  return {parameters, kStep};
}

TEST(OrderedFlight, A_vehicle_without_lag_is_led_by_the_sum_of_its_orders) {
  OrderedFlight flight;
  for (int i = 0; i < 50; ++i) flight.fly(rules(), Vec2(0.5, -0.1));
  EXPECT_NEAR(flight.place().x(), 0.5, 1e-12);
  EXPECT_NEAR(flight.place().y(), -0.1, 1e-12);
}

TEST(OrderedFlight, Orders_that_never_change_explain_nothing) {
  OrderedFlight flight;
  for (int i = 0; i < 500; ++i) flight.fly(rules(), Vec2(0.5, 0.0));
  EXPECT_LT(flight.explained_m(), 0.5 * kHeld * std::exp(-8.0));
}

/// A step of the orders: whoever missed it for held_s is astray by held_s times the step, and that fades.
TEST(OrderedFlight, A_step_explains_what_a_burst_of_losses_makes_of_it_and_fades) {
  OrderedFlight flight;
  for (int i = 0; i < 500; ++i) flight.fly(rules(), Vec2(0.1, 0.0));
  double most = 0.0;
  for (int i = 0; i < 100; ++i) {
    flight.fly(rules(), Vec2(0.5, 0.0));
    most = std::max(most, flight.explained_m());
  }
  EXPECT_GE(most, 0.4 * kHeld - 1e-9);
  EXPECT_LE(most, 0.4 * (1.2 * kHeld + 2.0 * kStep));
  const double before = flight.explained_m();
  for (int i = 0; i < 50; ++i) flight.fly(rules(), Vec2(0.5, 0.0));
  EXPECT_NEAR(flight.explained_m(), before * std::exp(-1.0), 1e-9);
}

/// Equation [4] as it stands, for every order of the last held_s, against the eight that stand for them.
TEST(OrderedFlight, Whatever_a_burst_of_losses_makes_of_orders_at_random_is_explained) {
  dynamics::RandomStream random(5, 1, 1);
  OrderedFlight flight;
  std::deque<Vec2> orders;
  Vec2 push = Vec2::Zero();
  Vec2 u = Vec2::Zero();
  const auto held_ticks = static_cast<std::size_t>(kHeld / kStep);
  for (int i = 0; i < 5000; ++i) {
    push = 0.9 * push + random.normal(0.1);
    u = 0.98 * u + kStep * push;  // the filter's orders turn, and do not jump about
    flight.fly(rules(), u);
    orders.push_front(u);
    if (orders.size() > held_ticks) orders.pop_back();
    Vec2 since = Vec2::Zero();
    double astray_m = 0.0;
    for (std::size_t back = 0; back < orders.size(); ++back) {
      astray_m = std::max(astray_m, (since - static_cast<double>(back) * kStep * orders[back]).norm());
      since += kStep * orders[back];
    }
    ASSERT_GE(flight.explained_m(), 0.8 * astray_m) << i;
  }
}

TEST(OrderedFlight, A_vehicle_at_its_limits_is_given_what_gusts_make_of_it_there_and_none_else_is) {
  FaultParameters parameters;
  parameters.loop = dynamics::arducopter_vehicle().horizontal;
  parameters.bounds.drift_m_s = 0.5;
  const OrderedFlight::Rules limited(parameters, kStep);
  OrderedFlight flight;
  for (int i = 0; i < 1000; ++i) flight.fly(limited, Vec2(0.5, 0.0));
  EXPECT_LT(flight.explained_m(), 0.05);
  for (int i = 0; i < 100; ++i) flight.fly(limited, Vec2(-5.0, 0.0));
  const double at_limits = flight.explained_m();
  parameters.bounds.drift_m_s = 0.0;
  const OrderedFlight::Rules calm(parameters, kStep);
  OrderedFlight in_calm;
  for (int i = 0; i < 1000; ++i) in_calm.fly(calm, Vec2(0.5, 0.0));
  for (int i = 0; i < 100; ++i) in_calm.fly(calm, Vec2(-5.0, 0.0));
  EXPECT_GT(at_limits, in_calm.explained_m() + 0.5);
}

TEST(OrderedFlight, A_restart_goes_on_from_the_velocity_and_explains_what_is_not_known_of_the_vehicle) {
  FaultParameters parameters;
  parameters.loop = dynamics::first_order_lag_vehicle(0.3).horizontal;
  const OrderedFlight::Rules lagging(parameters, kStep);
  OrderedFlight flight;
  flight.fly(lagging, Vec2(0.5, 0.0));
  flight.restart(lagging, Vec2(0.4, 0.3));
  EXPECT_EQ(flight.place(), Vec2(0.0, 0.0));
  EXPECT_EQ(flight.velocity(), Vec2(0.4, 0.3));
  EXPECT_NEAR(flight.explained_m(), 2.0 * 0.3 * 0.5, 1e-12);
}

}  // namespace
}  // namespace vigil::swarm
