// How well and at what cost the two controllers cover. Both fly the same problems: 20 seeds of starts (and targets,
// where the mission is the paper's), no faults, an endless memory; the metric halfway and at the end in percent of the
// first.

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "vigil/apps/fleet_choice.hpp"
#include "vigil/core/ergodic/gradient_controller.hpp"
#include "vigil/core/ergodic/look_ahead.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil {
namespace {

constexpr int kSeeds = 20;

struct Problem {
  std::string file;
  std::size_t drones = 0;
  bool draws_targets = false;
};

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all{
      {"paper.yaml", 3, true}, {"paper.yaml", 10, true}, {"lab.yaml", 3, false}, {"wildfire.yaml", 6, false}};
  return all;
}

/// Uniform numbers that every standard library draws alike.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  Vec2 between(const Vec2& low, const Vec2& high) {
    const double x = between(low.x(), high.x());
    return {x, between(low.y(), high.y())};
  }

 private:
  std::mt19937_64 random_;
};

void draw_targets(runtime::Mission& mission, Dice& dice) {
  const Vec2& size = mission.field.size_m;
  const Vec2 spread = Vec2::Constant(0.1 * size.minCoeff());
  mission.targets.clusters.assign(3, {});
  for (std::size_t i = 0; i < 3; ++i) {
    runtime::ClusterEntry& cluster = mission.targets.clusters[i];
    cluster.name = "c" + std::to_string(i);
    const Vec2 mean = mission.field.origin_m + dice.between(0.15 * size, 0.85 * size);
    for (int point = 0; point < 5; ++point) cluster.points_m.emplace_back(mean + dice.between(-spread, spread));
  }
}

bool is_free(const runtime::Mission& mission, std::size_t drone, const Vec2& start) {
  const safety::BarrierParameters barrier = runtime::barrier_parameters(mission);
  for (std::size_t other = 0; other < drone; ++other) {
    if ((mission.drones[other].start_m - start).norm() < 1.05 * safety::barrier_radius(barrier)) return false;
  }
  return std::ranges::all_of(mission.no_fly, [&](const runtime::NoFlyEntry& entry) {
    return field::signed_distance({entry.outline_m}, start) > 1.5 * barrier.no_fly_buffer_m;
  });
}

void draw_starts(runtime::Mission& mission, Dice& dice) {
  const Vec2 margin = Vec2::Constant(1.1 * mission.safety.wall_distance_m);
  const Vec2 low = mission.field.origin_m + margin;
  const Vec2 high = mission.field.origin_m + mission.field.size_m - margin;
  for (std::size_t drone = 0; drone < mission.drones.size(); ++drone) {
    do mission.drones[drone].start_m = dice.between(low, high);
    while (!is_free(mission, drone, mission.drones[drone].start_m));
  }
}

runtime::Mission problem_of(const Problem& problem, ergodic::ControllerKind controller, int seed) {
  runtime::Mission mission = runtime::load_mission(std::string(VIGIL_MISSIONS_DIR "/") + problem.file, {});
  mission.simulation.events.clear();
  mission.simulation.seed = static_cast<std::uint64_t>(seed);
  mission.control.controller = controller;
  mission.control.fade = runtime::ControlSection{}.fade;
  mission.control.memory = runtime::Memory::kEndless;
  mission.control.memory_s.reset();
  mission.safety.barrier = safety::BarrierKind::kLagAware;  // the paper's holds drones half a metre from the walls
  mission.safety.pair_gain.reset();
  mission.safety.wall_gain.reset();
  mission.safety.sensing_range_m.reset();
  mission.safety.wall_range_m.reset();
  while (mission.drones.size() < problem.drones) {
    mission.drones.push_back({.id = "d" + std::to_string(mission.drones.size()), .start_m = Vec2::Zero()});
  }
  Dice dice(static_cast<std::uint64_t>(seed));
  if (problem.draws_targets) draw_targets(mission, dice);
  draw_starts(mission, dice);
  return mission;
}

struct Flown {
  std::vector<double> halfway;
  std::vector<double> end;
  std::uint64_t reversals = 0;  ///< ticks in which a drone was asked to turn by more than a right angle
  double drone_s = 0.0;
  std::uint64_t violations = 0;
};

void fly(const runtime::Mission& mission, Flown& flown) {
  const auto fleet = apps::simulated_fleet(mission);
  runtime::VirtualFlight flight(mission, *fleet, nullptr, [] { return std::chrono::nanoseconds{}; });
  std::vector<Vec2> wanted(mission.drones.size(), Vec2::Zero());
  while (!flight.is_over()) {
    flight.step();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vec2& u_nom = flight.snapshot().drones[i].u_nom;
      if (u_nom.dot(wanted[i]) < 0.0) ++flown.reversals;
      wanted[i] = u_nom;
    }
    if (flight.ticks_flown() == flight.ticks_to_fly() / 2) flown.halfway.push_back(flight.snapshot().metric_percent);
  }
  const runtime::FlightSummary summary = flight.summary();
  flown.end.push_back(summary.last_percent);
  flown.drone_s += summary.duration_s * static_cast<double>(mission.drones.size());
  flown.violations +=
      summary.audit.separation_violations + summary.audit.wall_violations + summary.audit.no_fly_violations;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

