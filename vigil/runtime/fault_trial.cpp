#include "vigil/runtime/fault_trial.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/evasion.hpp"
#include "vigil/runtime/fault_setup.hpp"
#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/virtual_flight.hpp"
#include "vigil/swarm/ordered_flight.hpp"

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::Fault;
using swarm::VehicleMode;

constexpr double kEarliestS = 10.0;
constexpr double kLatestS = 30.0;
constexpr double kLongestS = 30.0;  // after it befell
constexpr double kForEver = 1e6;
constexpr double kFirstNewsS = 1.0;     // a drone whose first packets got lost has not been heard before that
constexpr double kClearlyBeyond = 2.0;  // thresholds

std::chrono::nanoseconds no_clock() { return {}; }

/// What stands in the log of a drone that is not as it should be.
struct Name {
  Activity activity = Activity::kActive;
  Fault fault = Fault::kNone;
};

bool is_alarm(const swarm::DroneSnapshot& drone) {
  switch (drone.activity) {
    case Activity::kTrackingLost:
    case Activity::kLinkLost:
    case Activity::kNotFollowing:
    case Activity::kOutside:
    case Activity::kVehicleFailed:
      return true;
    default:
      return drone.fault.kind != Fault::kNone;
  }
}

bool is_right(Misfortune misfortune, const Name& name) {
  switch (misfortune) {
    case Misfortune::kHidden:
      return name.activity == Activity::kTrackingLost && name.fault == Fault::kNone;
    case Misfortune::kCutOff:
      return name.activity == Activity::kLinkLost && name.fault == Fault::kNone;
    case Misfortune::kFrozen:
      return name.fault == Fault::kFrozen;
    case Misfortune::kJumped:
      return name.fault == Fault::kJumped;
    case Misfortune::kSwapped:
      return name.fault == Fault::kSwapped;
    case Misfortune::kSkewed:
      return name.fault == Fault::kDisagreeing;
    case Misfortune::kDeaf:
    case Misfortune::kDrifting:
      return name.fault == Fault::kNotFollowing;
    case Misfortune::kFliesAway:
      return name.fault == Fault::kOutside;
    case Misfortune::kLands:
      return name.fault == Fault::kOwnMode && name.activity != Activity::kOverridden;
    case Misfortune::kPiloted:
      return name.fault == Fault::kOwnMode && name.activity == Activity::kOverridden;
    case Misfortune::kFailed:
      return name.activity == Activity::kVehicleFailed;
  }
  return false;
}

/// How long news of a vehicle may take over its link.
double link_news_s(const Mission& mission) {
  const LinkSection& link = mission.simulation.link;
  return link.delay_s + link.jitter_s + longest_burst_s(mission) + 2.0 * tick_s(mission) +
         (link.rate_hz ? 1.0 / *link.rate_hz : 0.0);
}

/// How long a new position may take.
double position_news_s(const Mission& mission) {
  const double usual_s = observation_delay_s(mission) + 2.0 * tick_s(mission);
  return mission.simulation.tracker.over_link ? usual_s + longest_burst_s(mission) : usual_s;
}

double skew_m_s(const Mission& mission) {
  const dynamics::FaultBounds bounds = fault_parameters(mission).bounds;
  return std::max(mission.control.speed_limit_m_s,
                  kClearlyBeyond * bounds.disagreement_m * bounds.disagreement_leak_per_s);
}

/// The time in which a constant speed fills a leaky integral up to a threshold.
double filling_s(double threshold_m, double leak_per_s, double speed_m_s) {
  return -std::log1p(-threshold_m * leak_per_s / speed_m_s) / leak_per_s;
}

/// Where its orders lead a drone, and how far the truth departs from there, in the monitor's memory.
class Shadow {
 public:
  explicit Shadow(const Mission& mission)
      : rules_(fault_parameters(mission), tick_s(mission)),
        delay_(static_cast<std::size_t>(std::lround(command_delay_s(mission) / rules_.dt_s))) {}

