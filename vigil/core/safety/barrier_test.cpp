#include "vigil/core/safety/barrier.hpp"

#include <random>

#include <gtest/gtest.h>

#include "vigil/core/safety/parameters_for_tests.hpp"

namespace vigil::safety {
namespace {

/// With margins for noise.
BarrierParameters cautious() {
  BarrierParameters parameters = lag_aware();
  parameters.margin_m = 0.02;
  parameters.pair_margin_m = 0.03;
  return parameters;
}

Body at(double x, double y) {
  Body body;
  body.position = Vec2(x, y);
  return body;
}

Body stranger(double speed) {
  Body body;
  body.is_controlled = false;
  body.uncooperative_speed_m_s = speed;
  return body;
}

PairBarrier of_drones(const BarrierParameters& parameters) { return separation_barrier(parameters, Body{}, Body{}); }

std::optional<HalfPlane> row_at(const BarrierParameters& parameters, const PairBarrier& barrier, double distance) {
  return pair_row(parameters, barrier, Vec2(distance, 0.0), Vec2::Zero(), 0, 1, Priority::kSeparation);
}

TEST(Barrier, The_papers_pair_row_is_equation_10) {
  const BarrierParameters parameters = paper();
  const double d = 0.3;
  const double h = d * d - 0.04;
  const auto row = row_at(parameters, of_drones(parameters), d);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->normal, Vec2(1.0, 0.0));
  EXPECT_NEAR(2.0 * d * row->offset, -10.0 * h * h * h, 1e-15);
}

TEST(Barrier, The_papers_wall_row_is_equation_11) {
  const BarrierParameters parameters = paper();
  const field::Field field{3.0, 3.0};
  const double d = 0.3;
  const double h = d * d - 0.17 * 0.17;
  const auto row =
      wall_row(parameters, field, Vec2(1.5, 3.0 - d), 3, wall_reserve(parameters, Body{}), Priority::kWall);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->normal, Vec2(0.0, -1.0));
  EXPECT_NEAR(2.0 * d * row->offset, -10.0 * h * h * h, 1e-14);
}

TEST(Barrier, The_lag_aware_rows_are_linear_in_h) {
  const BarrierParameters parameters = cautious();
  EXPECT_NEAR(barrier_radius(parameters), std::hypot(0.23, std::sqrt(5.0) * 0.3 * 0.02), 1e-15);
  Body body = at(1.0, 1.0);
  body.velocity = Vec2(0.1, -0.2);
  EXPECT_LT((barrier_point(parameters, body) - Vec2(1.03, 0.94)).norm(), 1e-15);
  const double d = 0.26;
  const double h = d * d - std::pow(barrier_radius(parameters), 2);
  const auto row = row_at(parameters, of_drones(parameters), d);
  ASSERT_TRUE(row);
  EXPECT_NEAR(2.0 * d * row->offset, -5.0 * h, 1e-15);
  const auto wall =
      wall_row(parameters, {3.0, 3.0}, Vec2(0.2, 1.5), 0, wall_reserve(parameters, Body{}), Priority::kWall);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->offset, -5.0 * (0.2 - 0.17 - 0.02), 1e-15);
}

/// Two drones with v' = (u - v)/lag, by their differences.
struct LaggingPair {
  Vec2 p;
  Vec2 v;
  [[nodiscard]] LaggingPair after(double time, double lag, const Vec2& u) const {
    const double fade = std::exp(-time / lag);
    return {p + time * u + lag * (1.0 - fade) * (v - u), u + fade * (v - u)};
  }
  [[nodiscard]] double h(double lag, double radius) const {
    return p.squaredNorm() + 2.0 * lag * p.dot(v) - radius * radius;
  }
};

