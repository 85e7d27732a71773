// Drones whose wishes are the worst that a search finds, flown through the models, dead times and delays with the
// filter between wish and order: with the derived margins nobody comes too close, without them somebody does.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/vehicle_model.hpp"
#include "vigil/runtime/adversarial_flight.hpp"
#include "vigil/runtime/margins.hpp"

namespace vigil::runtime {
namespace {

/// A vehicle and the delays it is flown with.
struct Craft {
  const char* name;
  MarginProblem problem;
};

std::ostream& operator<<(std::ostream& out, const Craft& craft) { return out << craft.name; }

Craft craft(const char* name, const dynamics::VehicleModel& vehicle, double u_max_m_s, double separation_m, double dt_s,
            double observation_delay_s, double command_delay_s, double silence_s = 0.0) {
  MarginProblem problem;
  problem.loop = vehicle.horizontal;
  problem.u_max_m_s = u_max_m_s;
  problem.separation_m = separation_m;
  problem.dt_s = dt_s;
  problem.observation_delay_s = observation_delay_s;
  problem.command_delay_s = command_delay_s;
  problem.silence_s = silence_s;
  return {name, problem};
}

std::vector<Craft> crafts() {
  return {craft("crazyflie", dynamics::crazyflie_vehicle(), 0.5, 0.2, 0.02, 0.02, 0.02),
          craft("arducopter", dynamics::arducopter_vehicle(), 5.0, 10.0, 0.05, 0.3, 0.2),
          craft("slow arducopter", dynamics::arducopter_vehicle(), 2.0, 10.0, 0.05, 0.1, 0.15),
          craft("arducopter by radio", dynamics::arducopter_vehicle(), 5.0, 10.0, 0.05, 0.3, 0.2, 3.4),
          craft("px4", dynamics::px4_vehicle(), 5.0, 6.0, 0.05, 0.2, 0.2),
          craft("px4 by radio", dynamics::px4_vehicle(), 5.0, 6.0, 0.05, 0.2, 0.2, 2.4)};
}

/// How much room drones and walls had at the worst of many moments, beyond R_s and R_wall.
struct Spare {
  double pair_m = 1e9;
  double wall_m = 1e9;
};

/// Other angles, periods and seeds than those that the margins were derived from.
std::vector<AdversarialFlight> wishes(const AdversarialFlight& plain, double time_s) {
  std::vector<AdversarialFlight> flights;
  const auto add = [&](Wish wish, double periods, double angle_rad) {
    AdversarialFlight flight = plain;
    flight.wish = wish;
    flight.period_s = periods * time_s;
    flight.angle_rad = angle_rad;
    flight.seed = 11;
    flight.duration_s = 3.0 / plain.barrier.pair_gain + 4.0 * flight.period_s + 10.0;
    flights.push_back(flight);
  };
  constexpr std::array kAngles = {0.2, 0.6, 1.2, 1.5};
  add(Wish::kPress, 1.0, 0.0);
  for (const double angle : kAngles) add(Wish::kOrbit, 1.0, angle);
  for (const double periods : {0.4, 1.0, 3.0, 6.0}) {
    for (const Wish wish : {Wish::kPulse, Wish::kChase, Wish::kRandom}) add(wish, periods, 0.0);
    for (const double angle : kAngles) add(Wish::kReverse, periods, angle);
    for (const double angle : kAngles) add(Wish::kWalls, periods, angle);
  }
  return flights;
}

Spare fly_all(const MarginProblem& problem, const Margins& margins, bool with_margins, std::size_t drones) {
  AdversarialFlight plain;
  plain.loop = problem.loop;
  plain.drones = drones;
  safety::BarrierParameters& barrier = plain.barrier;
  barrier.separation_m = problem.separation_m;
  barrier.contact_distance_m = 0.5 * problem.separation_m;
  barrier.u_max_m_s = problem.u_max_m_s;
  barrier.dt_s = problem.dt_s;
  barrier.lag_s = margins.lag_s;
  barrier.pair_gain = margins.pair_gain;
  barrier.wall_gain = margins.wall_gain;
  barrier.margin_m = with_margins ? margins.wall.total() : 0.0;
  barrier.pair_margin_m = with_margins ? margins.pair.total() : 0.0;
  const double slowing_m = problem.u_max_m_s * (1.0 / std::min(margins.pair_gain, margins.wall_gain) + margins.lag_s);
  const double apart_m = 1.3 * (problem.separation_m + 2.0 * margins.pair.total());
  plain.start_radius_m = std::max(slowing_m, 0.5 * apart_m / std::sin(std::numbers::pi / static_cast<double>(drones)));
  const double side_m = 2.0 * plain.start_radius_m + 3.0 * slowing_m + 2.0 * margins.wall.total();
  plain.field = {.length_x = side_m, .length_y = side_m};
  plain.observation_delay_ticks = static_cast<std::size_t>(std::lround(problem.observation_delay_s / problem.dt_s));
  plain.command_delay_ticks = static_cast<std::size_t>(std::lround(problem.command_delay_s / problem.dt_s));

  Spare spare;
  for (const AdversarialFlight& flight : wishes(plain, margins.lag_s + 0.5 / margins.pair_gain)) {
    const Closest closest = fly(flight);
    spare.pair_m = std::min(spare.pair_m, closest.separation_m - problem.separation_m);
    spare.wall_m = std::min(spare.wall_m, closest.wall_m);
  }
  return spare;
}

class AdversarialOrbit : public testing::TestWithParam<Craft> {
 protected:
  const MarginProblem& problem_ = GetParam().problem;
  Margins margins_ = derive_margins(problem_);
};

TEST_P(AdversarialOrbit, Nobody_comes_too_close_with_the_derived_margins) {
  for (const std::size_t drones : {2U, 3U, 10U}) {
    SCOPED_TRACE(drones);
    const Spare spare = fly_all(problem_, margins_, true, drones);
    EXPECT_GE(spare.pair_m, 0.0);
    EXPECT_GE(spare.wall_m, 0.0);
    RecordProperty("spare_pair_mm_of_" + std::to_string(drones), static_cast<int>(1e3 * spare.pair_m));
    RecordProperty("spare_wall_mm_of_" + std::to_string(drones), static_cast<int>(1e3 * spare.wall_m));
  }
}

TEST_P(AdversarialOrbit, Somebody_comes_too_close_without_them) {
  EXPECT_LT(fly_all(problem_, margins_, false, 2).pair_m, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, AdversarialOrbit, testing::ValuesIn(crafts()));

TEST(AdversarialOrbit, A_first_order_lag_needs_no_margin_whatever_its_delays) {
  MarginProblem problem = craft("lag", dynamics::first_order_lag_vehicle(0.3), 0.3, 0.2, 0.02, 0.06, 0.1).problem;
  const Margins margins = derive_margins(problem);
  EXPECT_EQ(margins.pair.total(), 0.0);
  EXPECT_EQ(margins.lag_s, 0.3);
  for (const std::size_t drones : {2U, 3U, 10U}) {
    constexpr double kRounding = 1e-6;
    const Spare spare = fly_all(problem, margins, true, drones);
    EXPECT_GE(spare.pair_m, -kRounding);
    EXPECT_GE(spare.wall_m, -kRounding);
  }
}

}  // namespace
}  // namespace vigil::runtime
