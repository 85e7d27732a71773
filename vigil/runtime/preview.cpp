#include "vigil/runtime/preview.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "vigil/core/field/seen_map.hpp"
#include "vigil/runtime/live_frame.hpp"

namespace vigil::runtime {
namespace {

constexpr double kSampleEveryS = 1.0;
constexpr double kLookEveryS = 0.2;
constexpr double kRounding = 1e-6;  // of a time

/// How many ticks make up about so long; at least one.
std::size_t ticks_in(double time_s, double tick_s) {
  return static_cast<std::size_t>(std::max(1.0, std::round(time_s / tick_s)));
}

/// Notes what is seen, area by area, and how well each is covered.
class AreaFutures {
 public:
  AreaFutures(AreaWatch watch, double footprint_m, std::size_t drones, double now_s)
      : watch_(std::move(watch)), footprint_m_(footprint_m), began_s_(now_s), last_places_(drones) {}

  /// Takes in a tick's drones, at `time_s`.
  void look(const swarm::Snapshot& snapshot, const ergodic::Coefficients& c_k, double time_s) {
    gather_ways(snapshot);
    (void)watch_.see(ways_, footprint_m_, time_s);
    const std::vector<AreaState> states = watch_.states(c_k, time_s, snapshot.protection);
    if (futures_.empty()) begin(states);
    worst_age_s_ = 0.0;
    for (std::size_t n = 0; n < states.size(); ++n) note(states[n], time_s - began_s_, futures_[n]);
  }

  [[nodiscard]] double worst_age_s() const { return worst_age_s_; }
  [[nodiscard]] std::vector<AreaOutlook> take() { return std::move(futures_); }

 private:
  void begin(const std::vector<AreaState>& states) {
    for (const AreaState& state : states)
      futures_.push_back({.what = state.what, .asked = state.asked, .deadline_s = state.deadline_s});
  }

  void note(const AreaState& state, double in_s, AreaOutlook& future) {
    future.achieved = state.achieved;
    future.worst_age_s = std::max(future.worst_age_s, state.age_s);
    worst_age_s_ = std::max(worst_age_s_, state.age_s);
    const bool is_covered = state.asked > 0.0 && state.achieved >= kCoveredShare * state.asked;
    if (is_covered && !future.covered_in_s) future.covered_in_s = in_s;
    const bool is_seen = state.age_s <= in_s + kRounding;
    if (is_seen && !future.seen_in_s) future.seen_in_s = in_s;
  }

  void gather_ways(const swarm::Snapshot& snapshot) {
    ways_.clear();
    for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
      const swarm::DroneSnapshot& drone = snapshot.drones[i];
      const bool is_active = drone.activity == swarm::Activity::kActive;
      if (is_active) field::add_way(last_places_[i].value_or(drone.position), drone.position, footprint_m_, ways_);
      last_places_[i] = is_active ? std::optional(drone.position) : std::nullopt;
    }
  }

  AreaWatch watch_;
  double footprint_m_;
  double began_s_;
  double worst_age_s_ = 0.0;
  std::vector<std::optional<Vec2>> last_places_;
  std::vector<Vec2> ways_;
  std::vector<AreaOutlook> futures_;
};

/// Keeps every so-and-so-many-th place of each drone.
class GhostTrails {
 public:
  GhostTrails(std::size_t drones, std::size_t ticks, double tick_s)
      : drones_(drones),
        every_(ticks_between(drones, ticks, tick_s)),
        spacing_s_(static_cast<double>(every_) * tick_s) {}