TEST(Barrier, A_pair_whose_rows_hold_keeps_h_at_the_next_sample_and_its_distance_in_between) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int near = 0;
  for (int i = 0; i < 200000; ++i) {
    BarrierParameters parameters = cautious();
    parameters.dt_s = i % 2 == 0 ? 0.02 : 0.2;
    parameters.pair_gain = i % 3 == 0 ? 5.0 : 1e9;
    const PairBarrier barrier = of_drones(parameters);
    const LaggingPair pair{0.5 * Vec2(share(random), share(random)), 0.4 * Vec2(share(random), share(random))};
    const double h = pair.h(barrier.lag_s, barrier.radius_m);
    if (h < 0.0) continue;
    const Vec2 z = pair.p + barrier.lag_s * pair.v;
    const auto own = pair_row(parameters, barrier, z, pair.v, 0, 1, Priority::kMargin);
    const auto other = pair_row(parameters, barrier, -z, -pair.v, 1, 0, Priority::kMargin);
    if (!own || !other) continue;
    ++near;
    EXPECT_LE(own->offset, 0.0);  // standing still is allowed
    // Both at the least that their rows allow, and as fast as they like along them.
    const Vec2 along(-own->normal.y(), own->normal.x());
    const Vec2 u = own->offset * own->normal - other->offset * other->normal + 0.6 * share(random) * along;
    const double used = 2.0 * std::min(parameters.pair_gain * h, h / (2.0 * parameters.dt_s)) * parameters.dt_s;
    EXPECT_GE(pair.after(parameters.dt_s, barrier.lag_s, u).h(barrier.lag_s, barrier.radius_m), h - used - 1e-12);
    if (u.norm() > 2.0 * parameters.u_max_m_s) continue;
    for (int part = 1; part < 8; ++part) {
      const LaggingPair then = pair.after(part * parameters.dt_s / 8.0, barrier.lag_s, u);
      EXPECT_GE(then.h(barrier.lag_s, 0.23), -1e-12);
    }
  }
  EXPECT_GT(near, 10000);
}

TEST(Barrier, However_large_the_gain_a_tick_uses_up_no_more_than_h) {
  for (const BarrierParameters& given : {paper(), cautious()}) {
    BarrierParameters parameters = given;
    parameters.pair_gain = 1e12;
    parameters.wall_gain = 1e12;
    const PairBarrier barrier = of_drones(parameters);
    const double d = barrier.radius_m + 0.001;
    const auto row = row_at(parameters, barrier, d);
    ASSERT_TRUE(row);
    const double h = d * d - barrier.radius_m * barrier.radius_m;
    EXPECT_NEAR(2.0 * d * row->offset, -h / (2.0 * parameters.dt_s), 1e-12);
    const auto wall =
        wall_row(parameters, {3.0, 3.0}, Vec2(0.171, 1.5), 0, wall_reserve(parameters, Body{}), Priority::kWall);
    ASSERT_TRUE(wall);
    EXPECT_GE(wall->offset * parameters.dt_s, -0.001 - 1e-15);
  }
}

TEST(Barrier, The_papers_numbers_give_a_sensing_range_of_61_centimetres) {
  EXPECT_NEAR(derived_sensing_range(paper()), 0.61, 0.005);
  EXPECT_NEAR(least_sensing_range(paper()), 0.2 + 2.0 * 0.3 * 0.02, 1e-15);
}

TEST(Barrier, Just_inside_the_derived_range_a_pair_has_a_row_and_just_outside_none) {
  for (const double speed : {-1.0, 0.0, 0.1, 0.3}) {  // -1: another controlled drone
    for (const BarrierParameters& parameters : {paper(), cautious()}) {
      const Body other = speed < 0.0 ? Body{} : stranger(speed);
      const PairBarrier barrier = separation_barrier(parameters, Body{}, other);
      const double reach = pair_reach(parameters, barrier);
      EXPECT_FALSE(row_at(parameters, barrier, reach * (1.0 + 1e-9)));
      if (barrier.lag_s > 0.0) continue;  // there it depends on the velocities: below
      EXPECT_TRUE(row_at(parameters, barrier, reach * (1.0 - 1e-9)));
      EXPECT_NEAR(row_at(parameters, barrier, reach * (1.0 - 1e-9))->offset, -parameters.u_max_m_s, 1e-6);
    }
  }
}

