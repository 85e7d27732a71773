// What the hub hears from the desk and from the flight, and passes on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/hub.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using runtime::Severity;

constexpr auto kSnapshotEvery = 50ms;
constexpr auto kStatusEvery = 500ms;
constexpr auto kHelloWithin = 10s;

SharedBytes shared(std::string bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

double milliseconds(std::chrono::nanoseconds time) { return std::chrono::duration<double, std::milli>(time).count(); }

/// Until the next snapshot: the more drones there are, the larger it is, and the longer it takes to make it.
std::chrono::nanoseconds pause_after(std::size_t bytes, std::chrono::nanoseconds made_in) {
  constexpr double kMostBytesPerS = 4e6;
  constexpr int kShareOfTime = 4;  // at most a quarter: the same thread answers
  const std::chrono::duration<double> by_bytes(static_cast<double>(bytes) / kMostBytesPerS);
  return std::max({std::chrono::nanoseconds(kSnapshotEvery),
                   std::chrono::duration_cast<std::chrono::nanoseconds>(by_bytes), kShareOfTime * made_in});
}

/// "go to cf1, cf2" for "go_to"; "land_all" names its drones itself.
std::string order_words(std::string what, const std::string& drones) {
  const bool names_them = drones.empty() || what == "land_all";
  std::ranges::replace(what, '_', ' ');
  return names_them ? what : what + " " + drones;
}

}  // namespace

std::string Hub::drone_id(std::size_t index) const {
  const std::vector<runtime::DroneEntry>& drones = flight_->mission().drones;
  return index < drones.size() ? drones[index].id : std::string();
}

void Hub::take(DeskNews news) {
  if (const auto* flight = std::get_if<FlightNews>(&news)) take(*flight);
  if (const auto* recording = std::get_if<RecordingNews>(&news)) take(*recording);
  if (const auto* history = std::get_if<HistoryNews>(&news)) take(*history);
  if (const auto* targets = std::get_if<TargetsNews>(&news)) take(*targets);
  if (const auto* ground = std::get_if<GroundNews>(&news)) take(*ground);
  if (const auto* answer = std::get_if<DeskAnswer>(&news)) take(*answer);
  if (const auto* outlook = std::get_if<PreviewNews>(&news)) take(*outlook);
  if (auto* refusal = std::get_if<DeskRefusal>(&news))
    refuse(refusal->ticket, refusal->code, std::move(refusal->reason));
  if (const auto* acceptance = std::get_if<DeskAcceptance>(&news)) {
    const auto found = waiting_.find(acceptance->ticket);
    if (found != waiting_.end()) wait_for_control(found->second);
  }
  if (const auto* kept = std::get_if<OrdersKept>(&news)) take(*kept);
  if (const auto* trouble = std::get_if<DeskTrouble>(&news))
    log({.source = "program", .what = "trouble", .words = {Severity::kWarning, trouble->text, "", ""}});
}

/// What was asked of a flight that has ended will not be answered by it.
void Hub::give_up_waiting() {
  std::vector<Waiting> lost;
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    if (it->second.is_at_control) {
      lost.push_back(std::move(it->second));
      it = waiting_.erase(it);
    } else {
      ++it;
    }
  }
  for (const Waiting& waiting : lost)
    if (!waiting.answer.is_pending)
      waiting.reply(refused_json({waiting.id, "not_now", "another mission was loaded meanwhile"}));
}

void Hub::show_flight(std::shared_ptr<runtime::ShownFlight> flight, SharedBytes mission) {
  give_up_waiting();
  unkept_.clear();
  is_kept_ = false;
  flight_ = std::move(flight);
  replay_.reset();
  mission_message_ = std::move(mission);
  targets_message_.reset();
  density_.reset();
  coverage_.reset();
  age_.reset();
  areas_.clear();
  frame_.emplace(flight_->mission().drones.size());
  frame_version_ = 0;
  clock_version_ = 0;
  shown_.emplace(flight_->mission().drones.size());
  trails_.emplace(flight_->mission().drones.size());
  history_.emplace(flight_->mission().drones.size());
  drone_index_.clear();
  for (std::size_t i = 0; i < flight_->mission().drones.size(); ++i) drone_index_.emplace(drone_id(i), i);
  has_told_lost_ticks_ = false;
  has_told_trouble_ = false;
  for (const auto& [id, client] : clients_)
    if (client.has_said_hello) client.line->say(mission_message_);
}

