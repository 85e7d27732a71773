#include "vigil/adapters/console/server_messages.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/adapters/console/edit_json.hpp"
#include "vigil/adapters/console/mission_json.hpp"
#include "vigil/adapters/console/shown_drones.hpp"
#include "vigil/runtime/replay_loop.hpp"

namespace vigil::console {
namespace {

template <typename Entries>
Json list_of(const Entries& entries) {
  Json list = Json::array();
  for (const auto& entry : entries) list.push_back(to_json(entry));
  return list;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string or_empty(const std::string* text) { return text == nullptr ? std::string() : *text; }

Json area_json(const runtime::AreaState& area) {
  return {{"kind", runtime::name_of(area.what.kind)},
          {"name", area.what.name},
          {"age_s", area.age_s},
          {"worst_s", area.worst_s},
          {"deadline_s", or_null(area.deadline_s)},
          {"is_overdue", area.is_overdue},
          {"asked", area.asked},
          {"achieved", area.achieved},
          {"foreseen_s", or_null(area.foreseen_s)}};
}

/// Who is away, or is to go, and until when: a line each.
Json plan_json(std::span<const swarm::DroneSnapshot> drones) {
  Json plan = Json::array();
  const ShownDrones shown(drones.size());
  for (std::size_t place = 0; place < std::min(shown.size(), kMostPlanned); ++place) {
    const swarm::DroneSnapshot& drone = drones[shown.drones()[place]];
    if (!std::isfinite(drone.leaves_in_s) && drone.pad < 0) continue;
    const double leaves_in_s = drone.pad >= 0 ? 0.0 : drone.leaves_in_s;
    plan.push_back({{"drone", place},
                    {"pad", drone.pad >= 0 ? Json(drone.pad) : Json(nullptr)},
                    {"leaves_in_s", leaves_in_s},
                    {"back_in_s", finite_or_null(leaves_in_s + drone.away_for_s)}});
  }
  return plan;
}

runtime::Mission as_shown(const runtime::Mission& mission) {
  runtime::Mission shown = mission;
  shown.drones.clear();
  const ShownDrones chosen(mission.drones.size());
  for (const std::size_t drone : chosen.drones()) shown.drones.push_back(mission.drones[drone]);
  return shown;
}

Json mission_message(const runtime::Mission& mission, std::uint32_t epoch, std::string_view fleet,
                     const SpeedRange& speeds, Json recording) {
  Json file = mission_json(as_shown(mission));
  file.erase("targets");
  file.erase("no_fly");
  return {{"type", "mission"},
          {"epoch", epoch},
          {"fleet", fleet},
          {"mission", std::move(file)},
          {"display", display_json(mission, speeds)},
          {"recording", std::move(recording)}};
}

Json replay_json(const ReplayState& replay) {
  return {{"number", replay.number},     {"is_recomputed", replay.is_recomputed}, {"is_seeking", replay.is_seeking},
          {"progress", replay.progress}, {"is_at_end", replay.is_at_end},         {"difference", replay.difference}};
}

Json lateness_json(const runtime::LatenessFigures& lateness) {
  return {{"ticks", lateness.ticks},
          {"p50", lateness.p50_us},
          {"p99", lateness.p99_us},
          {"p999", lateness.p999_us},
          {"max", lateness.max_us}};
}

}  // namespace

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json hello_json(const Operator& client, std::string_view program, std::string_view run, bool wants_login,
                double steady_ms) {
  return {{"type", "hello"},         {"protocol", 1},        {"program", program},
          {"client", client.client}, {"name", client.name},  {"role", name_of(client.role)},
          {"roles", kRoleWords},     {"login", wants_login}, {"run", run},
          {"steady_ms", steady_ms}};
}

Json mission_message(const runtime::Mission& mission, std::uint32_t epoch, bool has_real_drones) {
  if (has_real_drones) return mission_message(mission, epoch, "LIVE", {1.0, 1.0}, nullptr);
  return mission_message(mission, epoch, "SIM", {1.0, kMostSpeed}, nullptr);
}

Json recorded_mission_message(const runtime::Mission& mission, std::uint32_t epoch, const RecordingFacts& recording) {
  constexpr SpeedRange kSpeeds{runtime::ReplayLoop::kLeastSpeed, runtime::ReplayLoop::kMostSpeed};
  return mission_message(mission, epoch, "REPLAY", kSpeeds,
                         {{"begin_s", recording.begin_s},
                          {"end_s", recording.end_s},
                          {"ticks", recording.ticks},
                          {"spacing_s", recording.spacing_s},
                          {"incomplete", recording.incomplete}});
}

Json targets_json(const runtime::MissionDesk& desk, std::uint32_t epoch) {
  const runtime::Mission& mission = desk.mission();
  return {{"type", "targets"},
          {"epoch", epoch},
          {"revision", desk.revision()},
          {"by", desk.by()},
          {"what", desk.what()},
          {"can_undo", desk.undo_what() != nullptr},
          {"can_redo", desk.redo_what() != nullptr},
          {"undo_what", or_empty(desk.undo_what())},
          {"redo_what", or_empty(desk.redo_what())},
          {"clusters", list_of(mission.targets.clusters)},
          {"areas", list_of(mission.targets.areas)},
          {"no_fly", list_of(mission.no_fly)},
          {"uniform_floor", mission.targets.uniform_floor}};
}

Json event_json(const ConsoleEvent& event) {
  return {{"number", event.number},
          {"epoch", event.epoch},
          {"tick", event.tick},
          {"time_s", event.time_s},
          {"wall_ms", event.wall_ms},
          {"severity", runtime::name_of(event.words.severity)},
          {"source", event.source},
          {"what", event.what},
          {"drone", event.drone},
          {"was", event.was},
          {"by", event.by},
          {"text", event.words.text},
          {"effect", event.words.effect},
          {"next", event.words.next}};
}

Json events_json(const std::vector<Json>& events) { return {{"type", "events"}, {"events", events}}; }

Json events_afresh_json(const std::vector<Json>& events) {
  return {{"type", "events"}, {"afresh", true}, {"events", events}};
}

Json status_json(const std::vector<runtime::AreaState>& areas, const StatusContext& context) {
  Json list = Json::array();
  for (const runtime::AreaState& area : areas) list.push_back(area_json(area));
  Json recording(nullptr);
  if (context.recording)
    recording = {{"folder", context.recording->folder},
                 {"ticks", context.recording->ticks},
                 {"lost_ticks", context.recording->lost_ticks}};
  Json waiting = Json::array();
  for (const WaitingOrder& order : context.waiting) waiting.push_back({{"text", order.text}, {"from", order.from}});
  return {{"type", "status"},
          {"epoch", context.epoch},
          {"areas", std::move(list)},
          {"recording", std::move(recording)},
          {"lost_events", context.lost_events},
          {"clients", context.clients},
          {"lateness_us", lateness_json(context.lateness)},
          {"lateness_ever_us", lateness_json(context.lateness_ever)},
          {"waits_for_resume", context.waits_for_resume},
          {"waiting", std::move(waiting)},
          {"waiting_more", context.waiting_more},
          {"replay", context.replay ? replay_json(*context.replay) : Json(nullptr)},
          {"plan", plan_json(context.plan)}};
}

Json presence_json(const std::vector<Operator>& operators) {
  Json list = Json::array();
  for (const Operator& one : operators) {
    Json editing = Json::array();
    for (const runtime::TargetName& what : one.editing)
      editing.push_back({{"kind", runtime::name_of(what.kind)}, {"name", what.name}});
    list.push_back(
        {{"client", one.client}, {"name", one.name}, {"role", name_of(one.role)}, {"editing", std::move(editing)}});
  }
  return {{"type", "presence"}, {"operators", std::move(list)}};
}

Json ack_json(std::uint64_t id, const Answer& answer) {
  Json json{{"type", "ack"}, {"id", id}, {"tick", answer.tick}, {"pending", answer.is_pending}};
  if (answer.revision) json["revision"] = *answer.revision;
  if (answer.refused_drones.empty()) return json;
  Json refused = Json::array();
  for (const auto& [drone, reason] : answer.refused_drones) refused.push_back({{"drone", drone}, {"reason", reason}});
  json["refused_drones"] = std::move(refused);
  json["refused_count"] = answer.refused_count;
  return json;
}

Json refused_json(const MessageRefusal& refusal) {
  return {{"type", "refused"},
          {"id", refusal.id ? Json(*refusal.id) : Json(nullptr)},
          {"code", refusal.code},
          {"reason", refusal.reason}};
}

Json pong_json(std::uint64_t id, double wall_ms, double steady_ms) {
  return {{"type", "pong"}, {"id", id}, {"wall_ms", wall_ms}, {"steady_ms", steady_ms}};
}

Json bye_json(std::string_view code, std::string_view reason) {
  return {{"type", "bye"}, {"code", code}, {"reason", reason}};
}

std::string_view code_of(runtime::Refusal::Code code) {
  switch (code) {
    case runtime::Refusal::Code::kStale:
      return "stale";
    case runtime::Refusal::Code::kNotNow:
      return "not_now";
    case runtime::Refusal::Code::kInvalid:
      break;
  }
  return "invalid";
}

std::string in_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace vigil::console