TEST(Barrier, Beyond_the_derived_range_no_velocities_make_a_row_of_lagging_drones_bind) {
  const BarrierParameters parameters = cautious();
  const PairBarrier barrier = of_drones(parameters);
  const double reach = pair_reach(parameters, barrier);
  double farthest = 0.0;
  for (int i = 0; i < 360; ++i) {
    for (const double speed : {0.2, 0.4, 0.6}) {
      const Vec2 v_ij = speed * Vec2(std::cos(i * M_PI / 180.0), std::sin(i * M_PI / 180.0));
      for (double d = 0.2; d < 2.0 * reach; d += 0.002)
        if (pair_row(parameters, barrier, Vec2(d, 0.0), v_ij, 0, 1, Priority::kMargin))
          farthest = std::max(farthest, d);
    }
  }
  EXPECT_LE(farthest, reach);
  EXPECT_GE(farthest, 0.7 * reach);  // and it is not far too long
}

TEST(Barrier, An_uncooperative_body_puts_its_whole_speed_on_this_side) {
  BarrierParameters parameters = paper();
  const PairBarrier calm = separation_barrier(parameters, Body{}, stranger(0.0));
  const PairBarrier wayward = separation_barrier(parameters, Body{}, stranger(0.25));
  for (const double d : {0.2, 0.21, 0.25, 0.3, 0.4})
    EXPECT_NEAR(row_at(parameters, wayward, d)->offset - row_at(parameters, calm, d)->offset, 0.25, 1e-15);
}

TEST(Barrier, Old_states_are_kept_away_from_by_as_much_as_they_may_have_moved) {
  for (const BarrierParameters& parameters : {paper(), cautious()}) {
    Body own;
    Body other;
    own.age_s = 0.1;
    other.age_s = 0.2;
    EXPECT_NEAR(separation_barrier(parameters, own, other).radius_m, barrier_radius(parameters) + 0.3 * 0.3, 1e-15);
  }
}

TEST(Barrier, Where_h_is_negative_the_row_asks_to_leave_at_a_linear_rate_of_at_most_half_the_speed) {
  for (const BarrierParameters& parameters : {paper(), cautious()}) {
    const PairBarrier barrier = of_drones(parameters);
    EXPECT_NEAR(row_at(parameters, barrier, barrier.radius_m - 0.01)->offset, 0.05, 1e-12);
    EXPECT_NEAR(row_at(parameters, barrier, 0.01)->offset, 0.15, 1e-15);
    const double wall = parameters.wall_distance_m + (parameters.kind == BarrierKind::kPaper ? 0.0 : 0.02);
    EXPECT_NEAR(
        wall_row(parameters, {3.0, 3.0}, Vec2(wall - 0.01, 1.0), 0, wall_reserve(parameters, Body{}), Priority::kWall)
            ->offset,
        0.05, 1e-12);
  }
}

TEST(Barrier, Rows_are_continuous_where_h_changes_its_sign) {
  for (const BarrierParameters& parameters : {paper(), cautious()}) {
    const PairBarrier barrier = separation_barrier(parameters, Body{}, stranger(0.1));
    const double inside = row_at(parameters, barrier, barrier.radius_m - 1e-8)->offset;
    const double outside = row_at(parameters, barrier, barrier.radius_m + 1e-8)->offset;
    EXPECT_NEAR(inside, 0.1, 1e-6);
    EXPECT_NEAR(outside, 0.1, 1e-6);
  }
}

TEST(Barrier, Coincident_drones_are_sent_opposite_ways) {
  const BarrierParameters parameters = cautious();
  const PairBarrier barrier = of_drones(parameters);
  for (int j = 1; j < 20; ++j) {
    const auto row = pair_row(parameters, barrier, Vec2::Zero(), Vec2::Zero(), 0, j, Priority::kSeparation);
    const auto back = pair_row(parameters, barrier, Vec2::Zero(), Vec2::Zero(), j, 0, Priority::kSeparation);
    ASSERT_TRUE(row && back);
    EXPECT_EQ(row->normal, -back->normal);
    EXPECT_NEAR(row->normal.norm(), 1.0, 1e-15);
    EXPECT_GT(row->offset, 0.0);
  }
}

TEST(Barrier, A_contact_row_asks_for_no_more_than_the_separation_row_of_the_same_pair) {
  for (const BarrierParameters& parameters : {paper(), cautious()}) {
    for (const double speed : {-1.0, 0.0, 0.2, 0.5}) {
      const Body other = speed < 0.0 ? Body{} : stranger(speed);
      const PairBarrier separation = separation_barrier(parameters, Body{}, other);
      const PairBarrier contact = contact_barrier(parameters, other);
      for (double d = 0.0; d < 1.0; d += 0.001) {
        const auto firm = row_at(parameters, separation, d);
        const auto last = row_at(parameters, contact, d);
        if (!last) continue;
        ASSERT_TRUE(firm) << d;
        EXPECT_LE(last->offset, firm->offset + 1e-15) << d;
      }
    }
  }
}

