#include "vigil/adapters/console/protocol_vectors.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "vigil/adapters/console/frames.hpp"
#include "vigil/adapters/console/preview_json.hpp"
#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/adapters/console/why_answer.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::console {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Small numbers that binary fractions hold, so that a person can check them against the bytes.
constexpr const char* kMission = R"(format: 1
name: vectors
field: {size_m: [4, 2], origin_m: [10, 20]}
targets:
  clusters: [{name: east, points_m: [[13, 21], [13.5, 21.5]], weight: 2, revisit_s: 30}]
  areas: [{name: west, outline_m: [[10.5, 20.5], [11, 20.5], [11, 21]]}]
no_fly: [{name: mast, outline_m: [[12, 20.25], [12.25, 20.25], [12, 20.5]]}]
drones: [{id: a, start_m: [10.5, 21.5]}, {id: b, start_m: [12.5, 21.5]}]
control: {speed_limit_m_s: 0.5, basis_max_index: 1}
safety: {separation_m: 0.25, wall_distance_m: 0.125}
)";

std::string hex_of(const std::string& bytes) {
  std::string hex;
  for (const char byte : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return hex;
}

Json frame_case(const std::string& name, const std::string& kind, const std::string& bytes, Json fields) {
  return {{"name", name}, {"kind", kind}, {"hex", hex_of(bytes)}, {"fields", std::move(fields)}};
}

runtime::LiveFrame flying() {
  runtime::LiveFrame frame(2);
  swarm::Snapshot& snapshot = frame.snapshot;
  snapshot.tick = 1150;
  snapshot.time_s = 23.0;
  snapshot.has_metric = true;
  snapshot.metric = 0.25;
  snapshot.metric_percent = 12.5;
  snapshot.active = 1;
  swarm::DroneSnapshot& covering = snapshot.drones[0];
  covering.position = {0.5, 1.5};
  covering.velocity = {0.25, -0.5};
  covering.height_m = 1.0;
  covering.age_s = 0.02;
  covering.link_age_s = 0.25;
  covering.battery = 0.75;
  covering.mode = swarm::VehicleMode::kFlying;
  covering.activity = swarm::Activity::kActive;
  covering.is_obstacle = true;
  covering.u_nom = {0.5, 0.0};
  covering.order = {swarm::Action::kVelocity, {0.25, 0.0}};
  // As the filter met them; they go out nearest first.
  covering.filter.holding = {{{safety::RowKind::kWall, 3, 0.5}, {safety::RowKind::kNeighbour, 1, 0.375}}};
  covering.filter.holding_count = 2;
  covering.filter.speed_limited = true;
  covering.filter.nearest = 1;
  covering.filter.nearest_distance_m = 0.375;
  swarm::DroneSnapshot& unseen = snapshot.drones[1];
  unseen.age_s = kInfinity;
  unseen.link_age_s = kInfinity;
  unseen.battery = std::nan("");
  frame.revision = 7;
  frame.has_ticked = true;
  frame.c_k = ergodic::Coefficients(2, 2);
  frame.c_k << 0.5, 0.25, -0.125, 1.0;
  frame.past.coverage.has_samples = true;
  return frame;
}

Json snapshot_case() {
  runtime::ClockState clock;
  clock.speed = 2.0;
  clock.is_paused = true;
  clock.lateness = {.ticks = 1, .p50_us = 64.0, .p99_us = 128.0, .p999_us = 256.0, .max_us = 512.0};
  const SnapshotContext context{.epoch = 3,
                                .wall_ms = 1024.5,
                                .age_s = 0.125,
                                .worst_age_s = std::nan(""),
                                .speed_limit_m_s = 0.5,
                                .steady_ms = 2048.25,
                                .lost_ticks = 9};
  constexpr double kScale = 4.0 * 0.5 / 32767.0;
  return frame_case("two drones, one never seen", "snapshot", snapshot_frame(flying(), clock, context, ShownDrones(2)),
                    {{"paused", true},
                     {"fallback", false},
                     {"has_metric", true},
                     {"epoch", 3},
                     {"drones", 2},
                     {"tick", 1150},
                     {"time_s", 23.0},
                     {"wall_ms", 1024.5},
                     {"age_s", 0.125},
                     {"speed", 2.0},
                     {"metric", 0.25},
                     {"metric_percent", 12.5},
                     {"least_pair_m", "NaN"},
                     {"worst_age_s", "NaN"},
                     {"lateness_p50_us", 64.0},
                     {"lateness_p99_us", 128.0},
                     {"active", 1},
                     {"revision", 7},
                     {"idle", 0},
                     {"velocity_scale_m_s", static_cast<double>(static_cast<float>(kScale))},
                     {"lost_ticks", 9},
                     {"steady_ms", 2048.25},
                     {"position", {0.5, 1.5, "NaN", "NaN"}},
                     {"height", {1.0, 0.0}},
                     {"nearest", {0.375, "NaN"}},
                     {"velocity", {4096, -8192, 0, 0}},
                     {"nominal", {8192, 0, 0, 0}},
                     {"command", {4096, 0, 0, 0}},
                     {"age_ms", {20, 65535}},
                     {"link_age_ms", {250, 65535}},
                     {"battery", {150, 255}},
                     {"mode", {3, 0}},
                     {"activity", {0, 1}},
                     {"action", {3, 0}},
                     {"flags", {9, 0}},
                     {"holding",
                      {{{"drone", 0}, {"kind", 0}, {"index", 1}, {"distance_m", 0.375}},
                       {{"drone", 0}, {"kind", 1}, {"index", 3}, {"distance_m", 0.5}}}}});
}

Json density_cases() {
  const field::Field field{4.0, 2.0};
  field::DensityGrid density{field, Eigen::ArrayXXd::Zero(3, 2), {}, {}};
  density.values << 0.0, 0.125, 0.25, 0.5, 0.0, 0.0;
  const DensityContext preview{.epoch = 3, .revision = 7, .is_preview = true, .request = 42};
  return Json::array(
      {frame_case("a preview", "density", density_frame(field, density, preview),
                  {{"is_preview", true},
                   {"is_empty", false},
                   {"epoch", 3},
                   {"width", 3},
                   {"height", 2},
                   {"length_x_m", 4.0},
                   {"length_y_m", 2.0},
                   {"peak", 0.5},
                   {"revision", 7},
                   {"request", 42},
                   {"values", {0, 32768, 0, 16384, 65535, 0}}}),
       frame_case("nothing to look at", "density", density_frame(field, std::nullopt, {.epoch = 3, .revision = 8}),
                  {{"is_preview", false},
                   {"is_empty", true},
                   {"epoch", 3},
                   {"width", 0},
                   {"height", 0},
                   {"length_x_m", 4.0},
                   {"length_y_m", 2.0},
                   {"peak", 0.0},
                   {"revision", 8},
                   {"request", 0},
                   {"values", Json::array()}})});
}

Json other_frames() {
  const field::Field field{4.0, 2.0};
  field::SeenMap seen(field, {2, 2});
  seen.see({1.0, 0.5}, 0.1, 10.0);
  seen.see({3.0, 1.5}, 0.1, 21.5);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Trails trails{2, 2, 0.25, 23.0, {0.5F, 1.5F, 0.625F, 1.5F, nan, nan, 2.5F, 0.25F}};
  return Json::array(
      {frame_case("four coefficients", "coverage", coverage_frame(field, flying(), 3),
                  {{"has_samples", true},
                   {"epoch", 3},
                   {"time_s", 23.0},
                   {"length_x_m", 4.0},
                   {"length_y_m", 2.0},
                   {"indices_per_axis", 2},
                   {"c_k", {0.5, -0.125, 0.25, 1.0}}}),
       frame_case("two of four cells seen", "age", age_frame(seen, 23.0, 3),
                  {{"epoch", 3},
                   {"time_s", 23.0},
                   {"length_x_m", 4.0},
                   {"length_y_m", 2.0},
                   {"width", 2},
                   {"height", 2},
                   {"age_ds", {130, 65535, 65535, 15}}}),
       frame_case("two drones, two points", "trails", trails_frame(trails, 3),
                  {{"epoch", 3},
                   {"drones", 2},
                   {"points", 2},
                   {"spacing_s", 0.25},
                   {"time_s", 23.0},
                   {"xy", {0.5, 1.5, 0.625, 1.5, "NaN", "NaN", 2.5, 0.25}}}),
       frame_case("the middle of a status", "part", part_frame(R"({"type":"status"})", {6, 2, 6}),
                  {{"stream", 6}, {"offset", 2}, {"total", 17}, {"bytes", {116, 121, 112, 101, 34, 58}}})});
}

/// Both drones at first, then the second one on the ground.
Json history_case() {
  runtime::FlightHistory history(2);
  swarm::Snapshot snapshot = flying().snapshot;
  snapshot.drones[1] = snapshot.drones[0];
  snapshot.drones[1].position = {0.5, 1.0};
  for (const double time_s : {23.0, 23.5}) {
    snapshot.time_s = time_s;
    history.add(snapshot, time_s - 20.0);
    snapshot.drones[1].mode = swarm::VehicleMode::kGrounded;
  }
  return frame_case(
      "two drones, two moments", "history", history_frame(history, 3),
      {{"epoch", 3},
       {"rows", 2},
       {"plotted", 2},
       {"columns", 8},
       {"spacing_s", 0.1},
       {"times_s", {23.0, 23.5}},
       {"series", {12.5, 12.5, 3.0, 3.5, 0.5, "NaN", 1.0, 1.0, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.5, "NaN"}}});
}

Json frames() {
  Json cases = Json::array({snapshot_case(), history_case()});
  for (const Json& one : density_cases()) cases.push_back(one);
  for (const Json& one : other_frames()) cases.push_back(one);
  return cases;
}

const std::vector<std::pair<std::string, std::string>>& client_texts() {
  static const std::vector<std::pair<std::string, std::string>> kTexts{
      {"hello", R"({"type":"hello"})"},
      {"hello with all",
       R"({"type":"hello","name":"Ana","token":"0123456789abcdef","role":"viewer","confirms":true,"page":"00112233445566778899aabbccddeeff"})"},
      {"confirm", R"({"type":"confirm","received":123})"},
      {"ping", R"({"type":"ping","id":1})"},
      {"land some", R"({"type":"land","id":2,"drones":["a","b"]})"},
      {"land some of the flight that was seen",
       R"({"type":"land","id":23,"run":"5f1c09d2a7b34e68","epoch":3,"drones":["a","b"]})"},
      {"undo", R"({"type":"undo","id":24,"based_on":7})"},
      {"redo", R"({"type":"redo","id":25,"based_on":8})"},
      {"undo of the flight that was seen",
       R"({"type":"undo","id":30,"run":"5f1c09d2a7b34e68","epoch":3,"based_on":7})"},
      {"edit of the flight that was seen",
       R"({"type":"edit","id":31,"run":"5f1c09d2a7b34e68","epoch":3,"based_on":7,"edits":[{"op":"set_uniform_floor","uniform_floor":0}]})"},
      {"take off all", R"({"type":"take_off","id":3,"drones":"all"})"},
      {"land all", R"({"type":"land_all","id":4})"},
      {"emergency stop", R"({"type":"emergency_stop","id":5,"drones":"all"})"},
      {"go to", R"({"type":"go_to","id":6,"drones":["a"],"place_m":[11,21]})"},
      {"return", R"({"type":"return","id":7,"drones":["a"]})"},
      {"speed", R"({"type":"set_speed","id":8,"factor":20})"},
      {"pause", R"({"type":"pause","id":9})"},
      {"seek", R"({"type":"seek","id":18,"time_s":23.5})"},
      {"step back", R"({"type":"step","id":19,"ticks":-1})"},
      {"editing", R"({"type":"editing","id":10,"what":[{"kind":"area","name":"west"}]})"},
      {"load", R"({"type":"load_mission","id":11,"yaml":"format: 1"})"},
      {"every edit",
       R"({"type":"edit","id":12,"based_on":7,"edits":[{"op":"add","kind":"cluster","entry":{"name":"n","points_m":[[11,21]]}},{"op":"replace","kind":"area","name":"west","entry":{"name":"west","outline_m":[[10.5,20.5],[11,20.5],[11,21]],"weight":2,"soft_edge_m":0.5,"revisit_s":null}},{"op":"remove","kind":"no_fly","name":"mast"},{"op":"rename","kind":"cluster","name":"n","to":"north"},{"op":"add_point","kind":"cluster","name":"north","point_m":[11,21]},{"op":"add_point","kind":"cluster","name":"north","point_m":[11,21],"index":0},{"op":"move_point","kind":"cluster","name":"north","index":0,"point_m":[12,21]},{"op":"remove_point","kind":"cluster","name":"north","index":1},{"op":"set_weight","kind":"cluster","name":"north","weight":3},{"op":"set_revisit","kind":"cluster","name":"north","revisit_s":60},{"op":"set_protect","kind":"cluster","name":"north","protect":true},{"op":"set_soft_edge","kind":"area","name":"west","soft_edge_m":0.25},{"op":"set_uniform_floor","uniform_floor":0.125}]})"},
      {"preview",
       R"({"type":"preview_density","id":13,"based_on":7,"edits":[{"op":"set_weight","kind":"cluster","name":"east","weight":3}]})"},
      {"look ahead", R"({"type":"preview","id":14})"},
      {"look ahead with all",
       R"({"type":"preview","id":15,"seconds":30,"based_on":7,"edits":[{"op":"set_weight","kind":"cluster","name":"east","weight":3}],"without":["a"]})"},
      {"why", R"({"type":"why","id":23,"drone":"a"})"},
      {"not JSON", R"({"type":"ping","id":)"},
      {"not an object", R"([1,2])"},
      {"no type", R"({"id":1})"},
      {"unknown type", R"({"type":"fly_to_the_moon","id":1})"},
      {"no id", R"({"type":"ping"})"},
      {"negative id", R"({"type":"ping","id":-1})"},
      {"id too large for a double", R"({"type":"ping","id":9007199254740992})"},
      {"unknown member", R"({"type":"ping","id":1,"colour":"red"})"},
      {"confirm nothing", R"({"type":"confirm"})"},
      {"confirm with an id", R"({"type":"confirm","received":123,"id":1})"},
      {"perhaps to confirm", R"({"type":"hello","confirms":"yes"})"},
      {"a member twice", R"({"type":"land","id":26,"drones":["a"],"drones":["b"]})"},
      {"a member of a member twice",
       R"({"type":"edit","id":27,"based_on":7,"edits":[{"op":"set_weight","kind":"cluster","name":"x","weight":1,"weight":9}]})"},
      {"undo of what was not seen", R"({"type":"undo","id":28})"},
      {"an epoch that is no number", R"({"type":"land","id":29,"epoch":"3","drones":"all"})"},
      {"nobody", R"({"type":"land","id":1,"drones":[]})"},
      {"wrong word for all", R"({"type":"land","id":1,"drones":"everybody"})"},
      {"a page\'s mark that can be guessed", R"({"type":"hello","page":"1"})"},
      {"a page\'s mark that is none", R"({"type":"hello","page":"00112233445566778899AABBCCDDEEFF"})"},
      {"unknown role", R"({"type":"hello","role":"admiral"})"},
      {"empty name", R"({"type":"hello","name":""})"},
      {"no edits", R"({"type":"edit","id":1,"based_on":7,"edits":[]})"},
      {"unknown edit", R"({"type":"edit","id":1,"based_on":7,"edits":[{"op":"paint"}]})"},
      {"unknown kind", R"({"type":"edit","id":1,"based_on":7,"edits":[{"op":"remove","kind":"tree","name":"x"}]})"},
      {"a point of three",
       R"({"type":"edit","id":1,"based_on":7,"edits":[{"op":"add_point","kind":"cluster","name":"x","point_m":[1,2,3]}]})"},
      {"look too far ahead", R"({"type":"preview","id":16,"seconds":601})"},
      {"look ahead by nothing", R"({"type":"preview","id":17,"based_on":7})"},
      {"half a step", R"({"type":"step","id":20,"ticks":0.5})"},
      {"no step", R"({"type":"step","id":21,"ticks":0})"},
      {"seek without a time", R"({"type":"seek","id":22})"},
      {"why whoever", R"({"type":"why","id":24})"},
      {"why all", R"({"type":"why","id":25,"drone":["a"]})"},
      {"a number beyond all", R"({"type":"set_speed","id":1,"factor":1e999})"},
  };
  return kTexts;
}

Json client_messages() {
  Json cases = Json::array();
  for (const auto& [name, text] : client_texts()) {
    const auto parsed = parse_client_message(text);
    const auto* refusal = std::get_if<MessageRefusal>(&parsed);
    Json one{{"name", name}, {"text", text}, {"is_accepted", refusal == nullptr}};
    if (refusal != nullptr) one["code"] = refusal->code;
    cases.push_back(std::move(one));
  }
  return cases;
}

/// Of the mission's sections only some: what a mission file may say grows without the protocol.
Json shortened(Json message) {
  for (const char* section : {"control", "safety", "health", "sensor", "simulation"}) message["mission"].erase(section);
  return message;
}

Json replay_status_vector(const std::vector<runtime::AreaState>& areas, StatusContext status) {
  status.replay = ReplayState{.number = 1151,
                              .is_recomputed = true,
                              .is_seeking = false,
                              .progress = 1.0,
                              .is_at_end = true,
                              .difference = "metric: recorded 0.5, recomputed 0.25"};
  status.waiting.clear();  // a recording is not ordered about
  status.waiting_more = 0;
  return status_json(areas, status);
}

/// Two drones, of which the second was never seen.
Json preview_vector() {
  runtime::Outlook as_is;
  as_is.seconds = 1.0;
  as_is.tick_s = 0.125;
  as_is.samples = {{0.0, 0.5, 100.0, 3.25, 1}, {1.0, 0.25, 50.0, 4.25, 1}};
  as_is.areas = {{.what = {runtime::TargetKind::kCluster, "east"}, .asked = 0.5, .achieved = 0.25},
                 {.what = {runtime::TargetKind::kArea, "west"}, .asked = 0.25, .achieved = 0.5}};
  as_is.areas[0].deadline_s = 30.0;
  as_is.areas[1].covered_in_s = 0.0;
  as_is.areas[1].seen_in_s = 0.75;
  as_is.areas[1].worst_age_s = 4.25;
  as_is.ghost_spacing_s = 1.0;
  as_is.ghost_points = 2;
  const Vec2 nowhere = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  as_is.ghosts = {{0.5, 1.5}, {0.625, 1.5}, nowhere, nowhere};
  runtime::Outlook what_if = as_is;
  what_if.least_pair_m = 0.75;
  what_if.samples.back().active = 0;
  Json message = preview_json({1151, 23.02, as_is, what_if}, {3, 7, {}});
  message["id"] = 14;
  return message;
}

/// The first drone, close to the second one and to a wall, after two ticks.
Json why_vector(const runtime::Mission& mission) {
  swarm::SwarmState state(runtime::swarm_parameters(mission, swarm::Intent::kCover));
  std::vector<swarm::DroneObservation> seen(2);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i].position = {0.140625 + 0.265625 * static_cast<double>(i), 1.0};
    seen[i].height_m = 1.0;
    seen[i].age_s = seen[i].link_age_s = 0.0;
    seen[i].mode = swarm::VehicleMode::kFlying;
  }
  swarm::Command command;
  command.kind = swarm::CommandKind::kSetTarget;
  command.target = runtime::coverage_target(mission, state.basis());
  swarm::Snapshot snapshot(2);
  for (int n = 0; n < 2; ++n) swarm::tick(state, seen, std::span(&command, 1), snapshot);
  Json message = why_json(state, swarm::DroneId(0), mission, 3);
  message["id"] = 23;
  return message;
}

