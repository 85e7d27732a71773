#include "vigil/runtime/replay_loop.hpp"

#include <algorithm>
#include <utility>

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;

/// Commands are looked for so often.
constexpr ReplayLoop::Time kTurnEvery = 10ms;
constexpr std::size_t kMostCommands = 256;
/// Recomputing so many drones' ticks takes some tens of milliseconds.
constexpr std::uint64_t kDroneTicksATurn = 4000;
constexpr double kRounding = 1e-9;

}  // namespace

ReplayLoop::ReplayLoop(Mission mission, const ReplayScene::Open& open, std::uint32_t epoch)
    : scene_(std::move(mission), open),
      epoch_(epoch),
      steps_a_turn_(std::max<std::uint64_t>(1, kDroneTicksATurn / scene_.first_mission().drones.size())),
      anchor_s_(scene_.time_s()),
      inbox_(kMostCommands),
      outbox_(kMostCommands),
      frames_(scene_.first_mission().drones.size()) {}

bool ReplayLoop::is_at_end() const noexcept { return scene_.flight().number() >= scene_.flight().tick_count(); }

double ReplayLoop::progress() const noexcept {
  if (!goal_ || *goal_ <= way_from_) return 1.0;
  return static_cast<double>(scene_.flight().number() - way_from_) / static_cast<double>(*goal_ - way_from_);
}

bool ReplayLoop::step() {
  const bool has_stepped = scene_.step();
  has_new_frame_ = has_new_frame_ || has_stepped;
  return has_stepped;
}

void ReplayLoop::seek(std::uint64_t number) {
  goal_ = std::clamp<std::uint64_t>(number, 1, scene_.flight().tick_count());
  ++jumps_;
  if (*goal_ == scene_.flight().number()) return;
  scene_.approach(*goal_);
  (void)step();  // what is shown must make sense; it lies at or before the goal
  way_from_ = scene_.flight().number();
}

void ReplayLoop::play_on(Time now) {
  anchor_ = now;
  anchor_s_ = scene_.time_s();
}

void ReplayLoop::obey(const LiveCommand& command, Time now) {
  const std::uint64_t number = goal_.value_or(scene_.flight().number());
  switch (command.kind) {
    case LiveCommand::Kind::kPause:
      is_paused_ = true;
      break;
    case LiveCommand::Kind::kResumeClock:
      is_paused_ = false;
      if (number >= scene_.flight().tick_count()) seek(1);
      break;
    case LiveCommand::Kind::kSetSpeed:
      speed_ = command.speed;
      break;
    case LiveCommand::Kind::kSeek:
      seek(scene_.number_at(command.seek_s + kRounding));
      break;
    case LiveCommand::Kind::kStep:
      is_paused_ = true;
      seek(command.steps < 0 ? number - std::min(number, static_cast<std::uint64_t>(-command.steps))
                             : number + static_cast<std::uint64_t>(command.steps));
      break;
    case LiveCommand::Kind::kSwarm:
      break;
  }
  play_on(now);
}

void ReplayLoop::approach_goal(Time now) {
  for (std::uint64_t n = 0; n < steps_a_turn_ && scene_.flight().number() < *goal_; ++n) (void)step();
  if (scene_.flight().number() < *goal_) return;
  goal_.reset();
  play_on(now);
}

void ReplayLoop::play(Time now) {
  const double due_s = anchor_s_ + speed_ * std::chrono::duration<double>(now - anchor_).count() + kRounding;
  std::uint64_t left = steps_a_turn_;
  while (left > 0 && scene_.time_s() + scene_.spacing_s() <= due_s && step()) --left;
  if (left == 0) play_on(now);  // as fast as it can; it does not hurry later
  if (is_at_end()) is_paused_ = true;
}

void ReplayLoop::publish(Time now) {
  clocks_.mine() = {.speed = speed_, .is_paused = is_paused_, .lateness = {}, .lateness_ever = {}};
  clocks_.publish();
  if (!has_new_frame_) return;
  scene_.write(frames_.mine());
  frames_.mine().computed_at = now;
  has_new_frame_ = !frames_.publish();
}

ReplayLoop::Time ReplayLoop::turn(Time now) {
  std::vector<LiveEvent> answers;
  for (const LiveCommand& command : inbox_.take()) {
    obey(command, now);
    LiveEvent answer;
    answer.kind = LiveEvent::Kind::kAnswer;
    answer.ticket = command.ticket;
    answer.accepted = 1;
    if (command.ticket != 0) answers.push_back(answer);
  }
  if (goal_)
    approach_goal(now);
  else if (!is_paused_)
    play(now);
  for (LiveEvent& answer : answers) {
    answer.tick = scene_.flight().snapshot().tick;
    answer.time_s = scene_.time_s();
    outbox_.note(answer);
  }
  publish(now);
  outbox_.send();
  return now + kTurnEvery;
}

}  // namespace vigil::runtime