TEST(Barrier, Outside_the_field_the_wall_points_back_inside) {
  for (const BarrierParameters& parameters : {paper(), cautious()}) {
    const auto row =
        wall_row(parameters, {3.0, 2.0}, Vec2(3.5, 1.0), 1, wall_reserve(parameters, Body{}), Priority::kWall);
    ASSERT_TRUE(row);
    EXPECT_EQ(row->normal, Vec2(-1.0, 0.0));
    EXPECT_NEAR(row->offset, 0.15, 1e-15);
  }
}

TEST(Barrier, Beyond_the_wall_range_there_is_no_row_unless_one_tick_could_reach_the_wall) {
  BarrierParameters parameters = paper();
  parameters.wall_range_m = 0.25;
  EXPECT_TRUE(wall_row(parameters, {3.0, 3.0}, Vec2(0.24, 1.0), 0, wall_reserve(parameters, Body{}), Priority::kWall));
  EXPECT_FALSE(wall_row(parameters, {3.0, 3.0}, Vec2(0.26, 1.0), 0, wall_reserve(parameters, Body{}), Priority::kWall));
  parameters.wall_range_m = 0.0;
  EXPECT_TRUE(wall_row(parameters, {3.0, 3.0}, Vec2(0.172, 1.0), 0, wall_reserve(parameters, Body{}), Priority::kWall));
}

field::Polygon arrow(double x, double y) {  // concave: a notch in its right side
  return {{Vec2(x, y), Vec2(x + 1.0, y), Vec2(x + 0.5, y + 0.5), Vec2(x + 1.0, y + 1.0), Vec2(x, y + 1.0)}};
}

TEST(Barrier, Outlines_are_told_apart_and_know_what_they_enclose) {
  std::vector<field::Segment> edges = field::edges(arrow(0.0, 0.0));
  for (const field::Segment& edge : field::edges(arrow(2.0, 0.0))) edges.push_back(edge);
  edges.push_back({Vec2(5.0, 0.0), Vec2(6.0, 0.0)});
  const std::span<const field::Segment> all(edges);
  ASSERT_EQ(outline_length(all), 5U);
  ASSERT_EQ(outline_length(all.subspan(5)), 5U);
  ASSERT_EQ(outline_length(all.subspan(10)), 1U);
  EXPECT_EQ(outline_length(all.subspan(11)), 0U);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-0.5, 3.5);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p(coordinate(random), coordinate(random));
    EXPECT_EQ(encloses(all.first(5), p), field::contains(arrow(0.0, 0.0), p));
    EXPECT_EQ(encloses(all.subspan(5, 5), p), field::contains(arrow(2.0, 0.0), p));
    EXPECT_FALSE(encloses(all.subspan(10), p));
  }
}

TEST(Barrier, The_way_out_of_a_polygon_leads_through_its_nearest_edge) {
  const std::vector<field::Segment> outline = field::edges(arrow(0.0, 0.0));
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  int inside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec2 p(coordinate(random), coordinate(random));
    if (!encloses(outline, p)) continue;
    ++inside;
    const WayOut way = way_out(cautious(), outline, p);
    EXPECT_NEAR(way.distance_m, -field::signed_distance(arrow(0.0, 0.0), p), 1e-12);
    EXPECT_GT(way.row.offset, 0.0);
    EXPECT_FALSE(encloses(outline, p + (way.distance_m + 1e-6) * way.row.normal));
  }
  EXPECT_GT(inside, 200);
}

TEST(Barrier, On_an_edge_the_row_points_out_of_the_polygon) {
  const std::vector<field::Segment> outline = field::edges(arrow(0.0, 0.0));
  const auto row = edge_row(paper(), outline[0], Vec2(0.3, 0.0), 0.0, Priority::kWall);
  ASSERT_TRUE(row);
  EXPECT_LT((row->normal - Vec2(0.0, -1.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace vigil::safety
