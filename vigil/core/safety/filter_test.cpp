#include "vigil/core/safety/filter.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "vigil/core/safety/parameters_for_tests.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::safety {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class FilterTest : public ::testing::TestWithParam<BarrierKind> {
 protected:
  /// One tick of bodies that stand still.
  void run(std::span<const Vec2> u_nom) {
    u_.resize(bodies_.size());
    reports_.resize(bodies_.size());
    filter_.run(bodies_, no_fly_, u_nom, u_, reports_);
  }
  void add(double x, double y) { bodies_.emplace_back().position = Vec2(x, y); }

  Filter filter_{GetParam() == BarrierKind::kPaper ? paper() : lag_aware(), {3.0, 3.0}, 400};
  std::vector<Body> bodies_;
  std::vector<field::Segment> no_fly_;
  std::vector<Vec2> u_;
  std::vector<FilterReport> reports_;
};

INSTANTIATE_TEST_SUITE_P(Barriers, FilterTest, ::testing::Values(BarrierKind::kPaper, BarrierKind::kLagAware));

TEST_P(FilterTest, A_drone_that_is_alone_does_as_it_is_told) {
  add(1.5, 1.5);
  run(std::array{Vec2(0.1, 0.2)});
  EXPECT_EQ(u_[0], Vec2(0.1, 0.2));
  EXPECT_EQ(reports_[0].holding_count, 0);
  EXPECT_EQ(reports_[0].nearest, -1);
  EXPECT_EQ(reports_[0].correction_m_s, 0.0);
}

TEST_P(FilterTest, The_report_says_who_holds_the_drone_and_how_far_it_is) {
  add(1.5, 1.5);
  add(1.73, 1.5);
  run(std::array{Vec2(0.3, 0.0), Vec2(-0.3, 0.0)});
  ASSERT_EQ(reports_[0].holding_count, 1);
  EXPECT_EQ(reports_[0].holding[0].kind, RowKind::kNeighbour);
  EXPECT_EQ(reports_[0].holding[0].index, 1);
  EXPECT_NEAR(reports_[0].holding[0].distance_m, 0.23, 1e-15);
  EXPECT_EQ(reports_[0].nearest, 1);
  EXPECT_NEAR(reports_[0].nearest_distance_m, 0.23, 1e-15);
  EXPECT_NEAR(reports_[0].correction_m_s, (u_[0] - Vec2(0.3, 0.0)).norm(), 1e-15);
  EXPECT_GT(reports_[0].correction_m_s, 0.1);
}

TEST_P(FilterTest, Bodies_that_nobody_asks_a_velocity_for_are_kept_clear_of_all_the_same) {
  add(1.5, 1.5);
  add(1.73, 1.5);
  const std::array u_nom{Vec2(0.3, 0.0), Vec2::Zero().eval()};
  run(u_nom);
  const std::vector<Vec2> of_both = u_;
  u_.resize(1);
  reports_.resize(1);
  filter_.run(bodies_, no_fly_, std::span(u_nom).first(1), u_, reports_);
  EXPECT_EQ(u_[0], of_both[0]);
  EXPECT_EQ(reports_[0].holding[0].index, 1);
}

TEST_P(FilterTest, The_report_says_which_wall_and_which_edge_hold_a_drone) {
  no_fly_ = field::edges({{Vec2(1.0, 1.0), Vec2(2.0, 1.0), Vec2(2.0, 2.0), Vec2(1.0, 2.0)}});
  add(2.81, 0.5);
  add(1.5, 0.85);
  run(std::array{Vec2(0.3, 0.0), Vec2(0.0, 0.3)});
  ASSERT_EQ(reports_[0].holding_count, 1);
  EXPECT_EQ(reports_[0].holding[0].kind, RowKind::kWall);
  EXPECT_EQ(reports_[0].holding[0].index, 1);
  EXPECT_NEAR(reports_[0].holding[0].distance_m, 0.19, 1e-12);
  ASSERT_EQ(reports_[1].holding_count, 1);
  EXPECT_EQ(reports_[1].holding[0].kind, RowKind::kNoFly);
  EXPECT_EQ(reports_[1].holding[0].index, 0);
  EXPECT_NEAR(reports_[1].holding[0].distance_m, 0.15, 1e-12);
}

TEST_P(FilterTest, A_body_that_is_no_obstacle_is_ignored) {
  add(1.5, 1.5);
  add(1.6, 1.5);
  bodies_[1].is_obstacle = false;
  run(std::array{Vec2(0.3, 0.0), Vec2::Zero().eval()});
  EXPECT_EQ(u_[0], Vec2(0.3, 0.0));
  EXPECT_EQ(reports_[0].nearest, -1);
}

TEST_P(FilterTest, A_body_that_is_not_controlled_gets_no_velocity) {
  add(1.5, 1.5);
  bodies_[0].is_controlled = false;
  run(std::array{Vec2(0.3, 0.0)});
  EXPECT_EQ(u_[0], Vec2::Zero());
}

