#include "vigil/swarm/tick.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "vigil/core/ergodic/gradient_controller.hpp"
#include "vigil/core/safety/barrier.hpp"
#include "vigil/swarm/guidance_parameters.hpp"

namespace vigil::swarm {
namespace {

CoverageTarget no_target(const ergodic::Basis& basis) {
  CoverageTarget target;
  target.phi_k = ergodic::Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis());
  target.no_fly.reserve(kMaxNoFlyEdges);
  return target;
}

ergodic::LookAheadParameters look_ahead_parameters(const SwarmParameters& parameters) {
  ergodic::LookAheadParameters result;
  result.u_max_m_s = parameters.barrier.u_max_m_s;
  result.lag_s = parameters.barrier.lag_s;
  result.dt_s = parameters.dt_s;
  result.horizon_s = parameters.look_ahead_s;
  return result;
}

bool looks_ahead(const SwarmParameters& parameters) {
  return parameters.controller == ergodic::ControllerKind::kLookAhead;
}

/// A drone that was seen longer ago is not steered any more.
double longest_prediction_s(const SwarmParameters& parameters) {
  return std::min(parameters.health.tracking_timeout_s + parameters.command_delay_s, kLongestPredictionS);
}

WatchSetup watch_setup(const SwarmParameters& parameters) {
  return {.parameters = parameters.faults,
          .field = parameters.field,
          .dt_s = parameters.dt_s,
          .command_delay_s = parameters.command_delay_s,
          .observation_delay_s = parameters.observation_delay_s,
          .health = parameters.health};
}

bool fits(const CoverageTarget& target, const ergodic::Basis& basis) {
  const bool has_shape =
      target.phi_k.rows() == basis.indices_per_axis() && target.phi_k.cols() == basis.indices_per_axis();
  const bool has_protected_shape =
      target.protected_k.size() == 0 ||
      (target.protected_k.rows() == target.phi_k.rows() && target.protected_k.cols() == target.phi_k.cols());
  const bool is_usable = has_shape && target.phi_k.allFinite() && has_protected_shape && target.protected_k.allFinite();
  return target.no_fly.size() <= kMaxNoFlyEdges && (!target.has_targets || is_usable);
}

bool are_equal(const field::Segment& one, const field::Segment& other) { return one.a == other.a && one.b == other.b; }

/// As many bodies as the filter may meet: where drones are watched, each may have a second place.
std::size_t most_bodies(const SwarmParameters& parameters) {
  return parameters.faults.watches ? 2 * parameters.drones : parameters.drones;
}

/// Has a place to go to, or waits there.
bool travels(const DroneMemory& drone) {
  return drone.activity == Activity::kTravelling || drone.activity == Activity::kReturning;
}

/// Small swarms never meet a second thread.
std::size_t threads_worth(std::size_t parts) { return parts > 1 ? parallel::kMostThreads : 1; }

}  // namespace

SwarmState::SwarmState(const SwarmParameters& parameters)
    : parameters_(parameters),
      basis_(parameters.field, parameters.basis_max_index, parameters.basis_smoothness),
      kernels_(threads_worth(parts_of(parameters.drones)), ergodic::Kernel(basis_)),
      sums_(basis_, parameters.drones),
      statistics_(basis_, parameters.accounting, parameters.memory_s),
      look_ahead_(basis_, look_ahead_parameters(parameters), looks_ahead(parameters) ? parameters.drones : 0),
      goal_seeker_(seeker_parameters(parameters), parameters.drones),
      ways_(way_parameters(parameters), parameters.drones),
      filter_(parameters.barrier, parameters.field, most_bodies(parameters)),
      air_(parameters.field, safety::barrier_radius(parameters.barrier), parameters.drones),
      flown_(parameters.drones, parameters.dt_s, longest_prediction_s(parameters)),
      monitor_(watch_setup(parameters), parameters.drones),
      recharging_(parameters),
      target_(no_target(basis_)),
      protection_(basis_),
      drones_(parameters.drones),
      notes_(parts_of(parameters.drones)),
      activities_before_(parameters.drones),
      motions_(parameters.drones),
      seen_ages_(parameters.drones, DroneObservation::kNever),
      bodies_(parameters.drones),
      u_nom_(parameters.drones, Vec2::Zero()),
      u_(parameters.drones, Vec2::Zero()),
      reports_(parameters.drones),
      c_k_(target_.phi_k),
      a_k_(target_.phi_k) {
  for (DroneMemory& drone : drones_) {
    drone.intent = parameters.first_intent;
    if (recharging_.has_pads() && parameters.recharge.endurance_s)
      drone.energy = EnergyEstimate(*parameters.recharge.endurance_s);
  }
  for (std::size_t index = 0; index < parameters.starts.size(); ++index) {
    drones_[index].is_expected = true;
    drones_[index].last_good.position = parameters.starts[index];
    motions_[index].position = parameters.starts[index];
  }
  bodies_.reserve(most_bodies(parameters));
  doubted_.reserve(most_bodies(parameters) - parameters.drones);
  active_.reserve(parameters.drones);
  active_before_.reserve(parameters.drones);
  active_positions_.reserve(parameters.drones);
  if (looks_ahead(parameters)) departures_.reserve(parameters.drones);
  if (looks_ahead(parameters)) active_u_.reserve(parameters.drones);
  travellers_.reserve(parameters.drones);
  travel_u_.reserve(parameters.drones);
}