Json server_messages() {
  const runtime::Mission mission = runtime::parse_mission(kMission, "the vectors' mission");
  runtime::MissionDesk desk(mission);
  const std::vector<runtime::TargetEdit> edits{runtime::SetWeight{{runtime::TargetKind::kCluster, "east"}, 3.0}};
  const bool is_refused = desk.edit(edits, 1, "Ana").has_value();
  const Operator ana{3, "Ana", Role::kOperator, {{runtime::TargetKind::kArea, "west"}}};
  ConsoleEvent event{
      .number = 12, .tick = 1150, .time_s = 23.0, .wall_ms = 1024.5, .source = "swarm", .what = "landing"};
  event.drone = "b";
  event.was = "active";
  event.words = {runtime::Severity::kWarning, "b lands", "1 of 2 drones cover", "take off again when it is ready"};
  const std::vector<runtime::AreaState> areas{
      {{runtime::TargetKind::kCluster, "east"}, 3.25, 14.0, 30.0, false, 0.5, 0.25, 42.5},
      {{runtime::TargetKind::kArea, "west"}, 33.5, 33.5, {}, false, 0.25, 0.5}};
  std::array<swarm::DroneSnapshot, 3> drones;
  drones[0].pad = 1;
  drones[0].away_for_s = 312.5;
  drones[1].leaves_in_s = 900.0;
  drones[1].away_for_s = 600.0;
  const StatusContext status{
      .epoch = 3,
      .recording = RecordingState{"out/x", 1200, 0},
      .lost_events = 0,
      .clients = 2,
      .lateness = {.ticks = 1, .p50_us = 64.0, .p99_us = 128.0, .p999_us = 256.0, .max_us = 512.0},
      .lateness_ever = {.ticks = 1000, .p50_us = 64.0, .p99_us = 256.0, .p999_us = 512.0, .max_us = 1024.0},
      .waits_for_resume = true,
      .waiting = {{"land a, b", "Ana"}},
      .waiting_more = 2,
      .replay = {},
      .plan = drones};
  Json list = Json::array();
  const auto add = [&list](const char* name, Json message) {
    list.push_back({{"name", name}, {"message", std::move(message)}});
  };
  add("hello", hello_json(ana, "vigil 0.1.0", "5f1c09d2a7b34e68", true, 2048.25));
  const RecordingFacts recording{
      .begin_s = 0.0, .end_s = 23.0, .ticks = 1151, .spacing_s = 0.02, .incomplete = "it was cut off"};
  add("mission", shortened(mission_message(mission, 3, false)));
  add("mission of a recording", shortened(recorded_mission_message(mission, 3, recording)));
  add(is_refused ? "targets, not changed" : "targets", targets_json(desk, 3));
  add("events", events_json({event_json(event)}));
  add("events afresh", events_afresh_json({event_json(event)}));
  add("status", status_json(areas, status));
  add("status of a recording", replay_status_vector(areas, status));
  add("presence", presence_json({ana}));
  add("ack", ack_json(7, {1151, false, {}, {}}));
  add("ack of an edit", ack_json(8, {1151, true, 8, {}}));
  add("ack of some", ack_json(9, {1151, false, {}, {{"b", "b is on the ground already"}}, 1}));
  add("refused", refused_json({10, "stale", "Ben changed it"}));
  add("refused, no id", refused_json({{}, "malformed", "it is not JSON in UTF-8"}));
  add("pong", pong_json(11, 1024.5, 2048.25));
  add("preview", preview_vector());
  add("why", why_vector(mission));
  add("bye", bye_json("ending", "the program ends"));
  return list;
}

std::string lines_of(const Json& cases) {
  std::string text = "[\n";
  for (const Json& one : cases) text += (text.size() > 2 ? ",\n" : "") + one.dump();
  return text + "\n]\n";
}

}  // namespace

std::map<std::string, std::string> protocol_vectors() {
  return {{"frames.json", lines_of(frames())},
          {"client_messages.json", lines_of(client_messages())},
          {"server_messages.json", lines_of(server_messages())}};
}

}  // namespace vigil::console
