#include "vigil/runtime/live_flight.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using swarm::CommandKind;

/// Most commands that a script gives in one tick are one per drone and event.
constexpr std::size_t kScriptEventsATick = 4;

bool concerns_drones(CommandKind kind) { return kind != CommandKind::kSetTarget && kind != CommandKind::kStartAfresh; }

}  // namespace

LiveFlight::LiveFlight(const Mission& mission, Fleet& fleet, VirtualFleet* world, Recorder* recorder,
                       const FlightStart& start, parallel::Workers* workers)
    : fleet_(fleet),
      world_(world),
      recorder_(recorder),
      workers_(workers),
      state_(swarm_parameters(mission, start)),
      standing_(start.standing),
      observations_(mission.drones.size()),
      orders_(mission.drones.size()) {
  commands_.reserve((kScriptEventsATick + 2) * mission.drones.size() + 64);
  if (world != nullptr) {
    script_.emplace(mission, *world);
    audit_.emplace(audit_limits(mission), mission.drones.size());
    if (mission.simulation.goals) {
      goals_.emplace(mission);
      last_.emplace(mission.drones.size());
    }
  }
  if (start.past && state_.read_past(*start.past) && script_)
    script_->skip_to(static_cast<double>(state_.ticks()) * dt_s());
}

std::size_t LiveFlight::events_of(const LiveCommand& command) const noexcept {
  return concerns_drones(command.swarm.kind) && !command.swarm.drone ? observations_.size() : 1;
}

void LiveFlight::play_script(double time_s, Outbox<LiveEvent>& outbox) noexcept {
  commands_.clear();
  if (!script_) return;
  std::size_t next = script_->played();
  DueEvents due = script_->play(time_s);
  for (swarm::Command& command : due.commands)
    if (commands_.size() < commands_.capacity()) commands_.push_back(std::move(command));
  if (recorder_ != nullptr)
    for (const LoggedEvent& event : due.log) recorder_->log(event);
  for (; next < script_->played(); ++next) {
    LiveEvent told;
    told.kind = LiveEvent::Kind::kScript;
    told.tick = state_.ticks();
    told.time_s = time_s;
    told.index = next;
    outbox.note(told);
  }
  if (goals_) goals_->play(*last_, commands_);
}

void LiveFlight::gather(std::span<const LiveCommand> commands) noexcept {
  standing_.give(observations_, commands_);
  script_commands_ = commands_.size();
  for (const LiveCommand& command : commands) {
    assert(command.kind == LiveCommand::Kind::kSwarm);
    if (commands_.size() == commands_.capacity()) return;
    commands_.push_back(command.swarm);
    if (command.swarm.kind == CommandKind::kSetTarget) revision_ = command.revision;
    if (concerns_drones(command.swarm.kind)) {
      standing_.replaced_by(command.swarm);
      newest_order_ = std::max(newest_order_, command.ticket);
    }
    // In a simulated world the pilot who gives a drone back is the one at the console.
    if (command.swarm.kind == CommandKind::kGiveBack && command.swarm.drone && world_ != nullptr)
      world_->give_back(*command.swarm.drone);
  }
}

/// The tick answers commands in their order, before anything else.
void LiveFlight::tell(std::span<const LiveCommand> commands, const swarm::Snapshot& snapshot,
                      Outbox<LiveEvent>& outbox) noexcept {
  LiveEvent told;
  told.tick = snapshot.tick;
  told.time_s = snapshot.time_s;
  told.revision = revision_;
  told.active = snapshot.active;
  auto next = snapshot.events.begin();
  const auto tell_event = [&](LiveEvent::Kind kind, const swarm::Event& event) {
    told.kind = kind;
    told.event = event;
    if (event.drone.index() < snapshot.drones.size()) told.drone = snapshot.drones[event.drone.index()];
    outbox.note(told);
  };
  for (std::size_t n = 0; n < script_commands_; ++n)
    for (std::size_t left = commands_[n].drone || !concerns_drones(commands_[n].kind) ? 1 : snapshot.drones.size();
         left > 0 && next != snapshot.events.end(); --left)
      tell_event(LiveEvent::Kind::kSwarm, *next++);

  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (const LiveCommand& command : commands) {
    told.ticket = command.ticket;
    for (std::size_t left = events_of(command); left > 0 && next != snapshot.events.end(); --left, ++next) {
      const bool is_refused = next->kind == swarm::EventKind::kWishRefused;
      ++(is_refused ? refused : accepted);
      if (is_refused) tell_event(LiveEvent::Kind::kRefusal, *next);
    }
    if (!command.is_last_of_ticket) continue;
    told.kind = LiveEvent::Kind::kAnswer;
    told.accepted = std::exchange(accepted, 0);
    told.refused = std::exchange(refused, 0);
    if (told.ticket != 0) outbox.note(told);
  }
  told.ticket = 0;
  for (; next != snapshot.events.end(); ++next) tell_event(LiveEvent::Kind::kSwarm, *next);
}

void LiveFlight::judge_and_record(const swarm::Snapshot& snapshot) noexcept {
  if (goals_) {
    goals_->watch(world_->truth(), snapshot, snapshot.time_s);
    last_ = snapshot;
  }
  if (recorder_ == nullptr) return;
  if (audit_) {
    const Clearances clearances = audit_->judge(world_->truth(), snapshot);
    recorder_->record({snapshot, observations_, commands_, world_->truth(), clearances});
  } else {
    recorder_->record({snapshot, observations_, commands_, {}, {}});
  }
}

void LiveFlight::give_orders(const swarm::Snapshot& snapshot) noexcept {
  std::transform(snapshot.drones.begin(), snapshot.drones.end(), orders_.begin(),
                 [](const swarm::DroneSnapshot& drone) { return drone.order; });
  fleet_.order(mission_time(snapshot.time_s), orders_);
  if (world_ != nullptr) world_->advance(dt_s());
}

void LiveFlight::step(std::span<const LiveCommand> commands, LiveFrame& out, Outbox<LiveEvent>& outbox) noexcept {
  const double time_s = static_cast<double>(state_.ticks()) * dt_s();
  play_script(time_s, outbox);
  gather(commands);
  fleet_.observe(mission_time(time_s), observations_);
  swarm::tick(state_, observations_, commands_, out.snapshot, workers_);
  tell(commands, out.snapshot, outbox);
  judge_and_record(out.snapshot);
  give_orders(out.snapshot);

  state_.write_past(out.past);
  out.c_k.resize(state_.basis().indices_per_axis(), state_.basis().indices_per_axis());
  state_.statistics().average(out.c_k);
  for (std::size_t i = 0; i < out.intents.size(); ++i) out.intents[i] = standing_.intent_of(i, state_.drones()[i]);
  out.newest_order = newest_order_;
  out.revision = revision_;
  out.has_ticked = true;
}

}  // namespace vigil::runtime
