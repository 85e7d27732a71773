#include "vigil/swarm/fault_monitor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace vigil::swarm {
namespace {

constexpr double kOver = 0.5;         // of a threshold: below it, what was beyond is well again
constexpr int kMostRelapses = 6;      // the time that it must stay well doubles with each
constexpr double kForgottenS = 60.0;  // well for so long, and relapses are forgotten
constexpr int kLeastRepeats = 4;

/// In the air and, as far as it says, under our orders: what the monitor has expectations of.
bool is_ours(const DroneMemory& drone, VehicleMode mode) {
  const bool flies = mode == VehicleMode::kFlying || mode == VehicleMode::kUnknown;
  switch (drone.activity) {
    case Activity::kActive:
    case Activity::kHeld:
    case Activity::kRecovering:
    case Activity::kTravelling:
    case Activity::kReturning:
    case Activity::kTrackingLost:
    case Activity::kNotFollowing:
    case Activity::kOutside:
      return flies;
    default:
      return false;
  }
}

/// In the air, and not in a pilot's hands: whoever flies it, it is nowhere that its kind cannot have flown to.
bool is_bound_to_its_reach(const DroneMemory& drone, VehicleMode mode) {
  if (mode == VehicleMode::kGrounded || mode == VehicleMode::kManual) return false;
  switch (drone.activity) {
    case Activity::kNeverSeen:
    case Activity::kGrounded:
    case Activity::kAboutToTakeOff:
    case Activity::kOverridden:
      return false;
    default:
      return true;
  }
}

/// Whether somebody here asked for what the vehicle does now.
bool is_asked_for(const DroneMemory& drone) {
  switch (drone.intent) {
    case Intent::kLand:
    case Intent::kEmergencyStop:
    case Intent::kOverride:
    case Intent::kMarkedFailed:
    case Intent::kStayDown:
      return true;
    default:
      return drone.activity == Activity::kBatteryLow || drone.activity == Activity::kLanding ||
             drone.activity == Activity::kOverridden || drone.activity == Activity::kEmergencyStop;
  }
}

/// Not by our orders.
bool is_on_its_own(VehicleMode mode) {
  return mode == VehicleMode::kLanding || mode == VehicleMode::kFalling || mode == VehicleMode::kManual ||
         mode == VehicleMode::kFailed;
}

bool is_finite(const DroneObservation& observed) {
  return observed.position.allFinite() && std::isfinite(observed.age_s) && observed.age_s >= 0.0;
}

Vec2 velocity_of(const DroneObservation& observed) {
  return observed.velocity.allFinite() ? observed.velocity : Vec2::Zero();
}

}  // namespace

FaultMonitor::FaultMonitor(const WatchSetup& setup, std::size_t drones)
    : setup_(setup), rules_(setup.parameters, setup.dt_s), watched_(setup.parameters.watches ? drones : 0) {
  const double ago = (setup_.command_delay_s + setup_.observation_delay_s) / setup_.dt_s;
  const double whole = std::floor(ago + 1e-6);
  ago_ticks_ = static_cast<std::size_t>(whole);
  ago_part_ = std::max(0.0, ago - whole);
}

double FaultMonitor::reach_m(double span_s) const noexcept {
  const dynamics::FaultBounds& bounds = setup_.parameters.bounds;
  return bounds.jump_m + bounds.reach_m_s * std::clamp(span_s, 0.0, setup_.health.tracking_timeout_s);
}

/// The order that acts at the moment which is seen now, between two where delays are not whole ticks.
void FaultMonitor::fly_model(Watched& drone, std::size_t index, const FlownOrders& flown) const noexcept {
  drone.model.fly(
      rules_, (1.0 - ago_part_) * flown.ordered(index, ago_ticks_) + ago_part_ * flown.ordered(index, ago_ticks_ + 1));
}

/// Goes on from what is measured.
void FaultMonitor::rest_model(Watched& drone, const Vec2& velocity) const noexcept {
  drone.model.restart(rules_, velocity);
  drone.model_place.setZero();
  drone.stream.model_at_change.setZero();
  drone.residual.setZero();
  drone.disagreement.setZero();
}

Vec2 FaultMonitor::model_place_at(const Watched& drone, double stamp_s) const noexcept {
  const double later_s = stamp_s - (now_s_ - setup_.observation_delay_s);
  return drone.model.place() + later_s * drone.model.velocity();
}

double FaultMonitor::residual_threshold(const Watched& drone) const noexcept {
  return setup_.parameters.bounds.residual_m + drone.model.explained_m();
}

