#include "vigil/adapters/console/desk.hpp"

#include <mutex>
#include <utility>

#include "vigil/adapters/console/density_picture.hpp"
#include "vigil/adapters/console/frames.hpp"
#include "vigil/adapters/console/preview_job.hpp"
#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/adapters/console/why_answer.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/standing_orders.hpp"

namespace vigil::console {
namespace {

constexpr Eigen::Index kPreviewCells = 96;
constexpr std::size_t kRecentTargets = 64;
constexpr int kLooksASave = 5;
constexpr double kSaveEveryS = 1.0;  ///< mission time, at most

SharedBytes shared(std::string bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

/// Where the drones of a flight are before its first tick.
std::vector<runtime::SavedFlight::Drone> first_drones(const runtime::Mission& mission) {
  const swarm::Intent order = runtime::first_intent(mission);
  const bool are_down = order == swarm::Intent::kStayDown;
  std::vector<runtime::SavedFlight::Drone> drones;
  for (const Vec2& start : runtime::starts_in_field(mission)) drones.push_back({start, are_down, order});
  return drones;
}

}  // namespace

Desk::Desk(MakeFlight make_flight, Tell tell, std::shared_ptr<runtime::FlightStore> store)
    : make_flight_(std::move(make_flight)), tell_(std::move(tell)), store_(std::move(store)) {}

void Desk::begin(const runtime::Mission& mission, const runtime::SavedFlight* saved) {
  std::shared_ptr<runtime::LiveMission> flight = make_flight_(mission, epoch_ + 1, saved);
  ++epoch_;
  if (flight_) finish_flight();
  flight_ = std::move(flight);
  mission_text_ = saved != nullptr ? saved->mission_text : runtime::mission_yaml(mission);
  desk_.emplace(mission, saved != nullptr ? saved->revision : 1, saved != nullptr ? "restored" : "mission");
  ground_.emplace(mission);
  if (saved != nullptr && !ground_->seen().restore(saved->seen_s))
    tell_(DeskTrouble{"what was seen before the restart is not known: the state's map has another size"});
  drones_ = saved != nullptr ? saved->drones : first_drones(mission);
  frame_.emplace(mission.drones.size());
  frame_version_ = 0;
  has_new_frame_ = false;
  unsent_.reset();
  untaken_.clear();
  const Json message = mission_message(mission, epoch_, flight_->has_real_drones());
  tell_(FlightNews{flight_, shared(in_text(message)), saved != nullptr, store_ != nullptr});
  if (saved != nullptr) {
    frame_->past = saved->past;
    frame_->snapshot.time_s = static_cast<double>(saved->past.ticks) * runtime::tick_s(mission);
  }
  retarget(0);
  flight_->start();
}

void Desk::finish_flight() {
  try {
    flight_->finish();
  } catch (const std::exception& error) {
    tell_(DeskTrouble{std::string("the recording: ") + error.what()});
  }
}

/// Saves first: nobody hears of targets, and no tick uses them, that a crash could still undo.
void Desk::retarget(std::uint64_t ticket) {
  save();
  if (ticket != 0) tell_(DeskAcceptance{ticket});
  const runtime::Mission& mission = desk_->mission();
  const DensityContext context{.epoch = epoch_, .revision = static_cast<std::uint32_t>(desk_->revision())};
  tell_(TargetsNews{shared(in_text(targets_json(*desk_, epoch_))),
                    shared(density_picture(mission, kDensityCells, context)), desk_->revision(), desk_->by(),
                    desk_->what(), mission});
  recent_targets_.push_back(runtime::coverage_target(mission, ground_->basis()));
  if (recent_targets_.size() > kRecentTargets) recent_targets_.pop_front();
  runtime::LiveCommand command;
  command.swarm = {.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = recent_targets_.back()};
  command.revision = desk_->revision();
  command.ticket = ticket;
  unsent_ = command;
  if (flight_->recorder() != nullptr) flight_->recorder()->expect(recent_targets_.back(), runtime::targets_of(mission));
  submit_target();
  ground_->retarget(mission, *recent_targets_.back(), frame_->snapshot.time_s);
  foresight_.retarget(mission);
}

void Desk::submit_target() {
  if (unsent_ && flight_->loop().submit({*unsent_})) unsent_.reset();
}

void Desk::refuse(std::uint64_t ticket, std::string_view code, std::string reason) {
  if (ticket != 0) tell_(DeskRefusal{ticket, code, std::move(reason)});
}

void Desk::finish_change(std::uint64_t ticket, const std::optional<runtime::Refusal>& refusal) {
  if (refusal) return refuse(ticket, code_of(refusal->code), refusal->reason);
  retarget(ticket);
}

bool Desk::still_flies(std::uint32_t epoch, std::uint64_t ticket) {
  if (epoch == epoch_) return true;
  refuse(ticket, "stale", "another flight has begun since; look at its targets");
  return false;
}

void Desk::edit(std::uint64_t ticket, const std::vector<runtime::TargetEdit>& edits, std::uint64_t based_on,
                const std::string& by) {
  finish_change(ticket, desk_->edit(edits, based_on, by));
}

void Desk::undo(std::uint64_t ticket, std::uint64_t based_on, const std::string& by) {
  finish_change(ticket, desk_->undo(based_on, by));
}

void Desk::redo(std::uint64_t ticket, std::uint64_t based_on, const std::string& by) {
  finish_change(ticket, desk_->redo(based_on, by));
}

void Desk::preview(std::uint64_t ticket, const std::atomic<std::uint64_t>& newest, std::uint64_t request,
                   const std::vector<runtime::TargetEdit>& edits, std::uint64_t based_on) {
  if (newest.load(std::memory_order_relaxed) != ticket)
    return refuse(ticket, "superseded", "a newer preview was asked for");
  std::variant<runtime::Mission, runtime::Refusal> draft = desk_->draft(edits, based_on);
  if (const auto* refusal = std::get_if<runtime::Refusal>(&draft))
    return refuse(ticket, code_of(refusal->code), refusal->reason);
  const DensityContext context{.epoch = epoch_,
                               .revision = static_cast<std::uint32_t>(desk_->revision()),
                               .is_preview = true,
                               .request = request};
  tell_(DeskAnswer{ticket, desk_->revision(),
                   shared(density_picture(std::get<runtime::Mission>(draft), kPreviewCells, context))});
}

void Desk::look_ahead(std::uint64_t ticket, std::uint64_t asker, const Preview& request,
                      const std::vector<std::size_t>& without) {
  PreviewJob job{ticket, flight_, ground_->watch(), desk_->revision(), {}};
  job.question.seconds = request.seconds;
  for (const std::size_t drone : without) job.question.without.emplace_back(drone);
  if (request.based_on) {
    std::variant<runtime::Mission, runtime::Refusal> draft = desk_->draft(request.edits, *request.based_on);
    if (const auto* refusal = std::get_if<runtime::Refusal>(&draft))
      return refuse(ticket, code_of(refusal->code), refusal->reason);
    job.question.targets = std::get<runtime::Mission>(std::move(draft));
  }
  const auto work = [tell = tell_, job = std::move(job)](const std::atomic<bool>& cancelled) {
    tell(answer_of(job, cancelled));
  };
  if (!previews_.submit(asker, work)) refuse(ticket, "busy", "too many previews wait; try again");
}

void Desk::explain(const WhyQuestion& question) {
  const auto work = [tell = tell_, flight = flight_, question](const std::atomic<bool>& cancelled) {
    tell(answer_of(question, *flight, cancelled));
  };
  if (!questions_.submit(question.asker, work)) refuse(question.ticket, "busy", kTooManyQuestions);
}

void Desk::load_mission(std::uint64_t ticket, const std::string& yaml) {
  try {
    begin(runtime::parse_mission(yaml, "the mission"), nullptr);
    tell_(DeskAnswer{ticket, desk_->revision(), nullptr});
  } catch (const std::exception& error) {
    refuse(ticket, "invalid", error.what());
  }
}

void Desk::play(std::uint32_t epoch, std::size_t event_index) {
  if (epoch != epoch_) return;
  const runtime::EventEntry& event = flight_->mission().simulation.events.at(event_index);
  const runtime::MissionTargets targets = runtime::targets_of(desk_->mission());
  const runtime::TargetEdit edit = runtime::edit_of(targets, event);
  if (const auto refusal = desk_->edit(std::span(&edit, 1), desk_->revision(), "mission"))
    tell_(DeskTrouble{"an event of the mission file no longer fits the targets: " + refusal->reason});
  else
    retarget(0);
}

void Desk::look() {
  if (!flight_) return;
  submit_target();
  read_frame();
  if (!std::exchange(has_new_frame_, false)) return;
  GroundNews news;
  news.deadlines = ground_->look(frame_->snapshot);
  news.areas = ground_->areas(*frame_);
  take_foreseen(news);
  look_for_deadlines();
  news.coverage = shared(coverage_frame(ground_->basis().field(), *frame_, epoch_));
  news.age = shared(age_frame(ground_->seen(), frame_->snapshot.time_s, epoch_));
  news.tick = frame_->snapshot.tick;
  news.time_s = frame_->snapshot.time_s;
  tell_(std::move(news));
  const double since_save_s = frame_->snapshot.time_s - saved_at_s_;
  if (++looks_since_save_ >= kLooksASave || since_save_s >= kSaveEveryS) save();
}

/// Looks ahead by itself. Of so many drones that it would take long nobody asks it.
void Desk::look_for_deadlines() {
  constexpr std::size_t kMostDrones = 300;
  constexpr std::uint64_t kItself = 0;  // the only asker of that thread
  const swarm::Snapshot& now = frame_->snapshot;
  if (now.drones.size() > kMostDrones || !foresight_.is_due(now.active, now.time_s)) return;
  PreviewJob job{0, flight_, ground_->watch(), desk_->revision(), {}};
  job.question.seconds = foresight_.horizon_s();
  const auto work = [job = std::move(job), foreseen = foreseen_,
                     active = now.active](const std::atomic<bool>& cancelled) {
    std::optional<std::vector<runtime::AreaOutlook>> areas = areas_ahead(job, cancelled);
    const std::scoped_lock lock(foreseen->mutex);
    foreseen->areas = std::move(areas);
    foreseen->revision = job.revision;
    foreseen->epoch = job.flight->epoch();
    foreseen->active = active;
  };
  (void)outlooks_.submit(kItself, work);  // where too many wait, there is a next time
}

void Desk::take_foreseen(GroundNews& news) {
  {
    const std::scoped_lock lock(foreseen_->mutex);
    const bool is_of_now = foreseen_->epoch == epoch_ && foreseen_->revision == desk_->revision();
    if (const auto areas = std::exchange(foreseen_->areas, std::nullopt); areas && is_of_now)
      news.foresight = foresight_.take(*areas, foreseen_->active, frame_->snapshot.drones.size());
  }
  for (runtime::AreaState& area : news.areas) area.foreseen_s = foresight_.foreseen_s(area.what);
}

void Desk::read_frame() {
  if (!flight_->loop().read(*frame_, frame_version_)) return;
  has_new_frame_ = true;
  note_drones();
  while (!untaken_.empty() && untaken_.front().ticket <= frame_->newest_order) untaken_.pop_front();
}

void Desk::note_drones() {
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    const swarm::DroneSnapshot& drone = frame_->snapshot.drones[i];
    drones_[i] = {drone.position, !runtime::is_airborne(drone), frame_->intents[i]};
  }
}

void Desk::keep(std::uint32_t epoch, std::vector<GivenOrder> orders) {
  OrdersKept kept;
  for (GivenOrder& order : orders) {
    kept.tickets.push_back(order.ticket);
    if (epoch == epoch_) untaken_.push_back(std::move(order));
  }
  if (epoch == epoch_) {
    read_frame();
    save();
  }
  tell_(std::move(kept));
}

/// The drones with the orders that will stand once the flight has taken all that it was given.
std::vector<runtime::SavedFlight::Drone> Desk::ordered_drones() const {
  std::vector<swarm::Intent> standing;
  for (const runtime::SavedFlight::Drone& drone : drones_) standing.push_back(drone.order);
  for (const GivenOrder& order : untaken_) runtime::foresee(order.commands, frame_->snapshot.drones, standing);
  std::vector<runtime::SavedFlight::Drone> drones = drones_;
  for (std::size_t i = 0; i < drones.size(); ++i) drones[i].order = standing[i];
  return drones;
}

void Desk::end() {
  look();
  save();
  if (flight_) flight_->finish();
}

void Desk::save() {
  if (!store_ || !flight_) return;
  looks_since_save_ = 0;
  saved_at_s_ = frame_->snapshot.time_s;
  runtime::SavedFlight saved;
  saved.mission_text = mission_text_;
  saved.targets_text = runtime::mission_yaml(desk_->mission());
  saved.revision = desk_->revision();
  saved.past = frame_->past;
  saved.seen_s.assign(ground_->seen().seen_s().begin(), ground_->seen().seen_s().end());
  saved.drones = ordered_drones();
  try {
    store_->save(saved);
    save_failed_ = false;
  } catch (const runtime::SavedFlightError& error) {
    if (!std::exchange(save_failed_, true)) tell_(DeskTrouble{error.what()});
  }
}

}  // namespace vigil::console
