#include "vigil/adapters/console/hub.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/seats.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/replay_loop.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

constexpr double kMessagesASecond = 50.0;
constexpr double kMessagesAtOnce = 200.0;
/// A client that was refused so often for its rate means no good.
constexpr std::size_t kMostRefusedForRate = 2000;
/// Of single drones, that clients are told; more would fill what a client may leave unread.
constexpr double kSwarmEventsASecond = 200.0;
constexpr double kSwarmEventsAtOnce = 2000.0;
/// No confirmation is longer.
constexpr std::size_t kMostConfirmBytes = 128;
/// Commands of all clients that wait for an answer.
constexpr std::size_t kMostWaiting = 4096;

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

bool is_of_the_clock(const MessageBody& body) {
  return std::holds_alternative<SetSpeed>(body) || std::holds_alternative<Pause>(body) ||
         std::holds_alternative<ResumeClock>(body);
}

bool is_of_recordings(const MessageBody& body) {
  return std::holds_alternative<Seek>(body) || std::holds_alternative<StepTicks>(body);
}

/// Why a flight cannot follow a message of this kind; empty where it can.
std::string_view unfit(const MessageBody& body, const runtime::ShownFlight& flight) {
  const bool is_recording = flight.is_recording();
  if (flight.has_real_drones() && is_of_the_clock(body))
    return "these drones are real: their time cannot be stopped or hurried; hold them instead";
  if (!is_recording && is_of_recordings(body))
    return "this is a flight, not a recording: time goes on in it; `vigil replay DIR` shows a recording";
  if (is_recording && !is_of_recordings(body) && !is_of_the_clock(body) && !std::holds_alternative<Why>(body))
    return "this is a recording: what happened in it cannot be changed; `vigil serve MISSION` flies";
  return {};
}

std::string in_words(const std::vector<std::string>& drones) {
  constexpr std::size_t kMostNamed = 8;
  const std::size_t named = std::min(drones.size(), kMostNamed);
  const auto end = drones.begin() + static_cast<std::ptrdiff_t>(named);
  const std::string names = fmt::format("{}", fmt::join(drones.begin(), end, ", "));
  return named == drones.size() ? names : fmt::format("{} and {} more", names, drones.size() - named);
}

std::string name_or(const std::string& name, std::uint32_t client) {
  return name.empty() ? fmt::format("operator {}", client) : name;
}

}  // namespace

Hub::Hub(HubSetup setup, HubLinks links)
    : setup_(std::move(setup)), links_(std::move(links)), swarm_events_(kSwarmEventsASecond, kSwarmEventsAtOnce) {}

std::optional<Role> Hub::role_for(std::string_view token) const {
  return setup_.tokens ? setup_.tokens->role_for(token) : std::optional(Role::kSafetyPilot);
}

Hub::ClientId Hub::connect(std::shared_ptr<ClientLine> line) {
  const ClientId id = next_client_++;
  clients_.emplace(id, Client{{id, "", Role::kViewer, {}},
                              std::move(line),
                              links_.now(),
                              false,
                              RateLimit(kMessagesASecond, kMessagesAtOnce)});
  return id;
}

void Hub::disconnect(ClientId client) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  const bool was_seen = found->second.has_said_hello;
  clients_.erase(found);
  if (was_seen) tell_presence();
}

bool Hub::knows(ClientId client) const {
  const auto found = clients_.find(client);
  return found != clients_.end() && found->second.has_said_hello;
}

void Hub::part_with(ClientId id, std::string_view code, std::string_view reason) {
  const auto found = clients_.find(id);
  if (found == clients_.end()) return;
  found->second.line->say(std::make_shared<const std::string>(in_text(bye_json(code, reason))));
  found->second.line->close();
  disconnect(id);
}

void Hub::end() {
  while (!clients_.empty()) part_with(clients_.begin()->first, "ending", "the program ends");
}

void Hub::receive(ClientId id, std::string_view text) {
  const auto found = clients_.find(id);
  if (found == clients_.end()) return;
  Client& client = found->second;
  const auto is_admitted = [&] { return client.rate.admit(links_.now()); };
  // A confirmation that is one costs nothing of what a client may say: there are no more of them than messages were
  // sent.
  const bool may_confirm = text.size() <= kMostConfirmBytes;
  constexpr std::string_view kTooFast = "wait a moment: 50 messages a second";
  if (!may_confirm && !is_admitted()) return refuse_message(id, "too_fast", kTooFast);
  std::variant<ClientMessage, MessageRefusal> parsed = parse_client_message(text);
  if (may_confirm && confirms(client, parsed)) return;
  if (may_confirm && !is_admitted()) return refuse_message(id, "too_fast", kTooFast);
  hear(client, std::move(parsed));
}