void SwarmState::write_past(SwarmPast& out) const {
  out.ticks = ticks_;
  out.first_metric = first_metric_;
  out.has_first_metric = has_first_metric_;
  statistics_.write(out.coverage);
}

bool SwarmState::read_past(const SwarmPast& past) {
  if (!std::isfinite(past.first_metric) || !statistics_.read(past.coverage)) return false;
  ticks_ = past.ticks;
  first_metric_ = past.first_metric;
  has_first_metric_ = past.has_first_metric;
  return true;
}

Motion SwarmState::next_motion(DroneId drone) const noexcept {
  return flown_.ahead(drone.index(), motions_[drone.index()], parameters_.dt_s, parameters_.barrier.lag_s);
}

void SwarmState::become_model(double dt_s) {
  parameters_.dt_s = dt_s;
  parameters_.barrier.dt_s = dt_s;
  parameters_.command_delay_s = 0.0;
  parameters_.observation_delay_s = 0.0;
  look_ahead_.set_tick(dt_s);
  goal_seeker_.set_tick(dt_s);
  recharging_.set_tick(dt_s);
  filter_ = safety::Filter(parameters_.barrier, parameters_.field, most_bodies(parameters_));
  flown_ = FlownOrders(parameters_.drones, dt_s, longest_prediction_s(parameters_));
  monitor_ = FaultMonitor({}, 0);
}

void SwarmState::set_target(const CoverageTarget& target) noexcept {
  if (target.has_targets)
    target_.phi_k = target.phi_k;
  else
    target_.phi_k.setZero();
  target_.has_targets = target.has_targets;
  protection_.retarget(target_.phi_k, target.protected_k);
  const bool is_same_ground = std::ranges::equal(target_.no_fly, target.no_fly, are_equal);
  target_.no_fly.assign(target.no_fly.begin(), target.no_fly.end());
  if (!is_same_ground) ways_.ground_changed(target_.no_fly);
  fade_delta_ = parameters_.fade * ergodic::gradient_scale(basis_, target_.phi_k);
  look_ahead_.targets_changed();
}

void SwarmState::take_wish(const Command& command, Snapshot& out) noexcept {
  const auto wish = [&](std::size_t index) {
    const bool is_possible = command.kind != CommandKind::kGoTo || may_be_flown_to(command.place);
    const bool accepted = is_possible && apply_wish(drones_[index], command.kind, command.place);
    Event event{.kind = accepted ? EventKind::kWishAccepted : EventKind::kWishRefused, .drone = DroneId(index)};
    event.wish = command.kind;
    out.note(event);
  };
  if (!command.drone) {
    for (std::size_t index = 0; index < drones_.size(); ++index) wish(index);
  } else if (command.drone->index() < drones_.size()) {
    wish(command.drone->index());
  } else {
    Event event{.kind = EventKind::kWishRefused, .drone = *command.drone};
    event.wish = command.kind;
    out.note(event);
  }
}

void SwarmState::take_commands(std::span<const Command> commands, Snapshot& out) noexcept {
  for (const Command& command : commands) {
    if (command.kind == CommandKind::kSetTarget) {
      const bool usable = command.target != nullptr && fits(*command.target, basis_);
      if (usable) set_target(*command.target);
      Event event{.kind = usable ? EventKind::kTargetChanged : EventKind::kWishRefused};
      event.wish = command.kind;
      out.note(event);
    } else if (command.kind == CommandKind::kStartAfresh) {
      statistics_.reset();
      protection_.start_afresh();
      has_first_metric_ = false;
      look_ahead_.decide_at_once();
      out.note({.kind = EventKind::kStartedAfresh});
    } else {
      take_wish(command, out);
    }
  }
}

