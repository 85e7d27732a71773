#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "vigil/core/dynamics/failsafe.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/runtime/mission_explanation.hpp"
#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using Notes = std::vector<std::string>;

bool is_paper_barrier(const Mission& mission) { return mission.safety.barrier == safety::BarrierKind::kPaper; }
bool has_lag(const Mission& mission) { return mission.simulation.vehicle.model != dynamics::VehicleKind::kIdeal; }

bool is_first_order(const Mission& mission) {
  return mission.simulation.vehicle.model == dynamics::VehicleKind::kFirstOrderLag;
}

/// Between two of what comes so often, or every tick.
double period_s(const Mission& mission, const std::optional<double>& rate_hz) {
  return rate_hz ? std::max(tick_s(mission), 1.0 / *rate_hz) : tick_s(mission);
}

void note_targets(const Mission& mission, Notes& notes) {
  const field::Importance map = importance(mission);
  if (!map.has_targets()) {
    notes.emplace_back("There is nothing to look at: drones hover until a target is added.");
    return;
  }
  const field::Field field = monitored_field(mission);
  if (field::rasterise(field, map, field::grid_shape(field, map, mission.control.basis_max_index))) return;
  notes.emplace_back(
      "No target can be seen: next to nothing of them is inside the field and outside no-fly polygons. Drones hover.");
}

/// Where less is given than what would have been derived.
void note_below(std::string_view key, const std::optional<double>& given, double derived, Notes& notes) {
  constexpr double kRounding = 0.98;  // `vigil margins` prints few digits
  if (!given || *given >= kRounding * derived) return;
  notes.push_back(
      fmt::format("safety.{} ({:.4g} m) is less than what this vehicle and what it meets need, {:.4g} m: "
                  "separation may be missed by what they cost; `vigil margins` prints the parts.",
                  key, *given, derived));
}

/// What the filter is told of the world, and what the simulated world is.
void note_contradictions(const Mission& mission, Notes& notes) {
  const SafetySection& safety = mission.safety;
  if (safety.vehicle != AssumedVehicle::kSimulated && assumed_vehicle(mission).kind != mission.simulation.vehicle.model)
    notes.emplace_back(
        "safety.vehicle is another one than the simulated one: margins are for a vehicle that does not fly.");
  const double delay_s = simulated_command_delay_s(mission);
  if (safety.command_delay_s && *safety.command_delay_s < delay_s - 2.0 * tick_s(mission)) {
    notes.push_back(
        fmt::format("safety.command_delay_s ({:.4g} s) is less than what orders take, {:.4g} s: drones are "
                    "steered from where they are no more.",
                    *safety.command_delay_s, delay_s));
  }
  const double push_m_s = 3.0 * margin_problem(mission).push_m_s2 * barrier_parameters(mission).lag_s;
  if (push_m_s > 0.5 * mission.control.speed_limit_m_s) {
    notes.push_back(
        fmt::format("Gusts push by up to {:.3g} m/s, against at most {:.3g} m/s of the drones' own: no margin "
                    "makes that safe.",
                    push_m_s, mission.control.speed_limit_m_s));
  }
}

/// A mission that gives values of its own is compared with what they should be for its lag and gains.
void note_margins(const Mission& mission, Notes& notes) {
  const SafetySection& safety = mission.safety;
  const VehicleSection& vehicle = mission.simulation.vehicle;
  if (is_first_order(mission) && safety.lag_s && *safety.lag_s < vehicle.lag_s) {
    notes.push_back(
        fmt::format("safety.lag_s ({} s) is less than the vehicle's lag ({} s): separation is not guaranteed.",
                    *safety.lag_s, vehicle.lag_s));
  }
  note_contradictions(mission, notes);
  if (!safety.margin_m && !safety.pair_margin_m) return;
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  MarginProblem problem = margin_problem(mission);
  problem.given_lag_s = barrier.lag_s;
  problem.given_pair_gain = barrier.pair_gain;
  problem.given_wall_gain = barrier.wall_gain;
  const Margins needed = derive_margins(problem);
  note_below("margin_m", safety.margin_m, needed.wall.total(), notes);
  note_below("pair_margin_m", barrier.pair_margin_m, needed.pair.total(), notes);
}

void note_barrier(const Mission& mission, Notes& notes) {
  if (is_paper_barrier(mission) && has_lag(mission)) {
    notes.emplace_back(
        "The barrier `paper` is safe only for vehicles that follow their velocity at once; this vehicle lags: "
        "expect violations, or take `barrier: lag_aware`.");
  }
  if (!is_paper_barrier(mission)) note_margins(mission, notes);
}

