// The guarantee by brute force: whatever velocities are asked for, nobody comes closer than the barrier says, between
// samples included. Everyone here wants to collide.

#include <random>

#include <gtest/gtest.h>

#include "vigil/core/safety/filter.hpp"

namespace vigil::safety {
namespace {

constexpr double kRoundingOfManyTicks = 1e-7;

/// A crowd of drones with first-order lag (ideal where lag is 0), each held at one velocity for a tick and moved
/// exactly. Lengths in a field of 3 x 3 m.
class Crowd {
 public:
  Crowd(const BarrierParameters& parameters, double plants_lag, std::uint64_t seed)
      : parameters_(parameters), lag_(plants_lag), filter_(parameters, kField, 32), random_(seed) {}

  void add_no_fly(const field::Polygon& polygon) {
    const std::vector<field::Segment> outline = field::edges(polygon);
    no_fly_.insert(no_fly_.end(), outline.begin(), outline.end());
    polygons_.push_back(polygon);
  }

  /// At rest, at places that break no barrier; as many of `count` as find one.
  void place(int count) {
    const double margin = parameters_.wall_distance_m;
    for (int attempt = 0; attempt < 50 * count && static_cast<int>(bodies_.size()) < count; ++attempt) {
      Body body;
      body.position = Vec2(uniform(margin, 3.0 - margin), uniform(margin, 3.0 - margin));
      if (is_legal(body.position)) bodies_.push_back(body);
    }
    wishes_.assign(bodies_.size(), Vec2::Zero());
    u_.resize(bodies_.size());
    reports_.resize(bodies_.size());
  }

  /// Anew now and then: at somebody, at a corner, or anywhere; and faster than allowed.
  void wish() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (uniform(0.0, 1.0) > 0.05) continue;
      const auto other = static_cast<std::size_t>(uniform(0.0, static_cast<double>(bodies_.size())));
      const Vec2 somewhere(uniform(-1.0, 4.0), uniform(-1.0, 4.0));
      const Vec2 goal = uniform(0.0, 1.0) < 0.6 ? bodies_[other].position : somewhere;
      wishes_[i] = 3.0 * (goal - bodies_[i].position);
    }
  }

  void tick() {
    wish();
    filter_.run(bodies_, no_fly_, wishes_, u_, reports_);
    for (int part = 0; part < 4; ++part) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) move(bodies_[i], u_[i], 0.25 * parameters_.dt_s);
      measure();
    }
  }

  /// v' = (u - v) / lag, solved.
  void move(Body& body, const Vec2& u, double time) const {
    if (!body.is_controlled) {
      body.position += time * body.velocity;
      return;
    }
    if (lag_ == 0.0) {
      body.velocity = u;
      body.position += time * u;
      return;
    }
    const double rest = std::exp(-time / lag_);
    body.position += time * u + lag_ * (1.0 - rest) * (body.velocity - u);
    body.velocity = u + rest * (body.velocity - u);
  }

  void measure() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i].is_controlled) continue;
      const Vec2& p = bodies_[i].position;
      least_wall_ = std::min({least_wall_, p.x(), p.y(), 3.0 - p.x(), 3.0 - p.y()});
      for (const field::Polygon& polygon : polygons_) least_edge_ = std::min(least_edge_, signed_distance(polygon, p));
      for (std::size_t j = 0; j < bodies_.size(); ++j) {
        if (i != j) least_distance_ = std::min(least_distance_, (p - bodies_[j].position).norm());
      }
    }
  }

  [[nodiscard]] bool any_fallback() const {
    return std::any_of(reports_.begin(), reports_.end(), [](const FilterReport& report) { return report.fallback; });
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  static constexpr field::Field kField{3.0, 3.0};
  BarrierParameters parameters_;
  double lag_;
  Filter filter_;
  std::mt19937_64 random_;
  std::vector<field::Segment> no_fly_;
  std::vector<field::Polygon> polygons_;
  std::vector<Body> bodies_;
  std::vector<Vec2> wishes_;
  std::vector<Vec2> u_;
  std::vector<FilterReport> reports_;
  double least_distance_ = HUGE_VAL;
  double least_wall_ = HUGE_VAL;
  double least_edge_ = HUGE_VAL;

 private:
  [[nodiscard]] bool is_legal(const Vec2& p) const {
    const double from_edges = 1e-9 + std::hypot(parameters_.no_fly_buffer_m, parameters_.lag_s * parameters_.u_max_m_s);
    return std::all_of(bodies_.begin(), bodies_.end(),
                       [&](const Body& b) { return (b.position - p).norm() >= barrier_radius(parameters_); }) &&
           std::all_of(polygons_.begin(), polygons_.end(),
                       [&](const field::Polygon& polygon) { return signed_distance(polygon, p) >= from_edges; });
  }
};