  void begin() { departure_.setZero(); }
  /// One tick: what it was ordered, and where it is after it.
  void take(const Vec2& u, const Vec2& place) {
    orders_.push_back(u);
    if (orders_.size() > delay_ + 1) orders_.pop_front();
    const Vec2 before = led_.place();
    led_.fly(rules_, orders_.front());
    departure_ = rules_.keeps * departure_ + (place - place_) - (led_.place() - before);
    place_ = place;
  }
  [[nodiscard]] bool is_clearly_beyond() const {
    return departure_.norm() > kClearlyBeyond * (rules_.parameters.bounds.residual_m + led_.explained_m());
  }

 private:
  swarm::OrderedFlight::Rules rules_;
  std::size_t delay_;
  std::deque<Vec2> orders_;
  swarm::OrderedFlight led_;
  Vec2 place_ = Vec2::Zero();
  Vec2 departure_ = Vec2::Zero();
};

std::size_t nearest_to(std::span<const TruthSample> truth, std::size_t drone) {
  std::size_t nearest = drone == 0 ? 1 : 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (i != drone &&
        (truth[i].position - truth[drone].position).norm() < (truth[nearest].position - truth[drone].position).norm())
      nearest = i;
  return nearest;
}

/// Straight away from the field's centre.
Vec2 outward(const field::Field& field, const Vec2& place) {
  const Vec2 from = place - 0.5 * Vec2(field.length_x, field.length_y);
  return from.norm() > 0.0 ? from.normalized() : Vec2(1.0, 0.0);
}

double beyond(const field::Field& field, const Vec2& place) {
  const Vec2 size(field.length_x, field.length_y);
  return (-place).cwiseMax(place - size).cwiseMax(Vec2::Zero()).norm();
}

/// One flight with one misfortune.
class Trial {
 public:
  Trial(Mission mission, const MakeFleet& make_fleet, Misfortune misfortune, std::uint64_t seed)
      : mission_(std::move(mission)),
        misfortune_(misfortune),
        random_(seed, ~std::uint64_t{0}, 99),
        limits_(audit_limits(mission_)),
        bounds_(fault_parameters(mission_).bounds),
        stated_s_(stated_time_s(mission_, misfortune)),
        shadow_(mission_),
        fleet_(make_fleet(mission_)),
        flight_(mission_, *fleet_, nullptr, no_clock) {
    const auto drones = static_cast<double>(mission_.drones.size());
    drone_ = std::min(mission_.drones.size() - 1, static_cast<std::size_t>(random_.uniform() * drones));
    at_s_ = kEarliestS + (kLatestS - kEarliestS) * random_.uniform();
    angle_ = 2.0 * std::numbers::pi * random_.uniform();
  }

  FaultTrial fly() {
    while (!flight_.is_over() && !is_decided()) {
      const double now_s = static_cast<double>(flight_.ticks_flown()) * tick_s(mission_);
      if (!has_befallen_ && now_s >= at_s_) befall(now_s);
      flight_.step();
      take(now_s);
    }
    result_.evadable_pairs = static_cast<std::uint64_t>(
        std::ranges::count_if(close_pairs_, [&](const ClosePair& pair) { return was_evadable(pair); }));
    return result_;
  }

 private:
  /// Two that came too close, and after how many ticks since it befell.
  struct ClosePair {
    std::size_t i = 0;
    std::size_t j = 0;
    std::size_t tick = 0;
  };