  void note(std::size_t tick, std::span<const swarm::DroneObservation> drones) {
    if (tick % every_ != 0) return;
    for (const swarm::DroneObservation& drone : drones) {
      const bool was_seen = drone.age_s != swarm::DroneObservation::kNever;
      by_time_.push_back(was_seen ? drone.position : Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
  }

  /// By drone.
  void write(Outlook& out) const {
    out.ghost_spacing_s = spacing_s_;
    out.ghost_points = drones_ == 0 ? 0 : by_time_.size() / drones_;
    out.ghosts.reserve(by_time_.size());
    for (std::size_t i = 0; i < drones_; ++i)
      for (std::size_t n = 0; n < out.ghost_points; ++n) out.ghosts.push_back(by_time_[n * drones_ + i]);
  }

 private:
  /// A second, or longer where that would be too many points.
  static std::size_t ticks_between(std::size_t drones, std::size_t ticks, double tick_s) {
    const std::size_t most = std::max<std::size_t>(2, kMostGhostPoints / std::max<std::size_t>(1, drones));
    return std::max({std::size_t{1}, ticks_in(kSampleEveryS, tick_s), (ticks + most - 2) / (most - 1)});
  }

  std::size_t drones_;
  std::size_t every_;
  double spacing_s_;
  std::vector<Vec2> by_time_;
};

/// The swarm and its world, run ahead.
class FutureFlight {
 public:
  FutureFlight(PreviewStart start, double seconds)
      : now_s_(static_cast<double>(start.state.ticks()) * start.state.parameters().dt_s),
        tick_s_(preview_tick_s(start.state.parameters().dt_s, start.state.parameters().drones)),
        ticks_(ticks_in(seconds, tick_s_)),
        fleet_(start.state, start.vehicle),
        state_(std::move(start.state)),
        snapshot_(state_.parameters().drones),
        areas_(std::move(start.areas), start.footprint_m, state_.parameters().drones, now_s_),
        ghosts_(state_.parameters().drones, ticks_, tick_s_),
        c_k_(state_.basis().indices_per_axis(), state_.basis().indices_per_axis()) {
    state_.become_model(tick_s_);
    out_.tick_s = tick_s_;
    out_.seconds = static_cast<double>(ticks_) * tick_s_;
  }

  /// Once.
  std::optional<Outlook> fly(std::vector<swarm::Command> commands, const std::atomic<bool>& cancelled) {
    for (std::size_t n = 0; n <= ticks_; ++n) {
      if (cancelled.load(std::memory_order_relaxed)) return std::nullopt;
      swarm::tick(state_, fleet_.observations(), commands, snapshot_);
      commands.clear();
      note(n);
      fleet_.advance(snapshot_.drones, tick_s_);
    }
    out_.areas = areas_.take();
    ghosts_.write(out_);
    return std::move(out_);
  }

 private:
  void note(std::size_t n) {
    const double in_s = static_cast<double>(n) * tick_s_;
    ghosts_.note(n, fleet_.observations());
    if (n % ticks_in(kLookEveryS, tick_s_) == 0 || n == ticks_) look(in_s);
    if (in_s > next_sample_s_ - kRounding || n == ticks_) sample(in_s);
  }

  /// At the first tick of every second.
  void sample(double in_s) {
    out_.samples.push_back({in_s, snapshot_.metric, snapshot_.metric_percent, areas_.worst_age_s(), snapshot_.active});
    next_sample_s_ = std::floor(in_s / kSampleEveryS + kRounding) * kSampleEveryS + kSampleEveryS;
  }

  void look(double in_s) {
    state_.statistics().average(c_k_);
    areas_.look(snapshot_, state_.statistics().has_samples() ? c_k_ : ergodic::Coefficients(), now_s_ + in_s);
    out_.least_pair_m = std::min(out_.least_pair_m, least_airborne_pair_m(snapshot_));
  }

  double now_s_;
  double tick_s_;
  std::size_t ticks_;
  double next_sample_s_ = 0.0;
  PredictedFleet fleet_;
  swarm::SwarmState state_;
  swarm::Snapshot snapshot_;
  AreaFutures areas_;
  GhostTrails ghosts_;
  ergodic::Coefficients c_k_;
  Outlook out_;
};

std::vector<swarm::Command> commands_of(const PreviewChange& change) {
  std::vector<swarm::Command> commands;
  if (change.target) commands.push_back({.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = change.target});
  for (const swarm::DroneId drone : change.without)
    commands.push_back({.kind = swarm::CommandKind::kLand, .drone = drone, .target = nullptr});
  return commands;
}

}  // namespace

double preview_tick_s(double mission_tick_s, std::size_t drones) noexcept {
  const double longest_s = drones <= 5 ? 0.1 : drones <= 300 ? 0.2 : 0.4;
  return mission_tick_s * std::max(1.0, std::floor(longest_s / mission_tick_s + 1e-9));
}

std::optional<Outlook> look_into_future(PreviewStart start, const PreviewChange& change, double seconds,
                                        const std::atomic<bool>& cancelled) {
  return FutureFlight(std::move(start), seconds).fly(commands_of(change), cancelled);
}

}  // namespace vigil::runtime