TEST_P(FilterTest, A_drone_whose_state_or_command_is_no_number_is_told_to_stand_still) {
  for (int what = 0; what < 4; ++what) {
    bodies_.clear();
    add(1.5, 1.5);
    add(1.6, 1.5);
    std::array u_nom{Vec2(0.1, 0.0), Vec2(0.0, 0.1)};
    if (what == 0) bodies_[0].position.x() = kNan;
    if (what == 1) bodies_[0].velocity.y() = std::numeric_limits<double>::infinity();
    if (what == 2) bodies_[0].age_s = kNan;
    if (what == 3) u_nom[0].y() = kNan;
    run(u_nom);
    EXPECT_TRUE(reports_[0].input_rejected) << what;
    EXPECT_EQ(u_[0], Vec2::Zero()) << what;
    EXPECT_FALSE(reports_[1].input_rejected) << what;
    // A bad command says nothing about where the drone is.
    EXPECT_EQ(reports_[1].nearest, what == 3 ? 0 : -1) << what;
  }
}

TEST_P(FilterTest, Whatever_numbers_come_every_velocity_is_finite_and_within_the_limit) {
  const std::array numbers{0.0, 1.5, -1.5, 1e-12, 1e9, -1e150, 1e308, kNan, std::numeric_limits<double>::infinity()};
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::size_t> pick(0, numbers.size() - 1);
  const auto draw = [&] { return numbers[pick(random)]; };
  no_fly_ = field::edges({{Vec2(1.0, 1.0), Vec2(2.0, 1.0), Vec2(2.0, 2.0), Vec2(1.0, 2.0)}});
  for (int round = 0; round < 3000; ++round) {
    bodies_.clear();
    std::vector<Vec2> u_nom;
    for (int i = 0; i < 5; ++i) {
      add(draw(), draw());
      bodies_.back().velocity = Vec2(draw(), draw());
      bodies_.back().age_s = draw();
      bodies_.back().uncooperative_speed_m_s = draw();
      bodies_.back().is_controlled = round % 5 != i;
      u_nom.emplace_back(draw(), draw());
    }
    run(u_nom);
    for (const Vec2& u : u_) {
      ASSERT_TRUE(u.allFinite()) << round;
      ASSERT_LE(u.norm(), 0.3 * (1.0 + 1e-15)) << round;
    }
  }
}

TEST_P(FilterTest, Where_nobody_is_too_close_standing_still_is_always_allowed) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> coordinate(0.17, 2.83);
  std::uniform_real_distribution<double> speed(-1.0, 1.0);
  const double apart = barrier_radius(filter_.parameters());
  for (int round = 0; round < 500; ++round) {
    bodies_.clear();
    std::vector<Vec2> u_nom;
    for (int attempt = 0; attempt < 60; ++attempt) {
      const Vec2 p(coordinate(random), coordinate(random));
      const bool is_free =
          std::all_of(bodies_.begin(), bodies_.end(), [&](const Body& b) { return (b.position - p).norm() >= apart; });
      if (!is_free) continue;
      add(p.x(), p.y());
      u_nom.emplace_back(speed(random), speed(random));
    }
    run(u_nom);
    for (const FilterReport& report : reports_) ASSERT_FALSE(report.fallback) << "round " << round;
  }
}

TEST_P(FilterTest, A_drone_that_is_too_close_to_two_others_says_so) {
  add(1.5, 1.5);
  add(1.6, 1.5);
  add(1.4, 1.5);
  run(std::array{Vec2(0.1, 0.1), Vec2::Zero().eval(), Vec2::Zero().eval()});
  EXPECT_TRUE(reports_[0].fallback);
  EXPECT_GT(reports_[0].violation_m_s, 0.1);
  EXPECT_NEAR(u_[0].x(), 0.0, 1e-9);  // in the middle
}

TEST_P(FilterTest, Bodies_are_kept_apart_before_separation_and_separation_before_walls) {
  // Between a wall that it is too close to and a neighbour that it is too close to: it goes for the wall.
  add(0.05, 1.5);
  add(0.2, 1.5);
  bodies_[1].is_controlled = false;
  run(std::array{Vec2::Zero().eval(), Vec2::Zero().eval()});
  EXPECT_TRUE(reports_[0].fallback);
  EXPECT_LT(u_[0].x(), 0.0);
  // Between a body that it touches on the right and one that is only too close on the left: it goes left.
  bodies_.clear();
  add(1.5, 1.5);
  add(1.55, 1.5);
  add(1.39, 1.5);
  bodies_[1].is_controlled = bodies_[2].is_controlled = false;
  run(std::array{Vec2::Zero().eval(), Vec2::Zero().eval(), Vec2::Zero().eval()});
  EXPECT_TRUE(reports_[0].fallback);
  EXPECT_LT(u_[0].x(), -0.01);
}

TEST_P(FilterTest, A_drone_outside_the_field_comes_back) {
  add(-1.0, 4.0);
  for (int k = 0; k < 2000; ++k) {
    run(std::array{Vec2(-0.3, 0.3)});
    bodies_[0].position += 0.02 * u_[0];
  }
  EXPECT_GE(bodies_[0].position.x(), 0.17 - 1e-3);
  EXPECT_LE(bodies_[0].position.y(), 2.83 + 1e-3);
}