  void befall(double now_s) {
    has_befallen_ = true;
    befell_s_ = now_s;
    const std::span<const TruthSample> truth = fleet_->truth();
    other_ = nearest_to(truth, drone_);
    shadow_.begin();
    const swarm::DroneId id(drone_);
    const Vec2 direction(std::cos(angle_), std::sin(angle_));
    const double u_max = mission_.control.speed_limit_m_s;
    const auto befall_it = [&](MishapKind kind, const Vec2& value = Vec2::Zero()) {
      fleet_->befall(id, {.kind = kind, .for_s = kForEver, .value = value, .other = swarm::DroneId(other_)});
    };
    switch (misfortune_) {
      case Misfortune::kHidden:
        return fleet_->hide(id, kForEver);
      case Misfortune::kCutOff:
        return fleet_->cut_link(id, kForEver);
      case Misfortune::kFrozen:
        return befall_it(MishapKind::kFreezeTracking);
      case Misfortune::kJumped:
        return befall_it(MishapKind::kShiftTracking, (1.0 + random_.uniform()) * jump_m() * direction);
      case Misfortune::kSwapped:
        return befall_it(MishapKind::kSwapTracking);
      case Misfortune::kSkewed:
        return befall_it(MishapKind::kSkewVelocity, skew_m_s(mission_) * direction);
      case Misfortune::kDeaf:
        return befall_it(MishapKind::kIgnoreOrders);
      case Misfortune::kDrifting:
        return befall_it(MishapKind::kDrift, u_max * direction);
      case Misfortune::kFliesAway:
        return befall_it(MishapKind::kDrift, 1.5 * u_max * outward(limits_.field, truth[drone_].position));
      case Misfortune::kLands:
        return befall_it(MishapKind::kLandByItself);
      case Misfortune::kPiloted:
        return befall_it(MishapKind::kTakenByPilot, 0.5 * u_max * direction);
      case Misfortune::kFailed:
        return fleet_->fail(id);
    }
  }

  /// Farther than any drone could have got while it was not seen.
  [[nodiscard]] double jump_m() const {
    return std::max(mission_.safety.separation_m, kClearlyBeyond * bounds_.jump_m + bounds_.reach_m_s * unseen_s());
  }
  [[nodiscard]] double unseen_s() const { return bounds_.longest_span_s + 2.0 * tick_s(mission_); }

  [[nodiscard]] bool has_shown() const {
    const TruthSample& truth = fleet_->truth()[drone_];
    if (misfortune_ == Misfortune::kDeaf || misfortune_ == Misfortune::kDrifting) return shadow_.is_clearly_beyond();
    if (misfortune_ == Misfortune::kFliesAway)
      return beyond(limits_.field, truth.position) > kClearlyBeyond * bounds_.outside_m;
    return true;
  }

  [[nodiscard]] bool is_concerned(std::size_t drone) const {
    return has_befallen_ && (drone == drone_ || (misfortune_ == Misfortune::kSwapped && drone == other_));
  }