bool Hub::confirms(const Client& client, const std::variant<ClientMessage, MessageRefusal>& parsed) {
  const auto* message = std::get_if<ClientMessage>(&parsed);
  const auto* confirm = message == nullptr ? nullptr : std::get_if<Confirm>(&message->body);
  return confirm != nullptr && client.has_said_hello && client.line->confirm(confirm->received);
}

void Hub::hear(Client& client, std::variant<ClientMessage, MessageRefusal> parsed) {
  const ClientId id = client.who.client;
  if (const auto* refusal = std::get_if<MessageRefusal>(&parsed)) {
    if (!client.has_said_hello) return part_with(id, "no_hello", "the first message must be hello: " + refusal->reason);
    client.line->say(std::make_shared<const std::string>(in_text(refused_json(*refusal))));
    return;
  }
  const auto& message = std::get<ClientMessage>(parsed);
  if (const auto* hello = std::get_if<Hello>(&message.body)) return greet(client, *hello);
  if (!client.has_said_hello) return part_with(id, "no_hello", "the first message must be hello");
  if (std::holds_alternative<Confirm>(message.body))
    return refuse_message(id, "invalid",
                          "received: must grow, up to the messages that were sent, after a hello with confirms");
  const std::weak_ptr<ClientLine> line = client.line;
  execute(message, {id, client.who.role, client.who.name}, [line](const Json& answer) {
    if (const auto still_there = line.lock()) still_there->say(std::make_shared<const std::string>(in_text(answer)));
  });
}

void Hub::refuse_message(ClientId id, std::string_view code, std::string_view reason) {
  const auto found = clients_.find(id);
  if (found == clients_.end()) return;
  Client& client = found->second;
  if (!client.has_said_hello || ++client.refused_for_rate > kMostRefusedForRate)
    return part_with(id, "too_fast", reason);
  const MessageRefusal refusal{{}, code, std::string(reason)};
  client.line->say(std::make_shared<const std::string>(in_text(refused_json(refusal))));
}

/// A page that connects anew has lost the connection that it had, which the network may take long to notice.
void Hub::replace(const std::string& page) {
  if (page.empty()) return;
  std::vector<ClientId> lost;
  for (const auto& [id, client] : clients_)
    if (client.page == page) lost.push_back(id);
  for (const ClientId id : lost) part_with(id, "replaced", "the page has another connection now");
}

void Hub::greet(Client& client, const Hello& hello) {
  if (client.has_said_hello) return refuse_message(client.who.client, "malformed", "hello was said already");
  const std::optional<Role> role = role_for(hello.token);
  if (!role)
    return part_with(client.who.client, "bad_token", "this token opens nothing; ask who runs the server for one");
  const Role wished = hello.role ? std::min(*hello.role, *role) : *role;
  replace(hello.page);
  const auto known = std::ranges::count_if(clients_, [](const auto& one) { return one.second.has_said_hello; });
  if (static_cast<std::size_t>(known) >= places_for(wished))
    return part_with(
        client.who.client, "too_many",
        fmt::format("full: {} comes in while fewer than {} are here; close other pages, or try again later",
                    name_of(wished), places_for(wished)));
  client.has_said_hello = true;
  client.page = hello.page;
  client.who.role = wished;
  client.who.name = name_or(hello.name, client.who.client);
  if (hello.confirms) client.line->pace();
  show_everything(client);
  tell_presence();
}

double Hub::steady_ms() const { return std::chrono::duration<double, std::milli>(links_.now()).count(); }

void Hub::show_everything(Client& client) {
  const auto say = [&client](const Json& json) {
    client.line->say(std::make_shared<const std::string>(in_text(json)));
  };
  say(hello_json(client.who, setup_.program, setup_.run, wants_login(), steady_ms()));
  if (mission_message_) client.line->say(mission_message_);
  if (targets_message_) client.line->say(targets_message_);
  if (!events_.empty()) say(events_json({events_.begin(), events_.end()}));
  if (!flight_) return;
  say(status());
  client.line->show(ClientLine::Latest::kTrails,
                    std::make_shared<const std::string>(trails_frame(trails_->trails(), flight_->epoch())));
  client.line->show(ClientLine::Latest::kHistory,
                    std::make_shared<const std::string>(history_frame(*history_, flight_->epoch())));
  if (density_) client.line->show(ClientLine::Latest::kDensity, density_);
  if (coverage_) client.line->show(ClientLine::Latest::kCoverage, coverage_);
  if (age_) client.line->show(ClientLine::Latest::kAge, age_);
}

