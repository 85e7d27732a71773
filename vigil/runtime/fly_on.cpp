#include "vigil/runtime/fly_on.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/flight_audit.hpp"
#include "vigil/runtime/flight_script.hpp"
#include "vigil/runtime/recorded_targets.hpp"

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::CommandKind;

bool is_same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool is_same(const Vec2& a, const Vec2& b) { return is_same(a.x(), b.x()) && is_same(a.y(), b.y()); }
bool is_same(const swarm::DroneObservation& a, const swarm::DroneObservation& b) {
  return is_same(a.position, b.position) && is_same(a.velocity, b.velocity) && is_same(a.height_m, b.height_m) &&
         is_same(a.age_s, b.age_s) && is_same(a.link_age_s, b.link_age_s) && is_same(a.battery, b.battery) &&
         a.mode == b.mode;
}

/// What brings a new controller to what an old one wanted of a drone; nothing where it covers or is on the ground.
std::optional<CommandKind> wish_behind(Activity activity) {
  switch (activity) {
    case Activity::kHeld:
      return CommandKind::kHold;
    case Activity::kTravelling:
      return CommandKind::kGoTo;
    case Activity::kLanding:
      return CommandKind::kLand;
    case Activity::kMarkedFailed:
      return CommandKind::kMarkFailed;
    case Activity::kOverridden:
      return CommandKind::kOverride;
    case Activity::kEmergencyStop:
      return CommandKind::kEmergencyStop;
    default:
      return std::nullopt;
  }
}

/// The flight from a moment on, judged.
class Judged {
 public:
  Judged(const Mission& mission, double from_s, std::optional<double> first_metric)
      : audit_(audit_limits(mission), mission.drones.size()), summary_(mission) {
    summary_.begin_at(from_s, first_metric);
  }

  Clearances add(const swarm::Snapshot& snapshot, std::span<const TruthSample> truth) {
    summary_.add(snapshot, 0.0);
    return audit_.judge(truth, snapshot);
  }
  [[nodiscard]] FlightSummary summary() const { return summary_.finish(audit_.totals(), {}); }

 private:
  FlightAudit audit_;
  SummaryBuilder summary_;
};

class FlyingOn {
 public:
  FlyingOn(ReplayedFlight& flight, const Mission& mission, const ChangedMission& changed, VirtualFleet& fleet)
      : flight_(flight),
        mission_(mission),
        changed_(changed),
        fleet_(fleet),
        script_(mission, fleet),
        observations_(mission.drones.size()),
        orders_(mission.drones.size()),
        places_(mission.drones.size(), Vec2::Zero()),
        snapshot_(mission.drones.size()) {}

  /// The vehicles fly what was recorded, until `number` ticks are behind.
  void repeat(std::uint64_t number) {
    flight_.seek(0);
    while (flight_.number() < number && flight_.step()) {
      expect_recomputed();
      const RecordedTick& tick = flight_.recorded();
      let_happen(tick);
      for (std::size_t i = 0; i < observations_.size(); ++i)
        if (!is_same(observations_[i], tick.observations[i])) refuse_other_world(i);
      if (!first_metric_ && flight_.snapshot().has_metric) first_metric_ = flight_.snapshot().metric;
      obey(tick.snapshot);
    }
  }

  TwoFlights go_on(double from_s, Recorder* recorder) {
    const Mission first = changed_(targets_at(from_s));
    FlightStart start{swarm::Intent::kCover, swarm::SwarmPast{}};
    flight_.state().write_past(*start.past);
    swarm::SwarmState state = state_for(first, start);
    if (recorder != nullptr) recorder->begin(first, start);
    Judged happened(mission_, from_s, first_metric_);
    Judged would_have(first, from_s, first_metric_);
    std::vector<swarm::Command> commands = wishes_so_far();
    commands.push_back({.kind = CommandKind::kSetTarget, .drone = {}, .target = coverage_target(first, state.basis())});
    while (flight_.step()) {
      expect_recomputed();
      const RecordedTick& tick = flight_.recorded();
      happened.add(flight_.snapshot(), tick.truth);
      let_happen(tick);
      add_commands(tick, state.basis(), commands);
      swarm::tick(state, observations_, commands, snapshot_);
      const Clearances clearances = would_have.add(snapshot_, fleet_.truth());
      if (recorder != nullptr) recorder->record({snapshot_, observations_, commands, fleet_.truth(), clearances});
      obey(snapshot_);
      commands.clear();
    }
    return {.from_s = from_s, .happened = happened.summary(), .would_have = would_have.summary()};
  }