void Cover(benchmark::State& state) {
  const Problem& problem = problems()[static_cast<std::size_t>(state.range(0))];
  const auto controller = static_cast<ergodic::ControllerKind>(state.range(1));
  Flown flown;
  for (auto _ : state) {
    flown = {};
    for (int seed = 1; seed <= kSeeds; ++seed) fly(problem_of(problem, controller, seed), flown);
  }
  if (flown.violations > 0) return state.SkipWithError("a drone came too close to something");
  state.SetLabel(problem.file + ", " + std::to_string(problem.drones) + " drones, " +
                 (controller == ergodic::ControllerKind::kGradient ? "gradient" : "look_ahead"));
  state.counters["halfway_median"] = median(flown.halfway);
  state.counters["halfway_worst"] = *std::ranges::max_element(flown.halfway);
  state.counters["end_median"] = median(flown.end);
  state.counters["end_worst"] = *std::ranges::max_element(flown.end);
  state.counters["reversals_per_s"] = static_cast<double>(flown.reversals) / flown.drone_s;
}
BENCHMARK(Cover)->ArgsProduct({{0, 1, 2, 3}, {0, 1}})->Iterations(1)->Unit(benchmark::kSecond);

/// What a tick of steering costs, the decisions included that fall in it: the mean over a simulated second at 50 Hz.
class Steering {
 public:
  explicit Steering(std::size_t drones)
      : departures_(drones), positions_(drones), u_(drones), b_(drones), c_k_(11, 11), a_k_(11, 11) {
    Dice dice(1);
    for (std::size_t i = 0; i < drones; ++i) {
      positions_[i] = dice.between(Vec2(0.2, 0.2), Vec2(2.8, 2.8));
      departures_[i] = {.drone = i, .position = positions_[i]};
    }
    phi_k_.setZero(11, 11);
    phi_k_(0, 0) = 1.0 / basis_.norm()(0, 0);
    look_ahead_ = ergodic::LookAhead(basis_, {.u_max_m_s = 0.3, .dt_s = 0.02}, drones);
    statistics_.add(kernel_, positions_, 1, 0.02);
  }

  void go_down_the_gradient() {
    statistics_.average(c_k_);
    a_k_.array() = basis_.weight().array() * (c_k_ - phi_k_).array();
    kernel_.gradient(positions_, a_k_, b_);
    for (std::size_t i = 0; i < b_.size(); ++i) u_[i] = ergodic::faded_direction(b_[i], 0.3, 1e-3);
  }
  void look_ahead() { look_ahead_.steer(kernel_, statistics_, phi_k_, region_, departures_, u_); }

  [[nodiscard]] bool is_slow_enough() const {
    return std::ranges::all_of(u_, [](const Vec2& u) { return u.norm() <= 0.3 * (1.0 + 1e-12); }) &&
           std::ranges::any_of(u_, [](const Vec2& u) { return u.norm() > 0.0; });
  }

 private:
  ergodic::Basis basis_{{3.0, 3.0}, 10, 1.5};
  ergodic::Kernel kernel_{basis_};
  ergodic::CoverageStatistics statistics_{basis_, ergodic::Accounting::kDroneTime, std::nullopt};
  ergodic::LookAhead look_ahead_{basis_, {.u_max_m_s = 0.3, .dt_s = 0.02}, 1};
  ergodic::AllowedRegion region_{.field = {3.0, 3.0}, .wall_distance_m = 0.17, .no_fly_distance_m = 0.0, .no_fly = {}};
  std::vector<ergodic::Departure> departures_;
  std::vector<Vec2> positions_;
  std::vector<Vec2> u_;
  std::vector<Vec2> b_;
  ergodic::Coefficients phi_k_;
  ergodic::Coefficients c_k_;
  ergodic::Coefficients a_k_;
};

template <void (Steering::*steer)()>
void Steer(benchmark::State& state) {
  Steering steering(static_cast<std::size_t>(state.range(0)));
  (steering.*steer)();
  if (!steering.is_slow_enough()) return state.SkipWithError("the velocities are wrong");
  for (auto _ : state) {
    for (int tick = 0; tick < 50; ++tick) (steering.*steer)();
  }
  state.counters["ticks"] = benchmark::Counter(50.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(Steer<&Steering::go_down_the_gradient>)->Arg(3)->Arg(10)->Arg(100)->Arg(1000);
BENCHMARK(Steer<&Steering::look_ahead>)->Arg(3)->Arg(10)->Arg(100)->Arg(1000);

}  // namespace
}  // namespace vigil