/// Whether it leaps.
bool FaultMonitor::take_stream(Watched& drone, const DroneObservation& observed, double stamp_s) const noexcept {
  Stream& stream = drone.stream;
  const bool has_leapt = (observed.position - stream.newest).norm() > reach_m(stamp_s - stream.newest_s);
  if (has_leapt || !drone.has_seen) stream.steady_since_s = stamp_s;
  if (drone.has_seen && observed.position == stream.newest) {
    ++stream.repeats;
  } else {
    stream.repeats = 0;
    stream.changed_s = stamp_s;
    stream.model_at_change = model_place_at(drone, stamp_s);
  }
  stream.newest = observed.position;
  stream.velocity = velocity_of(observed);
  stream.newest_s = stamp_s;
  const dynamics::FaultBounds& bounds = setup_.parameters.bounds;
  const bool is_repeated = stream.repeats >= kLeastRepeats && stamp_s - stream.changed_s >= bounds.frozen_s;
  const double ordered_m = (model_place_at(drone, stamp_s) - stream.model_at_change).norm();
  stream.is_frozen = is_repeated && (bounds.never_repeats || ordered_m > residual_threshold(drone) || stream.is_frozen);
  return has_leapt;
}

/// The drone near whose last believed place this one is seen.
std::optional<DroneId> FaultMonitor::whose(std::size_t index, const Vec2& place) const noexcept {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const Watched& other = watched_[i];
    if (i == index || !other.has_seen) continue;
    const double apart_s = std::abs(watched_[index].stream.newest_s - other.measured_s);
    if ((place - other.place).norm() <= reach_m(apart_s)) return DroneId(i);
  }
  return std::nullopt;
}

bool FaultMonitor::is_settled(const Watched& drone, const Vec2& place, double stamp_s,
                              const Motion& expected) const noexcept {
  const dynamics::FaultBounds& bounds = setup_.parameters.bounds;
  const double needed_s = bounds.confirm_s + setup_.health.recovery_s;
  const double unseen_s = stamp_s - drone.measured_s;
  const bool is_steady = stamp_s - drone.stream.steady_since_s >= needed_s;
  if (!is_steady || drone.other) return false;
  if (!drone.is_ours) return (place - drone.place).norm() <= bounds.jump_m + bounds.reach_m_s * unseen_s;
  return (place - expected.position).norm() <= bounds.jump_m + bounds.drift_m_s * unseen_s;
}

bool FaultMonitor::is_credible(const Watched& drone, const Vec2& place, double stamp_s, const Motion& expected,
                               bool has_leapt) const noexcept {
  const double unseen_s = stamp_s - drone.measured_s;
  const bool is_near = (place - drone.place).norm() <= reach_m(unseen_s);
  if (!drone.is_doubted) return is_near;
  const double way_s = setup_.observation_delay_s + setup_.command_delay_s;
  const bool is_where_expected = (place - expected.position).norm() <= reach_m(unseen_s + way_s);
  return (has_leapt && (is_near || is_where_expected)) || is_settled(drone, place, stamp_s, expected);
}

/// Whose place it is shows at the leap: later it may come by others.
void FaultMonitor::doubt(Watched& drone, std::size_t index, const Vec2& place, bool has_leapt) const noexcept {
  if (!drone.is_doubted) drone.doubted_since_s = now_s_;
  if (!drone.is_doubted || has_leapt) drone.other = whose(index, place);
  drone.is_doubted = true;
  drone.off_m = (place - drone.place).norm();
}

std::optional<FaultMonitor::Sighting> FaultMonitor::doubted_sighting(std::size_t drone) const noexcept {
  const Watched& watched = watched_[drone];
  if (!watched.is_doubted || watched.report.kind == Fault::kNone) return std::nullopt;
  const Stream& stream = watched.stream;
  const double age_s = now_s_ - setup_.dt_s - stream.newest_s;  // look() has moved on
  const auto is_there = [&](const Watched& other) {
    return (stream.newest - other.place).norm() <= reach_m(std::abs(stream.newest_s - other.measured_s));
  };
  if (watched.other && is_there(watched_[watched.other->index()])) return std::nullopt;
  return Sighting{{stream.newest, stream.velocity}, age_s};
}