double draw(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

BarrierParameters random_parameters(BarrierKind kind, std::mt19937_64& random) {
  BarrierParameters parameters;
  parameters.kind = kind;
  parameters.separation_m = draw(random, 0.1, 0.3);
  parameters.contact_distance_m = draw(random, 0.2, 1.0) * parameters.separation_m;
  parameters.wall_distance_m = draw(random, 0.0, 0.2);
  parameters.no_fly_buffer_m = draw(random, 0.02, 0.2);
  parameters.u_max_m_s = std::pow(10.0, draw(random, -1.0, 0.7));
  parameters.dt_s = std::pow(10.0, draw(random, -2.5, -0.7));
  parameters.pair_gain = std::pow(10.0, draw(random, -1.0, 4.0));  // also far too large for the tick
  parameters.wall_gain = std::pow(10.0, draw(random, -1.0, 4.0));
  return parameters;
}

field::Polygon star() {  // concave
  return {{Vec2(1.0, 1.0), Vec2(1.5, 1.3), Vec2(2.0, 1.0), Vec2(1.7, 1.5), Vec2(2.0, 2.0), Vec2(1.5, 1.7),
           Vec2(1.0, 2.0), Vec2(1.3, 1.5)}};
}

void expect_kept(const Crowd& crowd) {
  const BarrierParameters& parameters = crowd.parameters_;
  EXPECT_GE(crowd.least_distance_, parameters.separation_m - kRoundingOfManyTicks);
  EXPECT_GE(crowd.least_wall_, parameters.wall_distance_m - kRoundingOfManyTicks);
  EXPECT_GE(crowd.least_edge_, parameters.no_fly_buffer_m - kRoundingOfManyTicks);
}

class SampledSafety : public ::testing::TestWithParam<BarrierKind> {};
INSTANTIATE_TEST_SUITE_P(Barriers, SampledSafety, ::testing::Values(BarrierKind::kPaper, BarrierKind::kLagAware));

TEST_P(SampledSafety, Ideal_drones_never_break_a_barrier_whatever_the_parameters) {
  std::mt19937_64 random(100);
  for (int round = 0; round < 16; ++round) {
    BarrierParameters parameters = random_parameters(GetParam(), random);
    Crowd crowd(parameters, 0.0, 1000 + static_cast<std::uint64_t>(round));
    crowd.add_no_fly(star());
    crowd.place(round % 4 == 0 ? 2 : 20);
    for (int k = 0; k < 1000; ++k) {
      crowd.tick();
      ASSERT_FALSE(crowd.any_fallback()) << "round " << round << " tick " << k;
    }
    SCOPED_TRACE(round);
    expect_kept(crowd);
  }
}

TEST_P(SampledSafety, Nor_do_they_with_a_short_sensing_range) {
  std::mt19937_64 random(200);
  for (int round = 0; round < 12; ++round) {
    BarrierParameters parameters = random_parameters(GetParam(), random);
    parameters.sensing_range_m = round % 2 == 0 ? 2.0 * parameters.separation_m : least_sensing_range(parameters);
    parameters.wall_range_m = 0.6 * draw(random, 0.0, 1.0);
    Crowd crowd(parameters, 0.0, 2000 + static_cast<std::uint64_t>(round));
    crowd.add_no_fly(star());
    crowd.place(20);
    for (int k = 0; k < 1000; ++k) crowd.tick();
    SCOPED_TRACE(round);
    expect_kept(crowd);
  }
}

TEST(SampledSafetyWithLag, Drones_whose_velocity_lags_its_command_never_break_a_barrier) {
  std::mt19937_64 random(300);
  for (int round = 0; round < 16; ++round) {
    BarrierParameters parameters = random_parameters(BarrierKind::kLagAware, random);
    parameters.u_max_m_s = draw(random, 0.1, 1.0);
    parameters.lag_s = draw(random, 0.01, 0.5);
    Crowd crowd(parameters, parameters.lag_s, 3000 + static_cast<std::uint64_t>(round));
    crowd.add_no_fly(star());
    crowd.place(20);
    for (int k = 0; k < 1000; ++k) crowd.tick();
    SCOPED_TRACE(round);
    expect_kept(crowd);
  }
}

TEST(SampledSafetyWithLag, The_papers_barrier_does_not_survive_the_same_lag) {
  std::mt19937_64 random(300);
  BarrierParameters parameters = random_parameters(BarrierKind::kPaper, random);
  parameters.separation_m = 0.2;
  parameters.pair_gain = 1000.0;
  parameters.u_max_m_s = 0.5;
  Crowd crowd(parameters, 0.3, 1);
  crowd.place(20);
  for (int k = 0; k < 1000; ++k) crowd.tick();
  EXPECT_LT(crowd.least_distance_, 0.19);
}

/// Flies straight at a drone, and on through it if it could.
void chase(Crowd& crowd, double speed) {
  Body& intruder = crowd.bodies_[0];
  const Vec2 to = crowd.bodies_[1].position - intruder.position;
  intruder.velocity = speed * to.normalized();
}

TEST_P(SampledSafety, An_intruder_as_fast_as_the_drone_cannot_catch_it_in_the_open) {
  for (int round = 0; round < 12; ++round) {
    std::mt19937_64 random(400 + static_cast<std::uint64_t>(round));
    BarrierParameters parameters = random_parameters(GetParam(), random);
    parameters.lag_s = GetParam() == BarrierKind::kLagAware ? 0.2 : 0.0;
    parameters.u_max_m_s = 0.3;
    Crowd crowd(parameters, parameters.lag_s, 4000 + static_cast<std::uint64_t>(round));
    crowd.filter_ = Filter(parameters, {1e6, 1e6}, 2);  // no wall to be cornered at
    crowd.bodies_.resize(2);
    crowd.bodies_[0].position = Vec2(5e5, 5e5);
    crowd.bodies_[1].position = Vec2(5e5 + 2.0, 5e5 + 0.1);
    crowd.bodies_[0].is_controlled = false;
    const double speed = 0.3 * draw(random, 0.1, 1.0);
    crowd.bodies_[0].uncooperative_speed_m_s = speed;
    crowd.wishes_.assign(2, Vec2::Zero());
    crowd.u_.resize(2);
    crowd.reports_.resize(2);
    for (int k = 0; k < 2000; ++k) {
      chase(crowd, speed);
      crowd.tick();
    }
    EXPECT_GE(crowd.least_distance_, parameters.separation_m - kRoundingOfManyTicks) << round;
  }
}

TEST_P(SampledSafety, A_body_that_stands_still_and_is_not_controlled_is_avoided_by_all) {
  std::mt19937_64 random(500);
  for (int round = 0; round < 12; ++round) {
    BarrierParameters parameters = random_parameters(GetParam(), random);
    parameters.lag_s = GetParam() == BarrierKind::kLagAware ? 0.2 : 0.0;
    parameters.u_max_m_s = 0.5;
    Crowd crowd(parameters, parameters.lag_s, 5000 + static_cast<std::uint64_t>(round));
    crowd.place(12);
    crowd.bodies_[0].is_controlled = false;
    for (int k = 0; k < 1000; ++k) crowd.tick();
    SCOPED_TRACE(round);
    expect_kept(crowd);
  }
}

TEST_P(SampledSafety, Drones_whose_states_come_late_keep_their_distance) {
  std::mt19937_64 random(600);
  for (int round = 0; round < 12; ++round) {
    BarrierParameters parameters = random_parameters(GetParam(), random);
    parameters.lag_s = GetParam() == BarrierKind::kLagAware ? 0.2 : 0.0;
    parameters.u_max_m_s = 0.3;
    parameters.dt_s = 0.02;
    parameters.pair_gain = GetParam() == BarrierKind::kPaper ? 10.0 : 5.0;
    Crowd crowd(parameters, parameters.lag_s, 6000 + static_cast<std::uint64_t>(round));
    crowd.place(8);
    std::vector<std::vector<Body>> history;
    constexpr std::size_t kLateTicks = 10;
    for (int k = 0; k < 1500; ++k) {
      history.push_back(crowd.bodies_);
      crowd.wish();
      std::vector<Body> seen = crowd.bodies_;
      for (std::size_t i = 0; i < seen.size(); i += 2) {  // every other one is seen late
        const std::size_t late = std::min(kLateTicks, history.size() - 1);
        seen[i] = history[history.size() - 1 - late][i];
        seen[i].age_s = static_cast<double>(late) * parameters.dt_s;
      }
      crowd.filter_.run(seen, {}, crowd.wishes_, crowd.u_, crowd.reports_);
      for (std::size_t i = 0; i < crowd.bodies_.size(); ++i) crowd.move(crowd.bodies_[i], crowd.u_[i], parameters.dt_s);
      crowd.measure();
    }
    EXPECT_GE(crowd.least_distance_, parameters.separation_m - kRoundingOfManyTicks) << round;
  }
}

}  // namespace
}  // namespace vigil::safety