void Hub::tell_presence() {
  std::vector<Operator> present;
  for (const auto& [id, client] : clients_)
    if (client.has_said_hello) present.push_back(client.who);
  say_to_all(presence_json(present));
}

void Hub::say_to_all(const Json& json) {
  const SharedBytes text = std::make_shared<const std::string>(in_text(json));
  for (const auto& [id, client] : clients_)
    if (client.has_said_hello) client.line->say(text);
}

void Hub::show_to_all(ClientLine::Latest kind, const SharedBytes& bytes) {
  for (const auto& [id, client] : clients_)
    if (client.has_said_hello) client.line->show(kind, bytes);
}

void Hub::command(const ClientMessage& message, Role role, const std::string& by, Reply reply) {
  execute(message, {0, role, by}, std::move(reply));
}

void Hub::execute(const ClientMessage& message, const Author& author, Reply reply) {
  const std::uint64_t id = message.id.value_or(0);
  const Role least = console::role_for(message.body);
  if (author.role < least)
    return reply(refused_json({id, "not_allowed", fmt::format("{} needs the role {}", message.type, name_of(least))}));
  if (std::holds_alternative<Ping>(message.body)) return reply(pong_json(id, links_.wall_ms(), steady_ms()));
  if (const auto* editing = std::get_if<Editing>(&message.body)) {
    set_editing(author.client, *editing);
    return reply(ack_json(id, {.tick = frame_ ? frame_->snapshot.tick : 0}));
  }
  if (!flight_) return reply(refused_json({id, "not_now", "no mission is being flown yet"}));
  if (const std::string_view reason = unfit(message.body, *flight_); !reason.empty())
    return reply(refused_json({id, "not_now", std::string(reason)}));
  if (waiting_.size() >= kMostWaiting) return reply(refused_json({id, "busy", "too many commands wait; try again"}));
  const std::uint64_t ticket = expect(message, author, std::move(reply));
  dispatch(message, author, ticket);
}

std::uint64_t Hub::expect(const ClientMessage& message, const Author& author, Reply reply) {
  const std::uint64_t ticket = next_ticket_++;
  Waiting waiting;
  waiting.id = message.id.value_or(0);
  waiting.what = message.type;
  waiting.by = author.name;
  waiting.reply = std::move(reply);
  if (std::holds_alternative<PreviewDensity>(message.body)) waiting.preview_for = author.client;
  if (const auto* wish = std::get_if<DroneWish>(&message.body))
    waiting.drones = wish->all ? "all" : in_words(wish->drones);
  waiting_.emplace(ticket, std::move(waiting));
  return ticket;
}

void Hub::dispatch(const ClientMessage& message, const Author& author, std::uint64_t ticket) {
  const std::string by = author.name;
  const auto clock = [&](runtime::LiveCommand::Kind kind) {
    runtime::LiveCommand command;
    command.kind = kind;
    submit({command}, ticket);
  };
  const auto swarm = [&](swarm::CommandKind kind) {
    runtime::LiveCommand command;
    command.swarm.kind = kind;
    submit({command}, ticket);
  };
  std::visit(Overloaded{
                 [&](const DroneWish& body) { wish(body, ticket); },
                 [&](const Edit& body) {
                   change_targets(body.seen, ticket,
                                  [=](Desk& desk) { desk.edit(ticket, body.edits, body.based_on, by); });
                 },
                 [&](const PreviewDensity& body) { preview(body, author, message.id.value_or(0), ticket); },
                 [&](const Preview& body) { look_ahead(body, author, ticket); },
                 [&](const Why& body) { explain(body, author, ticket); },
                 [&](const Undo& body) {
                   change_targets(body.seen, ticket, [=](Desk& desk) { desk.undo(ticket, body.based_on, by); });
                 },
                 [&](const Redo& body) {
                   change_targets(body.seen, ticket, [=](Desk& desk) { desk.redo(ticket, body.based_on, by); });
                 },
                 [&](const LoadMission& body) {
                   ask_desk(ticket, [ticket, yaml = body.yaml](Desk& desk) { desk.load_mission(ticket, yaml); });
                 },
                 [&](const StartAfresh&) { swarm(swarm::CommandKind::kStartAfresh); },
                 [&](const SetSpeed& body) { set_speed(body.factor, ticket); },
                 [&](const Pause&) { clock(runtime::LiveCommand::Kind::kPause); },
                 [&](const ResumeClock&) { clock(runtime::LiveCommand::Kind::kResumeClock); },
                 [&](const Seek& body) {
                   runtime::LiveCommand command;
                   command.kind = runtime::LiveCommand::Kind::kSeek;
                   command.seek_s = body.time_s;
                   submit({command}, ticket);
                 },
                 [&](const StepTicks& body) {
                   runtime::LiveCommand command;
                   command.kind = runtime::LiveCommand::Kind::kStep;
                   command.steps = body.ticks;
                   submit({command}, ticket);
                 },
                 [](const auto&) {},  // answered before
             },
             message.body);
}