void note_ranges(const Mission& mission, Notes& notes) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  const double derived = safety::derived_sensing_range(barrier);
  if (barrier.sensing_range_m && *barrier.sensing_range_m < derived) {
    notes.push_back(
        fmt::format("safety.sensing_range_m ({:.4g} m) is shorter than the {:.4g} m at which constraints begin to "
                    "matter: they switch on with a jump.",
                    *barrier.sensing_range_m, derived));
  }
  if (mission.safety.obstacles == Obstacles::kActiveOnly) {
    notes.emplace_back("With `obstacles: active_only` a drone that fails in the air is avoided by nobody.");
  }
}

void note_accounting(const Mission& mission, Notes& notes) {
  const ControlSection& control = mission.control;
  if (control.accounting == ergodic::Accounting::kPaperEq14) {
    notes.emplace_back(
        "With `accounting: paper_eq14` the total mass grows with every change of the active set: from then on "
        "drones spread evenly instead of covering their targets.");
  }
  if (control.memory_s && *control.memory_s < mission.field.size_m.sum() / control.speed_limit_m_s) {
    notes.emplace_back(
        "control.memory_s is shorter than it takes to cross the field: coverage is forgotten before it is made.");
  }
}

void note_health(const Mission& mission, Notes& notes) {
  const TrackerSection& tracker = mission.simulation.tracker;
  const LinkSection& link = mission.simulation.link;
  double age = tracker.delay_s + tracker.jitter_s + period_s(mission, tracker.rate_hz);
  if (tracker.over_link) age += link.delay_s + link.jitter_s + period_s(mission, link.rate_hz);
  if (age > mission.health.tracking_timeout_s) {
    notes.push_back(
        fmt::format("Positions are up to {:.3g} s old, health.tracking_timeout_s is {} s: every drone will count as "
                    "lost.",
                    age, mission.health.tracking_timeout_s));
  }
}

bool loses_links(const Mission& mission) {
  return mission.simulation.link.loss > 0.0 ||
         std::ranges::any_of(mission.simulation.events,
                             [](const EventEntry& event) { return event.what == EventKind::kLoseLink; });
}

void note_link(const Mission& mission, Notes& notes) {
  const double period = period_s(mission, mission.simulation.link.rate_hz);
  const double hovers_after = dynamics::failsafe_of(mission.simulation.vehicle.model).hover_after_s;
  if (period >= hovers_after) {
    notes.push_back(
        fmt::format("Orders come every {:.3g} s, and the vehicle takes {:.3g} s of silence for a lost link.", period,
                    hovers_after));
  }
  if (period >= mission.health.link_timeout_s) {
    notes.push_back(
        fmt::format("Drones are heard every {:.3g} s, health.link_timeout_s is {} s: every drone will count as lost.",
                    period, mission.health.link_timeout_s));
  }
  if (std::isinf(hovers_after) && loses_links(mission)) {
    notes.push_back(
        fmt::format("Links are lost, and the model `{}` has no failsafe: a drone out of reach flies its last velocity "
                    "on.",
                    dynamics::name_of(mission.simulation.vehicle.model)));
  }
}

void note_battery(const Mission& mission, Notes& notes) {
  const std::optional<BatterySection>& battery = mission.simulation.battery;
  if (!battery || battery->start >= mission.health.battery_reserve) return;
  notes.push_back(fmt::format("Batteries start at {:.3g}, below health.battery_reserve ({:.3g}): every drone lands.",
                              battery->start, mission.health.battery_reserve));
}

void note_start(const Mission& mission, Notes& notes) {
  const bool takes_off = std::ranges::any_of(mission.simulation.events,
                                             [](const EventEntry& event) { return event.what == EventKind::kTakeOff; });
  if (mission.simulation.start == StartState::kGrounded && !takes_off) {
    notes.emplace_back("Drones start on the ground and no event lets them take off.");
  }
}

void note_overrides(const Mission& mission, Notes& notes) {
  const double limit = mission.control.speed_limit_m_s;
  for (const EventEntry& event : mission.simulation.events) {
    if (event.what != EventKind::kOverride || event.velocity_m_s.norm() <= limit * (1.0 + 1e-9)) continue;
    notes.push_back(
        fmt::format("At {} s a pilot flies {} at {:.3g} m/s, above control.speed_limit_m_s ({} m/s): the others' "
                    "separation from it is not guaranteed, and the flight counts it as too fast.",
                    event.at_s, event.drone, event.velocity_m_s.norm(), limit));
  }
}

}  // namespace

std::vector<std::string> notes_on(const Mission& mission) {
  Notes notes;
  note_targets(mission, notes);
  note_barrier(mission, notes);
  note_ranges(mission, notes);
  note_accounting(mission, notes);
  note_health(mission, notes);
  note_link(mission, notes);
  note_battery(mission, notes);
  note_start(mission, notes);
  note_overrides(mission, notes);
  return notes;
}

}  // namespace vigil::runtime
