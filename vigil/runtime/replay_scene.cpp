#include "vigil/runtime/replay_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/recollection.hpp"
#include "vigil/runtime/recorded_targets.hpp"

namespace vigil::runtime {
namespace {

/// As often as a live console looks at the ground.
constexpr double kLookEveryS = 0.2;

void expect_sense(const FlightRecording& recording, const Mission& mission) {
  if (recording.tick_count() == 0)
    throw std::runtime_error("the recording has no complete tick; fly the mission again");
  if (recording.head().parameters.drones != mission.drones.size())
    throw std::runtime_error(fmt::format("the recording has {} drones, its mission.yaml {}; it is damaged",
                                         recording.head().parameters.drones, mission.drones.size()));
}

}  // namespace

ReplayScene::ReplayScene(Mission mission, const Open& open)
    : first_(std::move(mission)),
      mission_(first_),
      flight_(open()),
      elsewhere_(open()),
      tick_elsewhere_(recording().head().parameters.drones),
      ground_(first_),
      history_(first_.drones.size()) {
  expect_sense(recording(), first_);
  look_every_ = static_cast<std::uint64_t>(std::max(1LL, std::llround(kLookEveryS / spacing_s())));
  begin_s_ = time_of(1);
  end_s_ = time_of(flight_.tick_count());
  retarget();
  keep_checkpoint();
  step();
}

double ReplayScene::spacing_s() const noexcept {
  const RecordingHead& head = recording().head();
  return head.parameters.dt_s * static_cast<double>(std::max<std::uint64_t>(head.keep_every, 1));
}

double ReplayScene::time_of(std::uint64_t number) {
  elsewhere_->read(number - 1, tick_elsewhere_);
  return tick_elsewhere_.snapshot.time_s;
}

std::uint64_t ReplayScene::number_at(double time_s) {
  std::uint64_t at_or_before = 1;
  for (std::uint64_t after = flight_.tick_count() + 1; after - at_or_before > 1;) {
    const std::uint64_t middle = at_or_before + (after - at_or_before) / 2;
    (time_of(middle) <= time_s ? at_or_before : after) = middle;
  }
  return at_or_before;
}

void ReplayScene::retarget() {
  const double time_s = flight_.number() == 0 ? begin_s_ : flight_.snapshot().time_s;
  targets_ = targets_until(recording().targets(), time_s);
  mission_ = mission_at(first_, recording().targets(), time_s);
  ground_.retarget(mission_, *coverage_target(mission_, ground_.basis()), time_s);
}

void ReplayScene::look() {
  const auto all = recording().targets();
  if (targets_ < all.size() && all[targets_].time_s <= flight_.snapshot().time_s) retarget();
  // Deadlines that were missed stand in the recording's own events.
  if (flight_.number() % look_every_ == 1 % look_every_) (void)ground_.look(flight_.snapshot());
}

double ReplayScene::worst_age_s() const {
  double worst_s = std::numeric_limits<double>::quiet_NaN();
  for (const AreaState& area : ground_.watch().states({}, time_s())) worst_s = std::fmax(worst_s, area.age_s);
  return worst_s;
}

/// Whatever way leads to a tick that was never shown, it leads over all ticks before.
void ReplayScene::note_history() {
  if (flight_.number() <= noted_) return;
  noted_ = flight_.number();
  if (history_.is_due(time_s())) history_.add(flight_.snapshot(), worst_age_s());
}

void ReplayScene::keep_checkpoint() {
  checkpoints_.offer(flight_.number(), [this] { return Checkpoint{ground_, targets_}; });
}

bool ReplayScene::step() {
  if (!flight_.step()) return false;
  look();
  note_history();
  keep_checkpoint();
  return true;
}

void ReplayScene::approach(std::uint64_t number) {
  const std::uint64_t before = flight_.number();
  flight_.approach(number);
  if (flight_.number() == before) return;
  // Both were offered the same numbers.
  const auto& [at, kept] = checkpoints_.before(flight_.number());
  ground_ = kept.ground;
  if (targets_ == kept.targets) return;
  targets_ = kept.targets;
  const auto all = recording().targets();
  mission_ = targets_ == 0 ? first_ : mission_at(first_, all, all[targets_ - 1].time_s);
}

void ReplayScene::recall(double since_s, std::uint64_t most, const std::function<void(const swarm::Snapshot&)>& show) {
  const std::uint64_t last = flight_.number();
  const std::uint64_t first = number_at(since_s);
  const std::uint64_t every = std::max<std::uint64_t>(1, (last - first) / std::max<std::uint64_t>(most - 1, 1) + 1);
  Recollection recollection(recording().head());
  for (std::uint64_t number = last - (last - first) / every * every; number <= last; number += every) {
    elsewhere_->read(number - 1, tick_elsewhere_);
    recollection.complete(tick_elsewhere_);
    show(tick_elsewhere_.snapshot);
  }
}

void ReplayScene::write(LiveFrame& out) const {
  out.snapshot = flight_.snapshot();
  out.past = {};
  out.c_k.setZero(ground_.basis().indices_per_axis(), ground_.basis().indices_per_axis());
  if (flight_.is_recomputed()) {
    flight_.state().write_past(out.past);
    flight_.state().statistics().average(out.c_k);
  }
  out.revision = revision();
  out.has_ticked = true;
}

}  // namespace vigil::runtime
