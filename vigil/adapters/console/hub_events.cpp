// What the hub tells of a flight's events, and of what came of orders.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/hub.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::console {
namespace {

using runtime::LiveEvent;
using runtime::Severity;

constexpr std::size_t kKeptEvents = 200;
/// Refusals of single drones that an answer lists.
constexpr std::size_t kMostRefusedDrones = 32;

bool concerns_drone(swarm::CommandKind wish) {
  return wish != swarm::CommandKind::kSetTarget && wish != swarm::CommandKind::kStartAfresh;
}

bool is_logged_by_the_flight(std::string_view what) {
  return what != "edit" && what != "undo" && what != "redo" && what != "load_mission" && what != "preview_density";
}

}  // namespace

void Hub::log(ConsoleEvent event) {
  if (flight_) event.epoch = flight_->epoch();
  event.wall_ms = links_.wall_ms();
  if (event.tick == 0 && frame_) event.tick = frame_->snapshot.tick;
  if (event.time_s == 0.0 && frame_) event.time_s = frame_->snapshot.time_s;
  if (flight_ && flight_->recorder() != nullptr && event.source != "mission")
    flight_->recorder()->log({event.time_s, event.source, event.what, event.drone, event.words.text});
  if (event.source == "swarm" && !swarm_events_.admit(links_.now())) {
    ++untold_events_;
    return;
  }
  event.number = next_event_++;
  keep_event(event_json(event));
}

void Hub::keep_event(Json event) {
  new_events_.push_back(event);
  events_.push_back(std::move(event));
  if (events_.size() > kKeptEvents) events_.pop_front();
}

/// A hundred thousand drones that land are more news than anybody reads, or a connection takes.
void Hub::tell_of_untold() {
  if (untold_events_ == 0 || !swarm_events_.admit(links_.now())) return;
  log({.source = "program",
       .what = "untold",
       .words = {Severity::kWarning,
                 fmt::format("{} more events of single drones came too fast to be told", untold_events_), "",
                 "look at the fleet for how each drone is; a recording has all events"}});
  untold_events_ = 0;
}

void Hub::send_events() {
  tell_of_untold();
  if (new_events_.empty()) return;
  // A swarm that drops out must not make one huge message, which on a slow way is read when all of it has come.
  constexpr std::size_t kMostAtOnce = 32;
  for (std::size_t first = 0; first < new_events_.size(); first += kMostAtOnce) {
    const auto begin = new_events_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end =
        new_events_.begin() + static_cast<std::ptrdiff_t>(std::min(first + kMostAtOnce, new_events_.size()));
    say_to_all(events_json({begin, end}));
  }
  new_events_.clear();
}

/// What was ordered is told before what came of it: who waits for a confirmation does not wait for a thousand landings.
void Hub::hear_all(const std::vector<LiveEvent>& events) {
  const auto is_of_an_order = [](const LiveEvent& event) {
    return event.kind == LiveEvent::Kind::kAnswer || event.kind == LiveEvent::Kind::kRefusal;
  };
  for (const LiveEvent& event : events)
    if (is_of_an_order(event)) hear(event);
  for (const LiveEvent& event : events)
    if (!is_of_an_order(event)) hear(event);
}

void Hub::hear(const LiveEvent& event) {
  switch (event.kind) {
    case LiveEvent::Kind::kSwarm:
      return hear_swarm(event);
    case LiveEvent::Kind::kScript:
      return hear_script(event);
    case LiveEvent::Kind::kAnswer:
      return hear_answer(event);
    case LiveEvent::Kind::kRefusal:
      break;
  }
  const auto found = waiting_.find(event.ticket);
  if (found == waiting_.end() || found->second.refused.size() >= kMostRefusedDrones) return;
  const std::string id = drone_id(event.event.drone.index());
  found->second.refused.emplace_back(id, runtime::refusal_words(id, event.event.wish, event.drone));
}