  void take(double now_s) {
    const swarm::Snapshot& snapshot = flight_.snapshot();
    shadow_.take(snapshot.drones[drone_].order.velocity, fleet_->truth()[drone_].position);
    alarms_.resize(snapshot.drones.size());
    for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
      const bool alarm = is_alarm(snapshot.drones[i]);
      if (snapshot.drones[i].fault.kind != Fault::kNone && !alarms_[i] && !is_concerned(i)) ++result_.false_alarms;
      alarms_[i] = alarm ? 1 : 0;
    }
    if (!has_befallen_) return;
    const std::span<const TruthSample> truth = fleet_->truth();
    past_.emplace_back(truth.begin(), truth.end());
    if (!result_.has_shown && has_shown()) {
      result_.has_shown = true;
      shown_s_ = now_s;
    }
    notice(snapshot.drones[drone_], now_s);
    judge_truth();
  }

  void notice(const swarm::DroneSnapshot& drone, double now_s) {
    if (misfortune_ == Misfortune::kFliesAway && !result_.has_shown) return;
    if (is_alarm(drone)) {
      if (!result_.is_noticed) noticed_s_ = now_s;
      result_.is_noticed = true;
      if (!result_.has_shown || now_s - shown_s_ <= stated_s_) take_name({drone.activity, drone.fault.kind});
    }
    if (!result_.is_noticed || !result_.has_shown) return;
    result_.delay_s = noticed_s_ - shown_s_;
    result_.unnoticed_s = noticed_s_ - befell_s_;
    result_.is_in_time = result_.delay_s <= stated_s_;
    result_.is_named_rightly = is_right(misfortune_, name_);
  }

  /// That a drone which was named rightly has by now left the field is right, too.
  void take_name(const Name& name) {
    const bool is_outside = beyond(limits_.field, fleet_->truth()[drone_].position) > 0.0;
    if (is_right(misfortune_, name_) && name.fault == Fault::kOutside && is_outside) return;
    name_ = name;
  }

  void judge_truth() {
    const std::span<const TruthSample> truth = fleet_->truth();
    const auto is_airborne = [&](std::size_t i) { return truth[i].height_m > limits_.landed_height_m; };
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!is_airborne(i)) continue;
      if (!is_concerned(i)) judge_place(truth[i]);
      for (std::size_t j = 0; j < i; ++j)
        if (is_airborne(j)) judge_pair(i, j, (truth[i].position - truth[j].position).norm());
    }
  }

  void judge_place(const TruthSample& truth) {
    const double wall = std::min({truth.position.x(), truth.position.y(), limits_.field.length_x - truth.position.x(),
                                  limits_.field.length_y - truth.position.y()});
    if (wall < limits_.wall_distance_m - 1e-9) ++result_.others_violation_ticks;
    for (const field::Polygon& polygon : limits_.no_fly)
      if (field::signed_distance(polygon, truth.position) < limits_.no_fly_buffer_m - 1e-9)
        ++result_.others_violation_ticks;
  }

  void judge_pair(std::size_t i, std::size_t j, double distance_m) {
    const bool concerns = is_concerned(i) || is_concerned(j);
    if (distance_m < limits_.separation_m - 1e-9) ++(concerns ? result_.close_ticks : result_.others_violation_ticks);
    if (distance_m < mission_.safety.contact_distance_m) ++result_.contact_ticks;
    const bool is_known = std::ranges::any_of(close_pairs_, [&](const ClosePair& p) { return p.i == i && p.j == j; });
    if (concerns && distance_m < limits_.separation_m - 1e-9 && !is_known)
      close_pairs_.push_back({i, j, past_.size() - 1});
  }

  /// Where the vehicle follows its orders only the tracker is wrong about it, or its velocity.
  [[nodiscard]] bool follows_nobody() const {
    switch (misfortune_) {
      case Misfortune::kDeaf:
      case Misfortune::kDrifting:
      case Misfortune::kFliesAway:
      case Misfortune::kLands:
      case Misfortune::kPiloted:
      case Misfortune::kFailed:
        return true;
      default:
        return false;
    }
  }

  [[nodiscard]] bool was_evadable(const ClosePair& pair) const {
    if (!follows_nobody()) return true;
    const double dt_s = tick_s(mission_);
    double known_s = std::numeric_limits<double>::infinity();
    if (result_.is_noticed) known_s = noticed_s_;
    if (result_.has_shown) known_s = std::min(known_s, shown_s_ + std::max(0.0, stated_s_));
    const double ticks = std::max(0.0, std::round((known_s - befell_s_) / dt_s));
    if (ticks >= static_cast<double>(pair.tick)) return false;  // before anybody could know
    const auto known = static_cast<std::size_t>(ticks);
    const std::size_t healthy = pair.i == drone_ ? pair.j : pair.i;
    std::vector<Vec2> places;
    for (std::size_t n = known; n < past_.size(); ++n) places.push_back(past_[n][drone_].position);
    const TruthSample& there = past_[known][healthy];
    return could_evade({.position = there.position,
                        .velocity = there.velocity,
                        .speed_m_s = mission_.control.speed_limit_m_s,
                        .lag_s = barrier_parameters(mission_).lag_s,
                        .delay_s = command_delay_s(mission_) + dt_s},
                       places, dt_s, {limits_.field, limits_.wall_distance_m, limits_.separation_m});
  }

  [[nodiscard]] bool is_decided() const {
    if (!has_befallen_) return false;
    const double now_s = static_cast<double>(flight_.ticks_flown()) * tick_s(mission_);
    if (result_.has_shown && result_.is_noticed && now_s > shown_s_ + stated_s_ + 3.0) return true;
    return now_s > befell_s_ + std::max(kLongestS, 2.0 * stated_s_);
  }

  Mission mission_;
  Misfortune misfortune_;
  dynamics::RandomStream random_;
  AuditLimits limits_;
  dynamics::FaultBounds bounds_;
  double stated_s_;
  Shadow shadow_;
  std::unique_ptr<VirtualFleet> fleet_;
  VirtualFlight flight_;
  FaultTrial result_;
  std::vector<std::uint8_t> alarms_;
  std::vector<std::vector<TruthSample>> past_;  ///< since it befell
  std::vector<ClosePair> close_pairs_;
  std::size_t drone_ = 0;
  std::size_t other_ = 0;
  double at_s_ = 0.0;
  double angle_ = 0.0;
  bool has_befallen_ = false;
  double befell_s_ = 0.0;
  double shown_s_ = 0.0;
  double noticed_s_ = 0.0;
  Name name_;
};

}  // namespace

