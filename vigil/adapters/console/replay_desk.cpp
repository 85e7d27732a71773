#include "vigil/adapters/console/replay_desk.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/density_picture.hpp"
#include "vigil/adapters/console/recorded_words.hpp"
#include "vigil/adapters/console/server_messages.hpp"
#include "vigil/adapters/console/why_answer.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookEvery = 200ms;
constexpr std::size_t kMostQuestions = 64;
constexpr std::size_t kMostEvents = 1000;  ///< that are told of at once; the newest

SharedBytes shared(std::string bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

RecordingFacts facts_of(const runtime::ReplayScene& scene) {
  return {.begin_s = scene.begin_s(),
          .end_s = scene.end_s(),
          .ticks = scene.flight().tick_count(),
          .spacing_s = scene.spacing_s(),
          .incomplete = scene.recording().incomplete_reason()};
}

std::size_t events_until(const runtime::ReplayScene& scene) {
  const auto all = scene.recording().events();
  const auto after = std::ranges::upper_bound(all, scene.time_s(), {}, &runtime::LoggedEvent::time_s);
  return static_cast<std::size_t>(after - all.begin());
}

}  // namespace

ReplayDesk::ReplayDesk(std::shared_ptr<runtime::ReplayLoop> recording, Tell tell)
    : recording_(std::move(recording)), tell_(std::move(tell)) {}

void ReplayDesk::begin() {
  const runtime::ReplayScene& scene = recording_->scene();
  const Json message = recorded_mission_message(recording_->mission(), recording_->epoch(), facts_of(scene));
  tell_(RecordingNews{recording_, shared(in_text(message))});
  tell_targets();
  tell_ground();
  tell_history();
}

void ReplayDesk::tell_targets() {
  const runtime::ReplayScene& scene = recording_->scene();
  told_revision_ = scene.revision();
  const runtime::MissionDesk desk(scene.mission(), told_revision_, "recorded");
  const DensityContext context{.epoch = recording_->epoch(), .revision = static_cast<std::uint32_t>(told_revision_)};
  tell_(TargetsNews{shared(in_text(targets_json(desk, recording_->epoch()))),
                    shared(density_picture(scene.mission(), kDensityCells, context)), told_revision_, desk.by(),
                    desk.what(), scene.mission()});
}

void ReplayDesk::tell_ground() {
  const runtime::ReplayScene& scene = recording_->scene();
  runtime::LiveFrame frame(recording_->mission().drones.size());
  scene.write(frame);
  GroundNews news;
  news.areas = scene.ground().areas(frame);
  news.coverage = shared(coverage_frame(scene.ground().basis().field(), frame, recording_->epoch()));
  news.age = shared(age_frame(scene.ground().seen(), scene.time_s(), recording_->epoch()));
  news.tick = frame.snapshot.tick;
  news.time_s = scene.time_s();
  tell_(std::move(news));
  told_number_ = scene.flight().number();
}

ReplayState ReplayDesk::state() const {
  const runtime::ReplayedFlight& flight = recording_->scene().flight();
  ReplayState state{.number = flight.number(),
                    .is_recomputed = flight.is_recomputed(),
                    .is_seeking = recording_->is_seeking(),
                    .progress = recording_->progress(),
                    .is_at_end = recording_->is_at_end(),
                    .difference = {}};
  if (const auto difference = flight.difference())
    state.difference = fmt::format("{}: recorded {}, recomputed {}", difference->what, difference->recorded,
                                   difference->recomputed.empty() ? "nothing" : difference->recomputed);
  return state;
}

TrailRing ReplayDesk::trails() {
  runtime::ReplayScene& scene = recording_->scene();
  TrailRing ring(recording_->mission().drones.size());
  scene.recall(scene.time_s() - TrailRing::kKeptS, ring.points(),
               [&ring](const swarm::Snapshot& snapshot) { ring.add(snapshot); });
  return ring;
}

/// After a jump all of it, otherwise what came to it.
void ReplayDesk::tell_history() {
  const runtime::ReplayScene& scene = recording_->scene();
  HistoryNews news{.state = state(),
                   .events = {},
                   .is_afresh = is_arriving_,
                   .trails = {},
                   .plots = scene.history().until(scene.time_s())};
  const auto all = scene.recording().events();
  const std::size_t until = events_until(scene);
  const std::size_t from =
      std::max(is_arriving_ ? 0 : std::min(told_events_, until), until - std::min(until, kMostEvents));
  const double dt_s = scene.recording().head().parameters.dt_s;
  for (std::size_t i = from; i < until; ++i) news.events.push_back(recorded_event(all[i], i + 1, dt_s));
  if (is_arriving_) news.trails.emplace(trails());
  told_events_ = until;
  is_arriving_ = false;
  tell_(std::move(news));
}

/// On its way to where it was sent: how far it has come.
void ReplayDesk::tell_progress() {
  tell_(HistoryNews{.state = state(), .events = {}, .is_afresh = false, .trails = {}, .plots = {}});
}

bool ReplayDesk::ask(const WhyQuestion& question) {
  std::optional<WhyQuestion> older;
  {
    const std::lock_guard lock(mutex_);
    const auto same = std::ranges::find(questions_, question.asker, &WhyQuestion::asker);
    if (same == questions_.end() && questions_.size() >= kMostQuestions) return false;
    if (same == questions_.end())
      questions_.push_back(question);
    else
      older = std::exchange(*same, question);
  }
  if (older) tell_(DeskRefusal{older->ticket, "superseded", std::string(kNewerQuestion)});
  return true;
}

DeskNews ReplayDesk::answer_to(const WhyQuestion& question) const {
  const runtime::ReplayedFlight& flight = recording_->scene().flight();
  if (flight.is_recomputed()) return answer_from(flight.state(), question, *recording_);
  return DeskRefusal{question.ticket, "not_now", "this moment cannot be recomputed: not every tick before it was kept"};
}

void ReplayDesk::answer_questions() {
  std::vector<WhyQuestion> asked;
  {
    const std::lock_guard lock(mutex_);
    asked.swap(questions_);
  }
  for (const WhyQuestion& question : asked) tell_(answer_to(question));
}

ReplayDesk::Time ReplayDesk::turn(Time now) {
  const Time next = recording_->turn(now);
  answer_questions();
  is_arriving_ = is_arriving_ || recording_->jumps() != std::exchange(told_jumps_, recording_->jumps());
  const bool has_arrived = is_arriving_ && !recording_->is_seeking();
  if (now < next_look_ && !has_arrived) return next;
  next_look_ = now + kLookEvery;
  if (recording_->scene().flight().number() == told_number_ && !has_arrived) return next;
  if (recording_->scene().revision() != told_revision_) tell_targets();
  tell_ground();
  if (has_arrived || !is_arriving_)
    tell_history();
  else
    tell_progress();
  return next;
}

}  // namespace vigil::console