void FaultMonitor::compare(Watched& drone, const DroneObservation& observed, double stamp_s,
                           const Vec2& model_place) const noexcept {
  const dynamics::FaultBounds& bounds = setup_.parameters.bounds;
  const double span_s = stamp_s - drone.measured_s;
  const Vec2 moved = observed.position - drone.place;
  drone.residual =
      std::exp(-bounds.residual_leak_per_s * span_s) * drone.residual + moved - (model_place - drone.model_place);
  // Noise is in the first and in the last position of an unbroken row: a sum over a gap would take in four of them.
  const bool is_broken = span_s > bounds.longest_span_s;
  const bool is_silent = drone.velocity.isZero(0.0) && velocity_of(observed).isZero(0.0);  // nobody reports velocities
  if (is_broken) drone.disagreement.setZero();
  if (is_broken || is_silent) return;
  const Vec2 told = 0.5 * span_s * (drone.velocity + velocity_of(observed));
  drone.disagreement = std::exp(-bounds.disagreement_leak_per_s * span_s) * drone.disagreement + told - moved;
}

void FaultMonitor::believe(Watched& drone, const DroneObservation& observed, double stamp_s,
                           bool is_elsewhere) const noexcept {
  if (!drone.is_ours || is_elsewhere) rest_model(drone, velocity_of(observed));
  const Vec2 model_place = model_place_at(drone, stamp_s);
  if (drone.has_seen && drone.is_ours && !is_elsewhere) compare(drone, observed, stamp_s, model_place);
  drone.model_place = model_place;
  drone.place = observed.position;
  drone.velocity = velocity_of(observed);
  drone.measured_s = stamp_s;
  drone.has_seen = true;
  drone.is_doubted = false;
  drone.was_silent = false;
  drone.other.reset();
}

void FaultMonitor::take_new(std::size_t index, const DroneObservation& observed, double stamp_s,
                            const Motion& expected) noexcept {
  Watched& drone = watched_[index];
  const bool has_leapt = take_stream(drone, observed, stamp_s);
  const bool is_repeated = setup_.parameters.bounds.never_repeats && drone.stream.repeats > 0;
  if (drone.is_ours && (drone.stream.is_frozen || is_repeated)) return;  // nothing is learnt of where it is
  const bool is_free = !drone.has_seen || !drone.is_bound;
  if (!is_free && !is_credible(drone, observed.position, stamp_s, expected, has_leapt))
    return doubt(drone, index, observed.position, has_leapt);
  const bool is_elsewhere = drone.was_silent || (drone.is_doubted && (observed.position - drone.place).norm() >
                                                                         reach_m(stamp_s - drone.measured_s));
  believe(drone, observed, stamp_s, is_elsewhere);
}

void FaultMonitor::take(std::size_t index, const DroneObservation& observed, const Motion& expected) noexcept {
  Watched& drone = watched_[index];
  drone.believed = observed;
  if (!is_finite(observed)) return;
  const double stamp_s = now_s_ - observed.age_s;
  const bool is_new = !drone.has_seen || stamp_s > drone.stream.newest_s + 0.5 * setup_.dt_s;
  if (is_new) take_new(index, observed, stamp_s, expected);
  if (drone.is_doubted)
    drone.believed.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  else if (drone.stream.is_frozen && drone.is_ours)
    drone.believed.age_s = now_s_ - drone.stream.changed_s;
}

void FaultMonitor::watch(Excess& excess, double measured, double threshold) const noexcept {
  if (measured > threshold) {
    excess.calm_s = 0.0;
    if (excess.is_raised) return;
    excess.is_raised = true;
    excess.since_s = now_s_;
    excess.relapses = std::min(excess.relapses + 1, kMostRelapses);
  } else if (measured < kOver * threshold) {
    excess.calm_s += setup_.dt_s;
    const double needed_s = setup_.health.recovery_s * std::exp2(excess.relapses - 1);
    if (excess.calm_s >= needed_s) excess.is_raised = false;
    if (excess.calm_s >= kForgottenS) excess.relapses = 0;
  } else {
    excess.calm_s = 0.0;
  }
}

void FaultMonitor::watch_mode(Watched& drone, const DroneObservation& observed,
                              const DroneMemory& memory) const noexcept {
  const VehicleMode before = drone.mode;
  if (observed.mode != VehicleMode::kUnknown) drone.mode = observed.mode;
  const bool came_down = before == VehicleMode::kFlying && drone.mode == VehicleMode::kGrounded;
  const bool has_changed = before != drone.mode && before != VehicleMode::kUnknown;
  if (has_changed && (is_on_its_own(drone.mode) || came_down) && !is_asked_for(memory)) {
    if (!drone.is_own_mode) drone.own_mode_since_s = now_s_;
    drone.is_own_mode = true;
  } else if (has_changed && !is_on_its_own(drone.mode)) {
    drone.is_own_mode = false;
  }
}

