#include "vigil/runtime/preview_honesty.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "vigil/core/field/seen_map.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/preview.hpp"
#include "vigil/runtime/random_mission.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::runtime {
namespace {

/// Watches the areas of a flight, tick by tick.
class Observer {
 public:
  Observer(const Mission& mission, const VirtualFlight& flight)
      : flight_(flight), footprint_m_(footprint_radius_m(mission)), c_k_(flight.state().target().phi_k) {
    const ergodic::Basis& basis = flight.state().basis();
    watch_.retarget(mission, basis, *coverage_target(mission, basis), 0.0);
  }

  void look() {
    places_.clear();
    for (const swarm::DroneSnapshot& drone : flight_.snapshot().drones)
      if (drone.activity == swarm::Activity::kActive) places_.push_back(drone.position);
    (void)watch_.see(places_, footprint_m_, time_s());
  }

  [[nodiscard]] std::vector<AreaState> states() {
    flight_.state().statistics().average(c_k_);
    return watch_.states(c_k_, time_s(), flight_.state().protection());
  }

  [[nodiscard]] double time_s() const { return flight_.snapshot().time_s; }
  [[nodiscard]] const AreaWatch& watch() const { return watch_; }

 private:
  const VirtualFlight& flight_;
  AreaWatch watch_;
  double footprint_m_;
  ergodic::Coefficients c_k_;
  std::vector<Vec2> places_;
};

bool is_covered(const AreaState& state) { return state.asked > 0.0 && state.achieved >= kCoveredShare * state.asked; }

const AreaState& state_of(const std::vector<AreaState>& states, const TargetName& what) {
  return *std::find_if(states.begin(), states.end(), [&](const AreaState& one) { return one.what == what; });
}

std::vector<AreaOutlook> foreseen(const Mission& mission, const VirtualFlight& flight, const AreaWatch& watch,
                                  double seconds) {
  const std::atomic<bool> never{false};
  const PreviewStart start{flight.state(), watch, predicted_vehicle(mission, flight.state().parameters().barrier.lag_s),
                           footprint_radius_m(mission)};
  return look_into_future(start, {}, seconds, never)->areas;
}

void note(const std::vector<AreaState>& states, double in_s, std::vector<AreaPromise>& promises) {
  for (AreaPromise& promise : promises) {
    const AreaState& state = state_of(states, promise.what);
    if (!promise.covered.was_s && is_covered(state)) promise.covered.was_s = in_s;
    if (!promise.seen.was_s && state.age_s <= in_s) promise.seen.was_s = in_s;
  }
}

}  // namespace

std::optional<double> relative_error(const Promise& promise) {
  if (!promise.foreseen_s && !promise.was_s) return std::nullopt;
  if (!promise.foreseen_s || !promise.was_s) return std::numeric_limits<double>::infinity();
  return std::abs(*promise.foreseen_s - *promise.was_s) / *promise.was_s;
}

std::vector<AreaPromise> promises_of(const Mission& mission, const MakeWorld& make_world, double from_s,
                                     double seconds) {
  const std::unique_ptr<VirtualFleet> world = make_world(mission);
  VirtualFlight flight(mission, *world, nullptr, [] { return std::chrono::nanoseconds{}; });
  Observer observer(mission, flight);
  do {
    flight.step();
    observer.look();
  } while (observer.time_s() < from_s);
  const double now_s = observer.time_s();
  std::vector<AreaPromise> promises;
  const std::vector<AreaState> now = observer.states();
  for (const AreaOutlook& area : foreseen(mission, flight, observer.watch(), seconds))
    if (!is_covered(state_of(now, area.what)))
      promises.push_back({area.what, {area.covered_in_s, std::nullopt}, {area.seen_in_s, std::nullopt}});
  while (observer.time_s() < now_s + seconds) {
    flight.step();
    observer.look();
    note(observer.states(), observer.time_s() - now_s, promises);
  }
  return promises;
}

Mission faultless_mission(std::uint64_t seed) {
  constexpr int kMostIndex = 20;
  constexpr double kLeastRateHz = 10.0;
  Mission mission = random_mission(seed);
  SimulationSection& simulation = mission.simulation;
  simulation.start = StartState::kFlying;
  simulation.events.clear();
  simulation.goals.reset();
  simulation.battery.reset();
  simulation.link.loss = 0.0;
  simulation.tracker.dropouts_per_min = 0.0;
  simulation.tracker.swaps_per_h = 0.0;
  for (std::optional<double>* rate : {&simulation.link.rate_hz, &simulation.tracker.rate_hz})
    if (*rate) *rate = std::max(kLeastRateHz, **rate);
  mission.health.tracking_timeout_s = std::max(0.5, mission.health.tracking_timeout_s);
  mission.health.link_timeout_s = std::max(0.5, mission.health.link_timeout_s);
  mission.control.basis_max_index = std::min(kMostIndex, mission.control.basis_max_index);
  return mission;
}

std::vector<HonestyCase> honesty_cases(std::size_t missions, const MakeWorld& make_world) {
  constexpr double kFromS = 2.0;
  constexpr double kSeconds = 60.0;
  std::vector<HonestyCase> cases;
  for (std::uint64_t seed = 1; cases.size() < missions; ++seed) {
    Mission mission = faultless_mission(seed);
    std::vector<AreaPromise> promises = promises_of(mission, make_world, kFromS, kSeconds);
    if (!promises.empty()) cases.push_back({seed, std::move(mission), std::move(promises)});
  }
  return cases;
}

double median_error(const std::vector<HonestyCase>& cases, Promise AreaPromise::* which) {
  std::vector<double> errors;
  for (const HonestyCase& one : cases)
    for (const AreaPromise& promise : one.promises)
      if (const std::optional<double> error = relative_error(promise.*which)) errors.push_back(*error);
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

}  // namespace vigil::runtime