void Hub::take(const RecordingNews& news) {
  show_flight(news.recording, news.mission);
  replay_.emplace();
  waits_for_resume_ = false;
}

void Hub::take(const HistoryNews& news) {
  replay_ = news.state;
  if (news.plots) history_ = news.plots;
  if (news.state.is_seeking) next_status_ = {};
  if (!news.is_afresh) {
    for (const ConsoleEvent& event : news.events) keep_event(event_json(event));
    return;
  }
  events_.clear();
  new_events_.clear();
  for (const ConsoleEvent& event : news.events) keep_event(event_json(event));
  new_events_.clear();
  say_to_all(events_afresh_json({events_.begin(), events_.end()}));
  if (news.trails) trails_ = news.trails;
  show_to_all(ClientLine::Latest::kTrails, shared(trails_frame(trails_->trails(), flight_->epoch())));
  show_to_all(ClientLine::Latest::kHistory, shared(history_frame(*history_, flight_->epoch())));
  next_status_ = {};
}

void Hub::take(const FlightNews& news) {
  show_flight(news.flight, news.mission);
  waits_for_resume_ = news.is_restored;
  is_kept_ = news.is_kept;
  runtime::EventWords words{Severity::kInfo, fmt::format("mission {} begins", flight_->mission().name), "", ""};
  if (news.is_restored)
    words = {
        Severity::kWarning, fmt::format("mission {} goes on after a restart of the program", flight_->mission().name),
        std::string(runtime::after_restart(news.flight->has_real_drones())), "look whether all is well, then resume"};
  log({.source = "program", .what = news.is_restored ? "restored" : "begins", .words = std::move(words)});
}

void Hub::take(const TargetsNews& news) {
  targets_message_ = news.targets;
  density_ = news.density;
  mission_ = news.mission;
  const bool is_change = !news.what.empty();
  revision_ = news.revision;
  for (const auto& [id, client] : clients_)
    if (client.has_said_hello) client.line->say(targets_message_);
  show_to_all(ClientLine::Latest::kDensity, density_);
  if (is_change)
    log({.source = news.by == "mission" ? "mission" : "operator",
         .what = "edit",
         .by = news.by,
         .words = {Severity::kInfo, news.what, "", ""}});
}

void Hub::take(const GroundNews& news) {
  areas_ = news.areas;
  coverage_ = news.coverage;
  age_ = news.age;
  show_to_all(ClientLine::Latest::kCoverage, coverage_);
  show_to_all(ClientLine::Latest::kAge, age_);
  for (const runtime::DeadlineChange& change : news.deadlines) {
    runtime::EventWords words{Severity::kInfo, fmt::format("{} is seen in time again", change.what.name), "", ""};
    if (change.is_overdue)
      words = {Severity::kAlarm,
               fmt::format("{}: part of it unseen for {:.0f} s, longer than {:.6g} s", change.what.name, change.age_s,
                           change.deadline_s),
               "", "give it more weight, or the swarm more drones"};
    log({.tick = news.tick,
         .time_s = news.time_s,
         .source = "swarm",
         .what = change.is_overdue ? "overdue" : "seen_again",
         .words = std::move(words)});
  }
  if (news.foresight)
    log({.tick = news.tick, .time_s = news.time_s, .source = "swarm", .what = "deadlines", .words = *news.foresight});
}

void Hub::take(const DeskAnswer& news) {
  const auto found = waiting_.find(news.ticket);
  if (found == waiting_.end()) return;
  const Waiting waiting = std::move(found->second);
  waiting_.erase(found);
  const auto client = clients_.find(waiting.preview_for);
  if (news.preview && client != clients_.end()) client->second.line->show(ClientLine::Latest::kPreview, news.preview);
  waiting.reply(ack_json(waiting.id, {frame_ ? frame_->snapshot.tick : 0, false, news.revision, {}}));
}