TEST_P(FilterTest, A_drone_inside_a_no_fly_polygon_leaves_it) {
  no_fly_ = field::edges({{Vec2(1.0, 1.0), Vec2(2.0, 1.0), Vec2(1.5, 1.5), Vec2(2.0, 2.0), Vec2(1.0, 2.0)}});
  for (const Vec2& start : {Vec2(1.2, 1.5), Vec2(1.5, 1.2), Vec2(1.45, 1.5), Vec2(1.9, 1.95)}) {
    bodies_.clear();
    add(start.x(), start.y());
    for (int k = 0; k < 500; ++k) {
      run(std::array<Vec2, 1>{0.3 * (Vec2(1.3, 1.5) - bodies_[0].position).normalized()});  // it wants to stay
      bodies_[0].position += 0.02 * u_[0];
    }
    double distance = HUGE_VAL;
    for (const field::Segment& edge : no_fly_)
      distance = std::min(distance, (field::nearest_point(edge, bodies_[0].position) - bodies_[0].position).norm());
    EXPECT_GE(distance, 0.1 - 1e-3) << start.transpose();
  }
}

TEST_P(FilterTest, Coincident_drones_part) {
  for (int i = 0; i < 8; ++i) add(1.5, 1.5);
  for (int k = 0; k < 1000; ++k) {
    run(std::vector<Vec2>(8, Vec2::Zero()));
    for (std::size_t i = 0; i < 8; ++i) bodies_[i].position += 0.02 * u_[i];
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((bodies_[i].position - bodies_[j].position).norm(), 0.2 - 1e-3);
  }
}

TEST_P(FilterTest, More_neighbours_than_rows_are_reported_and_the_most_pressing_ones_kept) {
  for (int i = 0; i < 300; ++i) {
    const double angle = 0.1 * i;
    add(1.5 + 0.24 * std::cos(angle), 1.5 + 0.24 * std::sin(angle));
  }
  add(1.5, 1.5);
  add(1.62, 1.5);  // the closest of all, and the last
  std::vector<Vec2> u_nom(bodies_.size(), Vec2(0.3, 0.0));
  run(u_nom);
  EXPECT_TRUE(reports_[300].crowded);
  EXPECT_LT(u_[300].x(), 0.0);
}

TEST_P(FilterTest, The_same_input_gives_the_same_bits) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(0.0, 3.0);
  std::vector<Vec2> u_nom;
  for (int i = 0; i < 100; ++i) {
    add(coordinate(random), coordinate(random));
    u_nom.emplace_back(coordinate(random) - 1.5, coordinate(random) - 1.5);
  }
  run(u_nom);
  const std::vector<Vec2> first = u_;
  Filter other(filter_.parameters(), {3.0, 3.0}, 100);
  other.run(bodies_, no_fly_, u_nom, u_, reports_);
  EXPECT_EQ(u_, first);
}

TEST_P(FilterTest, An_explanation_tells_the_rows_that_made_the_velocity_and_changes_nothing) {
  no_fly_ = field::edges({{Vec2(1.0, 1.0), Vec2(2.0, 1.0), Vec2(2.0, 2.0), Vec2(1.0, 2.0)}});
  add(2.81, 0.5);
  add(2.81, 0.74);
  add(1.5, 0.85);
  bodies_.emplace_back(bodies_[0]).is_controlled = false;
  bodies_.back().position = Vec2(0.5, 2.5);
  const std::array u_nom{Vec2(0.3, 0.1), Vec2(0.2, -0.3), Vec2(0.0, 0.3), Vec2(0.1, 0.0)};
  run(u_nom);
  const std::vector<Vec2> u = u_;
  for (std::size_t own = 0; own < bodies_.size(); ++own) {
    const Explanation why = filter_.explain(own, bodies_, no_fly_, u_nom[own]);
    EXPECT_EQ(why.u_nom, u_nom[own]);
    EXPECT_EQ(why.u, u[own]);
    EXPECT_EQ(why.report.holding_count, reports_[own].holding_count);
    EXPECT_EQ(why.rows.empty(), !bodies_[own].is_controlled);
    for (const GivenRow& row : why.rows)
      EXPECT_GE(row.half_plane.normal.dot(why.u), row.half_plane.offset - 1e-9 * row.half_plane.normal.norm());
  }
  run(u_nom);
  EXPECT_EQ(u_, u);
}

TEST_P(FilterTest, A_tick_allocates_nothing) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(0.0, 3.0);
  no_fly_ = field::edges({{Vec2(1.0, 1.0), Vec2(2.0, 1.0), Vec2(2.0, 2.0), Vec2(1.0, 2.0)}});
  std::vector<Vec2> u_nom;
  for (int i = 0; i < 400; ++i) {  // crowded, so that the relaxation runs too
    add(coordinate(random), coordinate(random));
    u_nom.emplace_back(coordinate(random) - 1.5, coordinate(random) - 1.5);
  }
  run(u_nom);
  const testing::AllocationGuard guard;
  run(u_nom);
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(std::any_of(reports_.begin(), reports_.end(), [](const FilterReport& r) { return r.fallback; }));
}

}  // namespace
}  // namespace vigil::safety