void Hub::set_speed(double factor, std::uint64_t ticket) {
  const bool is_recording = flight_->is_recording();
  const double least = is_recording ? runtime::ReplayLoop::kLeastSpeed : 1.0;
  const double most = is_recording ? runtime::ReplayLoop::kMostSpeed : kMostSpeed;
  if (!(factor >= least && factor <= most))
    return refuse(ticket, "invalid", fmt::format("factor: must be in [{}, {}]", least, most));
  runtime::LiveCommand command;
  command.kind = runtime::LiveCommand::Kind::kSetSpeed;
  command.speed = factor;
  submit({command}, ticket);
}

/// Its index; refused where it is not there.
std::optional<std::size_t> Hub::drone_named(const std::string& id, std::uint64_t ticket) {
  const auto found = drone_index_.find(id);
  if (found != drone_index_.end()) return found->second;
  refuse(ticket, "unknown_drone", fmt::format("there is no drone {}", runtime::on_one_line(id, 60)));
  return std::nullopt;
}

/// The drones that a wish names; refused where one of them is not there.
std::optional<std::vector<std::size_t>> Hub::drones_of(const DroneWish& wish, std::uint64_t ticket) {
  std::vector<std::size_t> drones;
  if (wish.all)
    for (std::size_t i = 0; i < flight_->mission().drones.size(); ++i) drones.push_back(i);
  for (const std::string& id : wish.drones) {
    const auto drone = drone_named(id, ticket);
    if (!drone) return std::nullopt;
    drones.push_back(*drone);
  }
  return drones;
}

bool Hub::is_of_this_flight(const SeenFlight& seen) const {
  return seen.run.value_or(setup_.run) == setup_.run && seen.epoch.value_or(flight_->epoch()) == flight_->epoch();
}

/// To take a mark back is a decision about one drone: to resume all does not.
bool Hub::is_marked_failed(std::size_t drone) const {
  return frame_ && frame_->snapshot.drones[drone].activity == swarm::Activity::kMarkedFailed;
}

/// All motors stop whichever flight somebody was looking at; all else could reach a drone that only has the name of
/// another.
void Hub::wish(const DroneWish& wish, std::uint64_t ticket) {
  const bool stops_all = wish.kind == swarm::CommandKind::kEmergencyStop && wish.all;
  if (!stops_all && !is_of_this_flight(wish.seen))
    return refuse(ticket, "stale", "another flight has begun since; look at its drones, then order again");
  const auto drones = drones_of(wish, ticket);
  if (!drones) return;
  const runtime::Mission& mission = flight_->mission();
  const field::Field field = runtime::monitored_field(mission);
  const field::WorldFrame world = runtime::world_frame(mission);
  std::vector<runtime::LiveCommand> commands;
  for (const std::size_t drone : *drones) {
    if (wish.all && wish.kind == swarm::CommandKind::kResume && is_marked_failed(drone)) continue;
    runtime::LiveCommand command;
    command.swarm.kind = wish.kind;
    command.swarm.drone = swarm::DroneId(drone);
    const Vec2 place = world.point_to_field(wish.place_m.value_or(mission.drones[drone].start_m));
    if (wish.kind == swarm::CommandKind::kGoTo && wish.place_m && !field.contains(place))
      return refuse(ticket, "invalid", "place_m: is outside the field; choose a place inside it");
    if (wish.kind == swarm::CommandKind::kGoTo) command.swarm.place = field.clamp(place);
    commands.push_back(command);
  }
  if (commands.empty()) return refuse(ticket, "not_now", "all drones are marked as failed; resume them by their names");
  GivenOrder given{ticket, {}};
  for (const runtime::LiveCommand& command : commands) given.commands.push_back(command.swarm);
  submit(std::move(commands), ticket);
  const auto waiting = waiting_.find(ticket);
  if (!is_kept_ || waiting == waiting_.end()) return;
  waiting->second.is_kept = false;
  unkept_.push_back(std::move(given));
  keep_orders();
}