double stated_time_s(const Mission& mission, Misfortune misfortune) {
  const dynamics::FaultBounds bounds = fault_parameters(mission).bounds;
  switch (misfortune) {
    case Misfortune::kHidden:
      return mission.health.tracking_timeout_s + 2.0 * tick_s(mission);
    case Misfortune::kCutOff:
      return mission.health.link_timeout_s + link_news_s(mission) - longest_burst_s(mission);
    case Misfortune::kFrozen:
      return bounds.frozen_s + bounds.longest_span_s + position_news_s(mission);
    case Misfortune::kJumped:
    case Misfortune::kSwapped:
      return bounds.confirm_s + position_news_s(mission);
    case Misfortune::kSkewed:
      return filling_s(bounds.disagreement_m, bounds.disagreement_leak_per_s, skew_m_s(mission)) +
             bounds.longest_span_s + position_news_s(mission);
    case Misfortune::kDeaf:
    case Misfortune::kDrifting:
    case Misfortune::kFliesAway:
      return position_news_s(mission);
    case Misfortune::kLands:
    case Misfortune::kPiloted:
    case Misfortune::kFailed:
      return link_news_s(mission);
  }
  return 0.0;
}

Mission trial_mission(Mission mission) {
  mission.simulation.tracker.dropouts_per_min = 0.0;
  mission.simulation.tracker.swaps_per_h = 0.0;
  mission.simulation.battery.reset();
  mission.simulation.events.clear();
  return mission;
}

FaultTrial fly_trial(const Mission& mission, const MakeFleet& make_fleet, Misfortune misfortune, std::uint64_t seed) {
  Mission flown = trial_mission(mission);
  flown.simulation.seed = seed;
  flown.simulation.duration_s = kLatestS + 10.0 * kLongestS;
  return Trial(std::move(flown), make_fleet, misfortune, seed).fly();
}

std::uint64_t false_alarms(const Mission& mission, const MakeFleet& make_fleet, std::uint64_t seed, double seconds) {
  Mission flown = trial_mission(mission);
  flown.simulation.seed = seed;
  flown.simulation.duration_s = seconds;
  const std::unique_ptr<VirtualFleet> fleet = make_fleet(flown);
  VirtualFlight flight(flown, *fleet, nullptr, no_clock);
  std::vector<std::uint8_t> alarms(flown.drones.size(), 0);
  std::uint64_t count = 0;
  while (!flight.is_over()) {
    flight.step();
    for (std::size_t i = 0; i < alarms.size(); ++i) {
      const bool alarm = is_alarm(flight.snapshot().drones[i]);
      if (alarm && alarms[i] == 0 && flight.snapshot().time_s > kFirstNewsS) ++count;
      alarms[i] = alarm ? 1 : 0;
    }
  }
  return count;
}

}  // namespace vigil::runtime