const DroneObservation& SwarmState::believed(std::size_t index,
                                             std::span<const DroneObservation> observations) const noexcept {
  return monitor_.watches() ? monitor_.believed(index) : observations[index];
}

bool SwarmState::is_any(bool PartNote::* what) const noexcept {
  return std::any_of(notes_.begin(), notes_.end(), [&](const PartNote& note) { return note.*what; });
}

void SwarmState::judge_drones(std::span<const DroneObservation> observations, bool are_remembered, Snapshot& out,
                              parallel::Workers* workers) noexcept {
  std::fill(notes_.begin(), notes_.end(), PartNote{});
  for_each_drone(workers, [&](std::size_t index, PartNote& note) {
    DroneMemory& drone = drones_[index];
    if (!are_remembered) remember(drone, believed(index, observations), parameters_.dt_s);
    activities_before_[index] = drone.activity;
    const Fault fault_before = drone.fault;
    if (monitor_.watches()) drone.fault = monitor_.report(index).kind;
    drone.has_new_fault = drone.fault != Fault::kNone && drone.fault != fault_before;
    judge(drone, parameters_.health, parameters_.dt_s);
    drone.wants_up_s = wants_up(drone) ? drone.wants_up_s + static_cast<float>(parameters_.dt_s) : 0.0F;
    predict(index);
    note.has_change = note.has_change || drone.activity != activities_before_[index] || drone.has_new_fault;
    note.active += drone.activity == Activity::kActive ? 1 : 0;
    note.has_traveller = note.has_traveller || travels(drone);
    note.has_starter = note.has_starter || wants_up(drone);
  });
  if (!is_any(&PartNote::has_change)) return;
  for (std::size_t index = 0; index < drones_.size(); ++index) {
    const Activity before = activities_before_[index];
    const Activity after = drones_[index].activity;
    if (after == before && !drones_[index].has_new_fault) continue;
    Event event{.kind = EventKind::kActivityChanged, .drone = DroneId(index), .before = before, .after = after};
    if (after == before) event.kind = EventKind::kFaultNoticed;
    event.fault = drones_[index].fault;
    out.note(event);
  }
}

bool SwarmState::may_be_flown_to(const Vec2& place) const noexcept {
  return place.allFinite() && parameters_.field.contains(place) && !safety::is_enclosed(target_.no_fly, place);
}

/// As close to a place as the walls allow.
Vec2 SwarmState::within_walls(const Vec2& place) const noexcept {
  const safety::BarrierParameters& barrier = parameters_.barrier;
  const double reach_m = barrier.wall_distance_m + safety::wall_reserve(barrier, {});
  const Vec2 size(parameters_.field.length_x, parameters_.field.length_y);
  const Vec2 least = Vec2::Constant(reach_m).cwiseMin(0.5 * size);
  return place.cwiseMax(least).cwiseMin(size - least);
}

/// What observations and orders take is made up for by what was ordered meanwhile, also of a drone that is steered no
/// more: what was ordered before is still on its way to it. While nothing new is seen of it, it is where its orders
/// lead. A pilot's drone follows no orders, one that says that it failed stops, and the paper's barrier knows of no
/// delay.
void SwarmState::predict(std::size_t index) noexcept {
  const DroneObservation& known = drones_[index].last_good;
  const double aged_s = seen_ages_[index] + parameters_.dt_s;
  const double rounding_s = 0.5 * parameters_.dt_s;
  // What turns out to be older than it was said to be is news, too.
  const bool is_new = known.age_s < aged_s - rounding_s || known.age_s > aged_s + rounding_s;
  seen_ages_[index] = known.age_s;
  const Motion seen{known.position, known.velocity};
  const bool is_paper = parameters_.barrier.kind == safety::BarrierKind::kPaper;
  const double lag_s = parameters_.barrier.lag_s;
  Motion ahead = seen;
  const Activity activity = drones_[index].activity;
  if (!is_paper && activity == Activity::kVehicleFailed) {
    ahead = {seen.position + lag_s * seen.velocity, Vec2::Zero()};
  } else if (activity == Activity::kNotFollowing) {
    ahead.position += known.age_s * seen.velocity;
  } else if (!is_paper && activity != Activity::kOverridden) {
    ahead = is_new ? flown_.ahead(index, seen, known.age_s + parameters_.command_delay_s, lag_s)
                   : flown_.ahead(index, motions_[index], parameters_.dt_s, lag_s);
  }
  const bool is_finite = ahead.position.allFinite() && ahead.velocity.allFinite();
  motions_[index] = is_finite ? ahead : seen;
}