/// Drones follow an order at the next tick, whatever the disk does; it is answered when both are done.
void Hub::keep_orders() {
  if (unkept_.empty() || is_keeping_) return;
  const auto task = [epoch = flight_->epoch(), orders = unkept_](Desk& desk) { desk.keep(epoch, orders); };
  is_keeping_ = links_.at_desk(task);
  if (is_keeping_) unkept_.clear();
}

void Hub::submit(std::vector<runtime::LiveCommand> commands, std::uint64_t ticket) {
  for (runtime::LiveCommand& command : commands) {
    command.ticket = ticket;
    command.is_last_of_ticket = false;
  }
  commands.back().is_last_of_ticket = true;
  if (!flight_->submit(std::move(commands)))
    return refuse(ticket, "busy", "too many commands wait for the next tick; try again");
  wait_for_control(waiting_.at(ticket));
}

void Hub::wait_for_control(Waiting& waiting) const {
  waiting.is_at_control = true;
  waiting.answer_by = links_.now() + 100ms;
}

void Hub::ask_desk(std::uint64_t ticket, std::function<void(Desk&)> task) {
  waiting_.at(ticket).wants_revision = true;
  if (!links_.at_desk(std::move(task))) refuse(ticket, "busy", "too many changes wait; try again");
}

/// Revisions begin anew with each mission: a change is made to targets of the flight that it was meant for, or not at
/// all, also where another one begins before the desk comes to it.
void Hub::change_targets(const SeenFlight& seen, std::uint64_t ticket, std::function<void(Desk&)> change) {
  if (!is_of_this_flight(seen)) return refuse(ticket, "stale", "another flight has begun since; look at its targets");
  ask_desk(ticket, [epoch = flight_->epoch(), ticket, change = std::move(change)](Desk& desk) {
    if (desk.still_flies(epoch, ticket)) change(desk);
  });
}

void Hub::preview(const PreviewDensity& body, const Author& author, std::uint64_t request, std::uint64_t ticket) {
  const auto client = clients_.find(author.client);
  auto newest =
      client == clients_.end() ? std::make_shared<std::atomic<std::uint64_t>>(ticket) : client->second.newest_preview;
  newest->store(ticket, std::memory_order_relaxed);
  ask_desk(ticket, [=, edits = body.edits, based_on = body.based_on](Desk& desk) {
    desk.preview(ticket, *newest, request, edits, based_on);
  });
}

void Hub::look_ahead(const Preview& body, const Author& author, std::uint64_t ticket) {
  DroneWish named;
  named.drones = body.without;
  const auto without = drones_of(named, ticket);
  if (!without) return;
  ask_desk(ticket, [=, asker = author.client](Desk& desk) { desk.look_ahead(ticket, asker, body, *without); });
}

void Hub::explain(const Why& body, const Author& author, std::uint64_t ticket) {
  const auto drone = drone_named(body.drone, ticket);
  if (!drone) return;
  // Whoever asks without a connection stands for nobody else: tickets go on from where clients' numbers cannot be.
  constexpr std::uint64_t kBeyondClients = std::uint64_t{1} << 32U;
  const WhyQuestion question{ticket, author.client != 0 ? author.client : kBeyondClients + ticket, *drone};
  if (!flight_->is_recording()) return ask_desk(ticket, [question](Desk& desk) { desk.explain(question); });
  if (!links_.at_recording || !links_.at_recording(question)) refuse(ticket, "busy", kTooManyQuestions);
}

void Hub::refuse(std::uint64_t ticket, std::string_view code, std::string reason) {
  const auto found = waiting_.find(ticket);
  if (found == waiting_.end()) return;
  const Waiting waiting = std::move(found->second);
  waiting_.erase(found);
  waiting.reply(refused_json({waiting.id, code, std::move(reason)}));
}

void Hub::set_editing(ClientId client, const Editing& editing) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  found->second.who.editing = editing.what;
  tell_presence();
}

}  // namespace vigil::console