void Hub::take(const OrdersKept& news) {
  is_keeping_ = false;
  for (const std::uint64_t ticket : news.tickets) {
    const auto found = waiting_.find(ticket);
    if (found == waiting_.end()) continue;
    found->second.is_kept = true;
    if (const auto outcome = found->second.outcome) hear_answer(*outcome);
  }
  if (flight_) keep_orders();
}

void Hub::take(const PreviewNews& news) {
  const auto found = waiting_.find(news.ticket);
  if (found == waiting_.end()) return;
  const Waiting waiting = std::move(found->second);
  waiting_.erase(found);
  Json answer = news.answer;
  answer["id"] = waiting.id;
  waiting.reply(answer);
}

void Hub::answer_pending(std::chrono::nanoseconds now) {
  for (auto& [ticket, waiting] : waiting_) {
    if (!waiting.is_kept || !waiting.answer_by || now < *waiting.answer_by) continue;
    waiting.answer_by.reset();
    waiting.answer.is_pending = true;
    Answer answer{frame_->snapshot.tick + 1, true, {}, {}};
    if (waiting.wants_revision) answer.revision = revision_;
    waiting.reply(ack_json(waiting.id, answer));
  }
}

void Hub::drop_the_silent(std::chrono::nanoseconds now) {
  std::vector<ClientId> silent;
  for (const auto& [id, client] : clients_)
    if (!client.has_said_hello && now - client.connected_at > kHelloWithin) silent.push_back(id);
  for (const ClientId id : silent) part_with(id, "no_hello", "nobody said hello");
}

void Hub::poll() {
  const std::chrono::nanoseconds now = links_.now();
  drop_the_silent(now);
  if (!flight_) return;
  keep_orders();
  flight_->read(clock_, clock_version_);
  if (now >= next_snapshot_) send_snapshot(now);
  hear_all(flight_->take_events());
  answer_pending(now);
  send_events();
  if (now >= next_status_) {
    next_status_ = now + kStatusEvery;
    watch_recorder();
    send_status();
  }
}

void Hub::watch_recorder() {
  const runtime::QueuedRecorder* recorder = flight_->recorder();
  if (recorder == nullptr) return;
  const auto tell = [this](bool& has_told, const std::string& text, const char* effect, const char* next) {
    if (!std::exchange(has_told, true))
      log({.source = "program", .what = "recording", .words = {Severity::kAlarm, text, effect, next}});
  };
  const std::string trouble = recorder->trouble();
  if (!trouble.empty())
    tell(has_told_trouble_, "nothing more is recorded: " + trouble, "the flight goes on, and leaves no trace from here",
         "make room and load the mission anew, or fly on without a recording");
  if (recorder->lost_ticks() > 0)
    tell(has_told_lost_ticks_, "the recording has a gap: the disk is too slow",
         "from here on it can be looked at, but not recomputed", "record to a faster disk, or every Nth tick");
}

void Hub::send_snapshot(std::chrono::nanoseconds now) {
  next_snapshot_ = now + kSnapshotEvery;
  const bool is_new = flight_->read(*frame_, frame_version_);
  if (!frame_->has_ticked) return;
  // A recording does not grow older, nor does a world that stands still.
  const bool stands = flight_->is_recording() || clock_.is_paused;
  const std::chrono::nanoseconds age = stands ? 0ns : now - frame_->computed_at;
  double worst_age_s = std::numeric_limits<double>::quiet_NaN();
  for (const runtime::AreaState& area : areas_) worst_age_s = std::fmax(worst_age_s, area.age_s);
  if (is_new) trails_->add(frame_->snapshot);
  // A recording's thread knows of the ticks between two frames, too, and tells of them.
  if (is_new && !flight_->is_recording()) history_->add(frame_->snapshot, worst_age_s);
  const runtime::QueuedRecorder* recorder = flight_->recorder();
  const SnapshotContext context{
      .epoch = flight_->epoch(),
      .wall_ms = links_.wall_ms() - milliseconds(age),
      .age_s = std::chrono::duration<double>(age).count(),
      .worst_age_s = worst_age_s,
      .speed_limit_m_s = flight_->mission().control.speed_limit_m_s,
      .steady_ms = steady_ms() - milliseconds(age),
      .lost_ticks = recorder == nullptr ? 0 : static_cast<std::uint32_t>(recorder->lost_ticks())};
  const SharedBytes frame = shared(snapshot_frame(*frame_, clock_, context, *shown_));
  show_to_all(ClientLine::Latest::kSnapshot, frame);
  next_snapshot_ = now + pause_after(frame->size(), links_.now() - now);
}