/// I_a(t) of (13).
void SwarmState::gather_active(parallel::Workers* workers) noexcept {
  std::size_t count = 0;
  for (PartNote& note : notes_) {
    note.first_active = count;
    count += note.active;
  }
  const bool has_departures = looks_ahead(parameters_);
  active_before_.swap(active_);
  active_.resize(count);  // all within their capacities
  active_positions_.resize(count);
  departures_.resize(has_departures ? count : 0);
  for_each_drone(workers, [&](std::size_t index, PartNote& note) {
    u_nom_[index].setZero();
    if (drones_[index].activity != Activity::kActive) return;
    const std::size_t at = note.first_active++;
    active_[at] = static_cast<std::uint32_t>(index);
    active_positions_[at] = drones_[index].last_good.position;
    if (has_departures)
      departures_[at] = {.drone = index, .position = motions_[index].position, .velocity = motions_[index].velocity};
  });
  if (active_ != active_before_) ++active_set_;
}

void SwarmState::measure_coverage(Snapshot& out, parallel::Workers* workers) noexcept {
  const auto add_basis = [&](double weight, ergodic::Coefficients& sum_k) {
    sums_.add(kernels_, active_positions_, weight, sum_k, workers);
  };
  // Hovering for want of targets is no coverage: it would weigh on the statistics of the targets to come.
  if (target_.has_targets) statistics_.add_by(add_basis, active_.size(), active_set_, parameters_.dt_s);
  statistics_.average(c_k_);
  const double remembered = statistics_.share_of_newest(parameters_.dt_s, active_.size());
  protection_.follow(active_.size(), drones_.size(), parameters_.dt_s, remembered);
  out.protection = protection_.share();

  out.has_metric = target_.has_targets && statistics_.has_samples();
  out.metric = out.has_metric ? ergodic::ergodic_metric(basis_, c_k_, protection_.asked_k()) : 0.0;  // (4)
  if (out.has_metric && !has_first_metric_) {
    first_metric_ = out.metric;
    has_first_metric_ = true;
  }
  out.metric_percent = out.has_metric && first_metric_ > 0.0 ? 100.0 * out.metric / first_metric_ : 0.0;
}

void SwarmState::go_down_the_gradient(parallel::Workers* workers) noexcept {
  a_k_.array() = basis_.weight().array() * (c_k_ - protection_.asked_k()).array();  // lambda_k (c_k - phi_k)
  const auto steer = [&](std::size_t first, std::size_t last, std::size_t thread) {
    std::array<Vec2, kPart> slopes;
    const std::span<const Vec2> positions = std::span(active_positions_).subspan(first, last - first);
    kernels_[thread].gradient(positions, a_k_, std::span(slopes).first(positions.size()));  // (7)
    for (std::size_t i = first; i < last; ++i)                                              // (9)
      u_nom_[active_[i]] = ergodic::faded_direction(slopes[i - first], parameters_.barrier.u_max_m_s, fade_delta_);
  };
  parallel::for_each_part(workers, active_.size(), kPart, steer);
}

void SwarmState::look_ahead() noexcept {
  const safety::BarrierParameters& barrier = parameters_.barrier;
  const double reserve_m = safety::wall_reserve(barrier, {});
  const ergodic::AllowedRegion region{.field = parameters_.field,
                                      .wall_distance_m = barrier.wall_distance_m + reserve_m,
                                      .no_fly_distance_m = safety::no_fly_radius(barrier, reserve_m),
                                      .no_fly = target_.no_fly};
  active_u_.resize(active_.size());  // within its capacity
  look_ahead_.steer(kernels_[0], statistics_, protection_.asked_k(), region, departures_, active_u_);
  for (std::size_t i = 0; i < active_.size(); ++i) u_nom_[active_[i]] = active_u_[i];
}

void SwarmState::cover(Snapshot& out, parallel::Workers* workers) noexcept {
  out.active = active_.size();
  out.idle = !target_.has_targets ? Idle::kNoTargets : active_.empty() ? Idle::kNoActiveDrone : Idle::kNone;
  measure_coverage(out, workers);
  if (out.idle != Idle::kNone) return;

  if (looks_ahead(parameters_))
    look_ahead();
  else
    go_down_the_gradient(workers);
}