 private:
  void expect_recomputed() const {
    if (!flight_.is_recomputed())
      throw std::runtime_error("the recording lacks ticks; nothing can be flown on from it");
  }

  [[noreturn]] void refuse_other_world(std::size_t drone) const {
    throw std::runtime_error(fmt::format(
        "the mission's simulator does not lead to what was recorded: at {:g} s {} is seen elsewhere; only flights that "
        "were simulated from their beginning can be flown on",
        flight_.recorded().snapshot.time_s, mission_.drones[drone].id));
  }

  /// What befalls the vehicles at this tick, whatever the controller does.
  void let_happen(const RecordedTick& tick) {
    const double time_s = tick.snapshot.time_s;
    (void)script_.play(time_s);
    for (const swarm::Command& command : tick.commands) {
      if (command.kind == CommandKind::kGiveBack && command.drone) fleet_.give_back(*command.drone);
      if (command.kind == CommandKind::kGoTo && command.drone && command.drone->index() < places_.size())
        places_[command.drone->index()] = command.place;
    }
    fleet_.observe(mission_time(time_s), observations_);
    time_s_ = time_s;
  }

  void obey(const swarm::Snapshot& snapshot) {
    std::ranges::transform(snapshot.drones, orders_.begin(), &swarm::DroneSnapshot::order);
    fleet_.order(mission_time(time_s_), orders_);
    fleet_.advance(flight_.recording().head().parameters.dt_s);
  }

  [[nodiscard]] swarm::SwarmState state_for(const Mission& mission, const FlightStart& start) const {
    swarm::SwarmState state(swarm_parameters(mission, start));
    const swarm::SwarmParameters& before = flight_.recording().head().parameters;
    const bool fits = state.parameters().drones == before.drones && is_same(state.parameters().dt_s, before.dt_s) &&
                      mission.field == mission_.field && state.read_past(*start.past);
    if (!fits)
      throw std::invalid_argument(
          "field, drones, control.rate_hz and control.basis_max_index hold for a whole flight: what was covered so far "
          "depends on them; simulate the mission with them from its beginning");
    return state;
  }

  [[nodiscard]] Mission targets_at(double time_s) const {
    return mission_at(mission_, flight_.recording().targets(), time_s);
  }

  [[nodiscard]] std::vector<swarm::Command> wishes_so_far() const {
    std::vector<swarm::Command> wishes;
    for (std::size_t i = 0; i < places_.size() && flight_.number() > 0; ++i)
      if (const auto kind = wish_behind(flight_.snapshot().drones[i].activity))
        wishes.push_back({.kind = *kind, .drone = swarm::DroneId(i), .place = places_[i], .target = {}});
    return wishes;
  }

  /// What operators did at this tick; new targets after the change.
  void add_commands(const RecordedTick& tick, const ergodic::Basis& basis, std::vector<swarm::Command>& commands) {
    for (swarm::Command command : tick.commands) {
      if (command.kind == CommandKind::kSetTarget)
        command.target = coverage_target(changed_(targets_at(tick.snapshot.time_s)), basis);
      commands.push_back(std::move(command));
    }
  }

  ReplayedFlight& flight_;
  const Mission& mission_;
  const ChangedMission& changed_;
  VirtualFleet& fleet_;
  FlightScript script_;
  std::vector<swarm::DroneObservation> observations_;
  std::vector<swarm::DroneOrder> orders_;
  std::vector<Vec2> places_;  ///< where each drone was last sent
  swarm::Snapshot snapshot_;
  double time_s_ = 0.0;
  std::optional<double> first_metric_;  ///< of the flight, where it came before the change
};

}  // namespace

TwoFlights fly_on(ReplayedFlight& flight, const Mission& mission, const ChangedMission& changed, double from_s,
                  VirtualFleet& fleet, Recorder* recorder) {
  const double dt_s = flight.recording().head().parameters.dt_s;
  if (flight.recording().head().keep_every > 1 || flight.recording().head().start.past)
    throw std::runtime_error("only a recording of every tick, from the mission's beginning, can be flown on");
  const auto number = static_cast<std::uint64_t>(std::llround(std::clamp(from_s / dt_s, 0.0, 1e15)));
  if (number >= flight.tick_count())
    throw std::invalid_argument(fmt::format("{:g} s: the recording ends at {:g} s; the moment must lie before that",
                                            from_s, static_cast<double>(flight.tick_count()) * dt_s));
  FlyingOn flying(flight, mission, changed, fleet);
  flying.repeat(number);
  return flying.go_on(static_cast<double>(number) * dt_s, recorder);
}

}  // namespace vigil::runtime
