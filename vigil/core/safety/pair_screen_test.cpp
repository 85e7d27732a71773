#include "vigil/core/safety/pair_screen.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/safety/filter.hpp"
#include "vigil/core/safety/parameters_for_tests.hpp"

namespace vigil::safety {
namespace {

constexpr field::Field kField{.length_x = 3.0, .length_y = 3.0};

struct Crowd {
  std::vector<Body> bodies;
  std::vector<Vec2> u_nom;
};

/// Drones with some room, or hardly any; a few old, strange or absent; some in a lattice, where distances are alike.
Crowd any_crowd(const BarrierParameters& parameters, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const std::size_t columns = 3 + random() % 8;
  const double spacing = kField.length_x / static_cast<double>(columns);
  const double astray = random() % 3 == 0 ? 0.0 : random() % 2 == 0 ? 0.1 : 0.5;
  const double haste = random() % 4 == 0 ? 1.4 : 1.0;
  const bool is_troubled = random() % 2 == 0;
  Crowd crowd;
  for (std::size_t i = 0; i < columns * columns; ++i) {
    const Vec2 cell(static_cast<double>(i % columns) + 0.5, static_cast<double>(i / columns) + 0.5);
    Body body;
    body.position = spacing * (cell + astray * Vec2(unit(random), unit(random)));
    if (random() % 3 != 0) body.velocity = 0.7 * parameters.u_max_m_s * Vec2(unit(random), unit(random));
    if (is_troubled && random() % 5 == 0) body.age_s = 0.1 * (1.0 + unit(random));
    if (is_troubled && random() % 23 == 0) body.is_obstacle = false;
    if (is_troubled && random() % 29 == 0) {
      body.is_controlled = false;
      body.uncooperative_speed_m_s = 0.1;
    }
    crowd.bodies.push_back(body);
    const Vec2 wanted = haste * parameters.u_max_m_s * Vec2(unit(random), unit(random));
    crowd.u_nom.push_back(random() % 6 == 0 ? Vec2(Vec2::Zero()) : wanted);
  }
  return crowd;
}

std::vector<BarrierParameters> kinds_of_barrier() {
  BarrierParameters slow = lag_aware();
  slow.pair_gain = 1.2;
  slow.lag_s = 0.1;
  BarrierParameters sensed = slow;
  sensed.sensing_range_m = 0.45;
  sensed.pair_margin_m = 0.02;
  return {paper(), lag_aware(), slow, sensed};
}

TEST(PairScreen, What_is_left_out_changes_no_answer_and_no_report) {
  std::mt19937_64 random(5);
  int held = 0;
  for (const BarrierParameters& parameters : kinds_of_barrier()) {
    for (int round = 0; round < 150; ++round) {
      const Crowd crowd = any_crowd(parameters, random);
      const std::size_t count = crowd.bodies.size();
      Filter filter(parameters, kField, count);
      std::vector<Vec2> u(count);
      std::vector<FilterReport> reports(count);
      filter.run(crowd.bodies, {}, crowd.u_nom, u, reports);
      for (std::size_t i = 0; i < count; ++i) {
        const Explanation all = filter.explain(i, crowd.bodies, {}, crowd.u_nom[i]);
        ASSERT_EQ(u[i], all.u) << round << ' ' << i;
        ASSERT_EQ(reports[i].holding_count, all.report.holding_count) << round << ' ' << i;
        for (std::size_t k = 0; k < 2; ++k) {
          ASSERT_EQ(reports[i].holding[k].kind, all.report.holding[k].kind);
          ASSERT_EQ(reports[i].holding[k].index, all.report.holding[k].index);
          ASSERT_EQ(reports[i].holding[k].distance_m, all.report.holding[k].distance_m);
        }
        ASSERT_EQ(reports[i].nearest, all.report.nearest) << round << ' ' << i;
        ASSERT_EQ(reports[i].nearest_distance_m, all.report.nearest_distance_m);
        ASSERT_EQ(reports[i].speed_limited, all.report.speed_limited);
        ASSERT_EQ(reports[i].margin_used, all.report.margin_used);
        ASSERT_EQ(reports[i].correction_m_s, all.report.correction_m_s);
        held += all.report.holding_count;
      }
    }
  }
  EXPECT_GT(held, 1'000);
}

/// Drones side by side in the order of the columns.
BodyColumns columns_of(const BarrierParameters& parameters, const std::vector<Body>& bodies) {
  BodyColumns columns(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    columns.set(i, bodies[i], barrier_point(parameters, bodies[i]), bodies[i].is_obstacle, parameters.u_max_m_s);
  return columns;
}

TEST(PairScreen, Every_instruction_set_leaves_out_the_same_and_much_where_there_is_room) {
  std::mt19937_64 random(6);
  std::size_t within_range = 0;
  std::size_t pressing = 0;
  for (const BarrierParameters& parameters : kinds_of_barrier()) {
    for (int round = 0; round < 300; ++round) {
      const Crowd crowd = any_crowd(parameters, random);
      const BodyColumns columns = columns_of(parameters, crowd.bodies);
      const std::size_t own = random() % crowd.bodies.size();
      const Body& body = crowd.bodies[own];
      const Screened drone{.place = own,
                           .point = barrier_point(parameters, body),
                           .position = body.position,
                           .velocity = body.velocity,
                           .drift_m = parameters.u_max_m_s * body.age_s,
                           .u_nom = crowd.u_nom[own],
                           .reach_m = derived_sensing_range(parameters)};
      const auto screened_by = [&](PairScreen::InstructionSet set) {
        Screening screening;
        const PairScreen screen(parameters, set);
        screening.clear();
        screening.add(0, crowd.bodies.size());
        screen.look(columns, drone, screening);
        return screening;
      };
      const Screening portable = screened_by(PairScreen::InstructionSet::kPortable);
      const Screening best = screened_by(PairRows::best_instruction_set());
      ASSERT_EQ(portable.is_sure(), best.is_sure());
      if (!portable.is_sure()) continue;
      ASSERT_TRUE(std::ranges::equal(portable.pressing(), best.pressing()));
      ASSERT_TRUE(std::ranges::equal(portable.nearest(), best.nearest()));
      within_range += portable.within_range();
      pressing += portable.pressing().size();
    }
  }
  EXPECT_GT(within_range, 1'000u);
  EXPECT_LT(2 * pressing, within_range);
}

}  // namespace
}  // namespace vigil::safety