/// Round no-fly polygons, by the point that the filter keeps clear of them.
guidance::Traveller SwarmState::traveller(std::size_t index) noexcept {
  const Motion& motion = motions_[index];
  const Vec2 goal = within_walls(drones_[index].place);
  const Vec2 next = ways_.next(index, safety::barrier_point(parameters_.barrier, body_of(index)), goal);
  return {.drone = index,
          .position = motion.position,
          .velocity = motion.velocity,
          .goal = next,
          .flown = u_[index],
          .passes = next != goal};
}

/// Whoever has a place to go to, whether or not anything is to be covered.
void SwarmState::seek_goals() noexcept {
  travellers_.clear();
  if (!is_any(&PartNote::has_traveller)) return;
  ways_.begin_tick(static_cast<std::size_t>(std::count_if(drones_.begin(), drones_.end(), travels)));
  for (std::size_t index = 0; index < drones_.size(); ++index) {
    if (!travels(drones_[index])) continue;
    travellers_.push_back(traveller(index));
  }
  travel_u_.resize(travellers_.size());  // within its capacity
  goal_seeker_.steer(travellers_, travel_u_);
  for (std::size_t i = 0; i < travellers_.size(); ++i) u_nom_[travellers_[i].drone] = travel_u_[i];
}

void SwarmState::write_order(std::size_t index, DroneSnapshot& to) noexcept {
  const DroneMemory& drone = drones_[index];
  Action action = action_for(drone);
  if (action != Action::kVelocity || !is_steered(drone.activity)) u_[index].setZero();
  if (action == Action::kTakeOff && !has_clear_air(index)) action = Action::kNone;
  to.position = drone.last_good.position;
  to.velocity = drone.last_good.velocity;
  to.height_m = drone.last_good.height_m;
  to.age_s = drone.last_good.age_s;
  to.link_age_s = drone.last_good.link_age_s;
  to.battery = drone.last_good.battery;
  to.time_left = drone.energy.time_to(parameters_.health.battery_reserve);
  to.mode = drone.last_good.mode;
  to.activity = drone.activity;
  to.fault = monitor_.watches() ? monitor_.report(index) : FaultReport{};
  to.is_obstacle = bodies_[index].is_obstacle;
  to.u_nom = u_nom_[index];
  to.order.action = action;
  to.order.velocity = u_[index];
  to.filter = reports_[index];
  if (!recharging_.has_pads()) return;
  to.pad = recharging_.pad_of(index);
  to.leaves_in_s = recharging_.leaves_in_s(index);
  to.away_for_s = recharging_.away_for_s(index);
}

void SwarmState::write_orders(Snapshot& out, parallel::Workers* workers) noexcept {
  const std::span<Vec2> flown = flown_.begin_tick();
  if (is_any(&PartNote::has_starter)) sort_air(workers);
  for_each_drone(workers, [&](std::size_t index, PartNote& note) {
    write_order(index, out.drones[index]);
    flown[index] = u_[index];
    note.has_fallback = note.has_fallback || reports_[index].fallback;
  });
  out.fallback = is_any(&PartNote::has_fallback);
}

void tick(SwarmState& state, std::span<const DroneObservation> observations, std::span<const Command> commands,
          Snapshot& out, parallel::Workers* workers) noexcept {
  assert(observations.size() == state.drones_.size() && out.drones.size() == state.drones_.size());
  out.tick = state.ticks_;
  out.time_s = static_cast<double>(state.ticks_) * state.parameters_.dt_s;
  out.events.clear();
  out.lost_events = 0;
  if (state.monitor_.watches()) state.monitor_.look(observations, state.drones_, state.motions_, state.flown_);
  const bool is_told = !commands.empty();  // a wish is judged by the newest observation
  if (is_told) {
    for (std::size_t index = 0; index < observations.size(); ++index)
      remember(state.drones_[index], state.believed(index, observations), state.parameters_.dt_s);
    state.take_commands(commands, out);
  }
  state.recharging_.decide({state.drones_, state.u_, state.ways_, state.ticks_}, out);
  state.judge_drones(observations, is_told, out, workers);
  state.gather_active(workers);
  state.cover(out, workers);
  state.seek_goals();
  state.recharging_.make_way(state.drones_, state.u_nom_);
  state.keep_safe(workers);
  state.write_orders(out, workers);
  ++state.ticks_;
}

}  // namespace vigil::swarm
