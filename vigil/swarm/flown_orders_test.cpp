#include "vigil/swarm/flown_orders.hpp"

#include <array>
#include <random>

#include <gtest/gtest.h>

namespace vigil::swarm {
namespace {

constexpr double kDt = 0.02;

/// A drone that flies by v' = (u - v)/lag in steps of half a tick, and orders that arrive late.
struct LateFlight {
  double lag_s = 0.3;
  std::size_t delay_half_ticks = 0;
  std::vector<Motion> past{Motion{}};  ///< one per half tick
  std::vector<Vec2> ordered{};         ///< one per tick

  void order(const Vec2& u) {
    ordered.push_back(u);
    for (std::size_t half = 2 * ordered.size() - 2; half < 2 * ordered.size(); ++half) {
      const bool none_yet = half < delay_half_ticks;
      const Vec2 acting = none_yet ? Vec2(Vec2::Zero()) : ordered[(half - delay_half_ticks) / 2];
      const double fade = std::exp(-0.5 * kDt / lag_s);
      const Motion& last = past.back();
      past.push_back({last.position + 0.5 * kDt * acting + lag_s * (1.0 - fade) * (last.velocity - acting),
                      acting + fade * (last.velocity - acting)});
    }
  }
};

TEST(FlownOrders, A_drone_is_predicted_to_where_it_is_when_the_next_order_begins_to_act) {
  for (const std::size_t delay : {0U, 1U, 4U, 9U}) {   // half ticks
    for (const std::size_t age : {0U, 1U, 6U, 11U}) {  // half ticks
      LateFlight flight{.lag_s = 0.3, .delay_half_ticks = delay};
      FlownOrders orders(2, kDt, 0.5);
      std::mt19937_64 random(7);
      std::uniform_real_distribution<double> share(-1.0, 1.0);
      for (int k = 0; k < 100; ++k) {
        const Vec2 u(share(random), share(random));
        flight.order(u);
        orders.remember(std::array{Vec2(9.0, 9.0), u});
      }
      const std::size_t now = flight.past.size() - 1;
      const Motion seen = flight.past[now - age];
      const double span_s = 0.5 * kDt * static_cast<double>(age + delay);
      const Motion predicted = orders.ahead(1, seen, span_s, 0.3);
      for (std::size_t half = 0; half < delay; half += 2) flight.order(Vec2::Zero());  // none of these acts until then
      const Motion& then = flight.past[now + delay];
      EXPECT_LT((predicted.position - then.position).norm(), 1e-12) << delay << " " << age;
      EXPECT_LT((predicted.velocity - then.velocity).norm(), 1e-12) << delay << " " << age;
    }
  }
}

TEST(FlownOrders, Without_delay_and_age_nothing_is_changed) {
  FlownOrders orders(1, kDt, 0.5);
  orders.remember(std::array{Vec2(0.3, 0.0)});
  const Motion seen{Vec2(1.0, 2.0), Vec2(0.1, 0.0)};
  EXPECT_EQ(orders.ahead(0, seen, 0.0, 0.3).position, seen.position);
  EXPECT_EQ(orders.ahead(0, seen, 0.0, 0.3).velocity, seen.velocity);
}

TEST(FlownOrders, What_is_older_than_the_memory_is_left_out) {
  FlownOrders orders(1, kDt, 0.1);
  for (int k = 0; k < 100; ++k) orders.remember(std::array{Vec2(1.0, 0.0)});
  const double way = orders.ahead(0, Motion{}, 100.0, 0.0).position.x();
  EXPECT_GE(way, 0.1 - 1e-12);
  EXPECT_LE(way, 0.1 + 2.0 * kDt);
}

}  // namespace
}  // namespace vigil::swarm
