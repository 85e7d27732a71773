#include "vigil/runtime/control_loop.hpp"

#include <algorithm>

namespace vigil::runtime {
namespace {

using namespace std::chrono_literals;

/// However slow the ticks are, commands to the clock are looked for so often.
constexpr ControlLoop::Time kLongestWait = 10ms;
/// Lateness is told of the last one to two of these.
constexpr ControlLoop::Time kPeriod = 10s;
constexpr ControlLoop::Time kFiguresEvery = 500ms;
constexpr std::size_t kMostClockCommands = 64;

std::size_t inbox_size(std::size_t drones) { return 2 * drones + 64; }
std::size_t outbox_size(std::size_t drones) { return 16 * drones + 1024; }

}  // namespace

ControlLoop::ControlLoop(LiveFlight& flight, std::size_t drones)
    : flight_(flight),
      pacer_(flight.dt_s(), Time(0)),
      inbox_(inbox_size(drones)),
      clock_inbox_(kMostClockCommands),
      outbox_(outbox_size(drones)),
      frames_(drones),
      states_(flight.state().parameters()) {
  waiting_.reserve(inbox_size(drones));
}

void ControlLoop::begin(Time now) noexcept {
  pacer_ = TickPacer(flight_.dt_s(), now);
  period_began_ = now;
  figures_made_ = now;
}

void ControlLoop::obey_the_clock(const LiveCommand& command, Time now) noexcept {
  if (command.kind == LiveCommand::Kind::kPause) pacer_.pause();
  if (command.kind == LiveCommand::Kind::kResumeClock) pacer_.resume(now);
  if (command.kind == LiveCommand::Kind::kSetSpeed) pacer_.set_speed(command.speed, now);
  LiveEvent answer;
  answer.kind = LiveEvent::Kind::kAnswer;
  answer.tick = flight_.state().ticks();
  answer.ticket = command.ticket;
  answer.accepted = 1;
  if (command.ticket != 0) outbox_.note(answer);
}

bool ControlLoop::submit(std::vector<LiveCommand> commands) {
  const bool is_for_swarm = commands.empty() || commands.front().kind == LiveCommand::Kind::kSwarm;
  return is_for_swarm ? inbox_.push(std::move(commands)) : clock_inbox_.push(std::move(commands));
}

void ControlLoop::take_commands() noexcept {
  if (next_ < waiting_.size()) return;
  waiting_.clear();
  next_ = 0;
  for (const LiveCommand& command : inbox_.take()) waiting_.push_back(command);  // within its capacity, the inbox's
}

/// As many of those that wait as one tick can tell apart; a ticket's are not parted.
std::span<const LiveCommand> ControlLoop::due_commands() noexcept {
  const std::size_t first = next_;
  std::size_t events = 0;
  for (std::size_t n = first; n < waiting_.size(); ++n) {
    events += flight_.events_of(waiting_[n]);
    if (events > flight_.event_budget() && next_ > first) break;
    if (waiting_[n].is_last_of_ticket) next_ = n + 1;
  }
  return std::span(waiting_).subspan(first, next_ - first);
}

void ControlLoop::tick(Time now) noexcept {
  lateness_.add(pacer_.begin_tick(now));
  flight_.step(due_commands(), frames_.mine(), outbox_);
  frames_.mine().computed_at = now;
  has_new_frame_ = true;
}

void ControlLoop::measure(Time now) noexcept {
  if (now - figures_made_ < kFiguresEvery) return;
  figures_made_ = now;
  Lateness both = lateness_before_;
  both.add(lateness_);
  figures_ = both.figures();
  both.add(lateness_long_ago_);
  figures_ever_ = both.figures();
  if (now - period_began_ < kPeriod) return;
  lateness_long_ago_.add(lateness_before_);
  lateness_before_ = lateness_;
  lateness_.clear();
  period_began_ = now;
}

void ControlLoop::publish(Time now) noexcept {
  measure(now);
  clocks_.mine() = {
      .speed = pacer_.speed(), .is_paused = pacer_.is_paused(), .lateness = figures_, .lateness_ever = figures_ever_};
  clocks_.publish();
  if (has_new_frame_) has_new_frame_ = !frames_.publish();
}

ControlLoop::Time ControlLoop::turn(Time now) noexcept {
  for (const LiveCommand& command : clock_inbox_.take()) obey_the_clock(command, now);
  take_commands();
  if (pacer_.is_due(now)) tick(now);
  publish(now);
  outbox_.send();
  states_.give(flight_.state());
  const Time latest = now + kLongestWait;
  return pacer_.is_paused() ? latest : std::min(latest, pacer_.next_due());
}

}  // namespace vigil::runtime