void FaultMonitor::watch_border(Watched& drone) const noexcept {
  if (!drone.has_seen || !drone.is_ours) {
    drone.is_outside = false;
    return;
  }
  const Vec2 size(setup_.field.length_x, setup_.field.length_y);
  const Vec2 beyond = (-drone.place).cwiseMax(drone.place - size).cwiseMax(Vec2::Zero());
  const double out_m = beyond.norm();
  drone.off_m = drone.is_doubted ? drone.off_m : out_m;
  if (out_m <= 0.0) {
    drone.was_inside = true;
    drone.is_outside = false;
  } else if (drone.was_inside && !drone.is_outside && out_m > setup_.parameters.bounds.outside_m) {
    drone.is_outside = true;
    drone.outside_since_s = now_s_;
  }
}

/// Where several things are wrong: first whether what is known of it is true at all.
void FaultMonitor::name_fault(Watched& drone) const noexcept {
  const dynamics::FaultBounds& bounds = setup_.parameters.bounds;
  FaultReport& report = drone.report;
  if (drone.is_doubted && now_s_ - drone.doubted_since_s >= bounds.confirm_s)
    report = {drone.other ? Fault::kSwapped : Fault::kJumped, drone.doubted_since_s, drone.off_m, bounds.jump_m,
              drone.other};
  else if (drone.stream.is_frozen)
    report = {Fault::kFrozen, drone.stream.changed_s, now_s_ - drone.stream.changed_s, bounds.frozen_s, {}};
  else if (drone.is_own_mode)
    report = {Fault::kOwnMode, drone.own_mode_since_s, 0.0, 0.0, {}};
  else if (drone.is_outside)
    report = {Fault::kOutside, drone.outside_since_s, drone.off_m, bounds.outside_m, {}};
  else if (drone.disagreement_excess.is_raised)
    report = {
        Fault::kDisagreeing, drone.disagreement_excess.since_s, drone.disagreement.norm(), bounds.disagreement_m, {}};
  else if (drone.residual_excess.is_raised)
    report = {
        Fault::kNotFollowing, drone.residual_excess.since_s, drone.residual.norm(), residual_threshold(drone), {}};
  else
    report = {};
}

/// Where it is seen to be where its orders lead it, it has the velocity that these give it, and not the one reported:
/// others would keep clear of where that leads, and come too close to where it is.
bool FaultMonitor::is_velocity_alone_wrong(const Watched& drone) noexcept {
  return drone.disagreement_excess.is_raised && !drone.residual_excess.is_raised && !drone.is_doubted &&
         !drone.stream.is_frozen && !drone.is_silent;
}

void FaultMonitor::watch_motion(Watched& drone, double link_age_s) const noexcept {
  const bool is_silent = link_age_s > setup_.parameters.bounds.silent_s;
  if (drone.is_silent && !is_silent) {
    rest_model(drone, drone.velocity);
    drone.was_silent = drone.is_doubted;
  }
  drone.is_silent = is_silent;
  if (!drone.is_ours) {
    drone.residual_excess.is_raised = false;
    drone.disagreement_excess.is_raised = false;
  } else if (!is_silent) {
    watch(drone.residual_excess, drone.residual.norm(), residual_threshold(drone));
    watch(drone.disagreement_excess, drone.disagreement.norm(), setup_.parameters.bounds.disagreement_m);
  }
}

void FaultMonitor::look(std::span<const DroneObservation> observed, std::span<const DroneMemory> drones,
                        std::span<const Motion> expected, const FlownOrders& flown) noexcept {
  assert(!watches() || (observed.size() == watched_.size() && drones.size() == watched_.size()));
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    Watched& drone = watched_[i];
    watch_mode(drone, observed[i], drones[i]);
    drone.is_ours = is_ours(drones[i], drone.mode);
    drone.is_bound = is_bound_to_its_reach(drones[i], drone.mode);
    fly_model(drone, i, flown);
    take(i, observed[i], expected[i]);
    drone.stream.is_frozen = drone.stream.is_frozen && drone.is_ours;
    drone.is_doubted = drone.is_doubted && drone.is_bound;
    watch_motion(drone, observed[i].link_age_s);
    watch_border(drone);
    name_fault(drone);
    if (is_velocity_alone_wrong(drone)) drone.believed.velocity = drone.model.velocity();
  }
  now_s_ += setup_.dt_s;
}

}  // namespace vigil::swarm