void Hub::list_waiting(StatusContext& context) const {
  std::map<std::uint64_t, const Waiting*> in_order;  // by ticket: the oldest first
  for (const auto& [ticket, waiting] : waiting_)
    if (waiting.is_at_control && waiting.answer.is_pending) in_order.emplace(ticket, &waiting);
  for (const auto& [ticket, waiting] : in_order) {
    if (context.waiting.size() == kMostWaitingShown) break;
    context.waiting.push_back({order_words(waiting->what, waiting->drones), waiting->by});
  }
  context.waiting_more = in_order.size() - context.waiting.size();
}

Json Hub::status() const {
  StatusContext context{.epoch = flight_->epoch(),
                        .recording = {},
                        .lost_events = flight_->lost_events(),
                        .clients = clients_.size(),
                        .lateness = clock_.lateness,
                        .lateness_ever = clock_.lateness_ever,
                        .waits_for_resume = waits_for_resume_,
                        .waiting = {},
                        .waiting_more = 0,
                        .replay = replay_,
                        .plan = {}};
  if (!flight_->is_recording()) list_waiting(context);
  if (!flight_->mission().stations.empty()) context.plan = frame_->snapshot.drones;
  if (const runtime::QueuedRecorder* recorder = flight_->recorder())
    context.recording = RecordingState{setup_.recording_folder, recorder->kept_ticks(), recorder->lost_ticks()};
  return status_json(areas_, context);
}

void Hub::send_status() { show_to_all(ClientLine::Latest::kStatus, shared(in_text(status()))); }

Json Hub::state() const {
  if (!flight_ || !frame_->has_ticked) return Json(nullptr);
  const swarm::Snapshot& snapshot = frame_->snapshot;
  const field::WorldFrame world = runtime::world_frame(flight_->mission());
  Json drones = Json::array();
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
    const swarm::DroneSnapshot& drone = snapshot.drones[i];
    const Vec2 place = world.point_to_world(drone.position);
    const Vec2 velocity = world.vector_to_world(drone.velocity);
    const std::optional<swarm::TimeLeft>& time_left = drone.time_left;
    drones.push_back({{"id", drone_id(i)},
                      {"mode", swarm::name_of(drone.mode)},
                      {"activity", swarm::name_of(drone.activity)},
                      {"position_m", {place.x(), place.y()}},
                      {"height_m", drone.height_m},
                      {"velocity_m_s", {velocity.x(), velocity.y()}},
                      {"age_s", drone.age_s},
                      {"link_age_s", drone.link_age_s},
                      {"battery", drone.battery},
                      {"battery_time_left_s", time_left ? Json(time_left->s) : Json(nullptr)},
                      {"battery_time_left_least_s", time_left ? Json(time_left->least_s) : Json(nullptr)},
                      {"pad", drone.pad >= 0 ? Json(drone.pad) : Json(nullptr)},
                      {"leaves_in_s", finite_or_null(drone.leaves_in_s)},
                      {"away_for_s", finite_or_null(drone.away_for_s)}});
  }
  Json state{{"run", setup_.run},
             {"epoch", flight_->epoch()},
             {"revision", revision_},
             {"tick", snapshot.tick},
             {"time_s", snapshot.time_s},
             {"speed", clock_.speed},
             {"is_paused", clock_.is_paused},
             {"has_metric", snapshot.has_metric},
             {"metric", snapshot.metric},
             {"metric_percent", snapshot.metric_percent},
             {"active", snapshot.active},
             {"idle", swarm::name_of(snapshot.idle)},
             {"drones", std::move(drones)}};
  const Json more = status();
  for (const char* member : {"areas", "recording", "clients", "lateness_us", "lateness_ever_us", "waits_for_resume",
                             "waiting", "waiting_more", "replay"})
    state[member] = more.at(member);
  return state;
}

}  // namespace vigil::console