void Hub::hear_swarm(const LiveEvent& event) {
  const std::string id = drone_id(event.event.drone.index());
  ConsoleEvent told{.tick = event.tick, .time_s = event.time_s, .source = "swarm", .drone = id};
  if (event.event.kind == swarm::EventKind::kActivityChanged) {
    told.what = swarm::name_of(event.event.after);
    told.was = swarm::name_of(event.event.before);
    told.words = runtime::words_for(id, event.event.after, event.drone, event.active, frame_->snapshot.drones.size());
  } else if (event.event.kind == swarm::EventKind::kFaultNoticed) {
    told.what = swarm::name_of(event.event.fault);
    told.words = runtime::words_for_fault(id, event.drone, event.active, frame_->snapshot.drones.size());
  } else if (event.event.kind == swarm::EventKind::kStationFailed ||
             event.event.kind == swarm::EventKind::kStationWorks) {
    const bool works = event.event.kind == swarm::EventKind::kStationWorks;
    told.drone = "";
    told.what = works ? "station_works" : "station_failed";
    told.words = runtime::words_for_station(flight_->mission().stations.at(event.event.station).name, works);
  } else if (event.event.kind == swarm::EventKind::kWishRefused && concerns_drone(event.event.wish)) {
    told.what = "refused";
    told.words = {Severity::kInfo, runtime::refusal_words(id, event.event.wish, event.drone), "", ""};
  } else {
    return;
  }
  log(std::move(told));
}

void Hub::hear_script(const LiveEvent& event) {
  const runtime::EventEntry& entry = flight_->mission().simulation.events.at(event.index);
  const std::string what(runtime::name_of(entry.what));
  if (runtime::edits_targets(entry.what)) {
    const std::uint32_t epoch = flight_->epoch();
    const std::size_t index = event.index;
    if (!links_.at_desk([=](Desk& desk) { desk.play(epoch, index); }))
      log({.source = "program",
           .what = "trouble",
           .words = {Severity::kWarning, "an event of the mission file was lost: the desk is too busy", "", ""}});
    return;
  }
  log({.tick = event.tick,
       .time_s = event.time_s,
       .source = runtime::is_of_the_world(entry.what) ? "world" : "mission",
       .what = what,
       .drone = entry.drone,
       .words = {Severity::kInfo, fmt::format("by the mission file: {} {}", what, entry.drone), "", ""}});
}

void Hub::hear_answer(const LiveEvent& event) {
  const auto found = waiting_.find(event.ticket);
  if (found == waiting_.end()) return;
  if (!found->second.is_kept && event.accepted > 0) {
    found->second.outcome = event;
    return;
  }
  Waiting waiting = std::move(found->second);
  waiting_.erase(found);
  const bool is_pending_answered = waiting.answer.is_pending;
  if (event.accepted == 0 && event.refused > 0) {
    const std::string reason = waiting.refused.empty() ? "no drone could follow" : waiting.refused.front().second;
    if (is_pending_answered)
      log({.source = "swarm", .what = "refused", .by = waiting.by, .words = {Severity::kWarning, reason, "", ""}});
    else
      waiting.reply(refused_json({waiting.id, "not_now", reason}));
    return;
  }
  if (!is_pending_answered) {
    Answer answer{.tick = event.tick};
    if (waiting.wants_revision) answer.revision = event.revision;
    answer.refused_drones = std::move(waiting.refused);
    answer.refused_count = event.refused;
    waiting.reply(ack_json(waiting.id, answer));
  }
  if (waiting.what == "resume" || waiting.what == "take_off") waits_for_resume_ = false;
  if (is_logged_by_the_flight(waiting.what) && !flight_->is_recording())
    log({.tick = event.tick,
         .time_s = event.time_s,
         .source = "operator",
         .what = waiting.what,
         .drone = waiting.drones,
         .by = waiting.by,
         .words = {
             waiting.what == "emergency_stop" ? Severity::kAlarm : Severity::kInfo,
             fmt::format("{}: {}{}{}", waiting.by, waiting.what, waiting.drones.empty() ? "" : " ", waiting.drones), "",
             ""}});
}

}  // namespace vigil::console
