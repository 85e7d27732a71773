#include "vigil/swarm/recharging.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/core/safety/barrier.hpp"

namespace vigil::swarm {
namespace {

constexpr double kPlanEveryS = 1.0;
/// Ways that are measured for one plan; a way costs microseconds where there are many no-fly polygons.
constexpr std::size_t kWaysAPlan = 512;

/// How close to a pad, in its radii, a drone begins to land; farther off where it gets no closer for so long.
constexpr double kAtPad = 0.5;
constexpr double kNearPad = 1.5;
constexpr double kNearForS = 15.0;
constexpr int kMostLandings = 4;
/// A drone's place beside its pad is a mean over so long; so long after it came down it is judged.
constexpr double kSeenOverS = 1.0;
constexpr double kDownForS = 4.0;

/// A charge is watched from when the reports have settled, for as long as it takes to grow by so much; less than that
/// share of it is none. Above kNearlyFull a battery that takes no more is full.
constexpr double kSettleS = 15.0;
constexpr double kWatchedGrowth = 0.06;
constexpr double kLeastShare = 0.3;
constexpr double kNearlyFull = 0.9;
constexpr double kGrowthAgain = 0.03;  // by which a station is seen to work again

/// Of barrier radii: from where on a way to a pad is kept free, and how wide it is.
constexpr double kLastWay = 4.0;
constexpr double kWayWidth = 1.5;

bool is_grounded(const DroneMemory& memory) { return memory.last_good.mode == VehicleMode::kGrounded; }
bool is_flying(const DroneMemory& memory) { return memory.last_good.mode == VehicleMode::kFlying; }

Vec2 safe_normalized(const Vec2& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec2(v / length) : Vec2::Zero();
}

Vec2 nearest_on(const Vec2& from, const Vec2& to, const Vec2& place) {
  const Vec2 way = to - from;
  const double squared = way.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(way.dot(place - from) / squared, 0.0, 1.0) : 0.0;
  return from + share * way;
}

std::uint64_t plan_period(double dt_s) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(kPlanEveryS / dt_s)));
}

std::size_t stations_of(const std::vector<ChargingPad>& pads) {
  std::size_t stations = 0;
  for (const ChargingPad& pad : pads) stations = std::max(stations, pad.station + 1);
  return stations;
}

}  // namespace

Recharging::Recharging(const SwarmParameters& parameters)
    : pads_(parameters.recharge.pads),
      middle_(0.5 * parameters.field.length_x, 0.5 * parameters.field.length_y),
      take_off_s_(parameters.recharge.take_off_s),
      landing_s_(parameters.recharge.landing_s),
      reserve_(parameters.health.battery_reserve),
      u_max_m_s_(parameters.barrier.u_max_m_s),
      lag_s_(parameters.barrier.lag_s),
      spacing_m_(safety::barrier_radius(parameters.barrier)),
      dt_s_(parameters.dt_s),
      period_(plan_period(parameters.dt_s)),
      planner_(pads_.empty() ? 0 : parameters.drones, pads_.size()),
      visits_(pads_.empty() ? 0 : parameters.drones),
      has_failed_(stations_of(pads_), false),
      users_(pads_.size(), -1),
      next_(pads_.size(), -1),
      ways_s_(visits_.size() * pads_.size(), kNobodyPlans) {
  candidates_.reserve(visits_.size());
  needs_.reserve(visits_.size());
  turns_.reserve(visits_.size());
  free_at_s_.reserve(std::max(visits_.size(), pads_.size()));
  sorted_s_.reserve(pads_.size());
}

void Recharging::set_tick(double dt_s) noexcept {
  dt_s_ = dt_s;
  period_ = plan_period(dt_s);
}

void Recharging::decide(const Situation& now, Snapshot& out) noexcept {
  if (!has_pads()) return;
  now.ways.work();
  learn_headway(now);
  for (std::size_t drone = 0; drone < visits_.size(); ++drone)
    if (visits_[drone].pad >= 0) follow(now, drone, out);
  if (now.tick % period_ == 0) look_after_stations(now);
}

/// Who has flown about one way for long enough to have answered shows what flying that way comes to.
void Recharging::learn_headway(const Situation& now) noexcept {
  constexpr double kSame = 0.95;  // cosine
  constexpr double kAnswers = 3.0;
  constexpr double kLeastAnswerS = 1.0;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    const Vec2& told = now.told[i];
    Visit& visit = visits_[i];
    const double speed = told.norm();
    const bool is_fast = speed > 0.5 * u_max_m_s_ && is_flying(now.drones[i]);
    const bool is_same = is_fast && told.dot(visit.told) > kSame * speed * visit.told.norm();
    if (!is_same) visit.told = is_fast ? told : Vec2::Zero();
    visit.told_s = is_same ? visit.told_s + dt_s_ : 0.0;
    if (visit.told_s > kAnswers * lag_s_ + kLeastAnswerS) headway_.note(told, now.drones[i].last_good.velocity, dt_s_);
  }
}

void Recharging::see_beside(const DroneMemory& memory, Visit& visit) const noexcept {
  const Vec2 seen = memory.last_good.position - pad_at(visit.pad).place;
  visit.beside += std::min(1.0, dt_s_ / kSeenOverS) * (seen - visit.beside);
}

/// With half of the reserve: where a pad is in reach that is better than to come down elsewhere.
bool Recharging::can_fly_for(const DroneMemory& memory, const Visit& visit, double time_s) const noexcept {
  return std::max(visit.surely_left_s, surely_left_s(memory)) >= time_s + slack_s(time_s);
}

double Recharging::surely_left_s(const DroneMemory& memory) const noexcept {
  const auto left = memory.energy.time_to(0.5 * reserve_);
  return left ? left->least_s : 0.0;
}

void Recharging::take(std::size_t drone, std::size_t pad) noexcept {
  std::int32_t& place = users_[pad] < 0 ? users_[pad] : next_[pad];
  place = static_cast<std::int32_t>(drone);
  visits_[drone].pad = static_cast<std::int32_t>(pad);
}

void Recharging::give_back(std::size_t drone) noexcept {
  const auto pad = static_cast<std::size_t>(visits_[drone].pad);
  if (users_[pad] == static_cast<std::int32_t>(drone)) users_[pad] = next_[pad];
  next_[pad] = -1;
  visits_[drone].pad = -1;
}

void Recharging::note_station(std::int32_t pad, bool has_failed, Snapshot& out) noexcept {
  const std::size_t station = pad_at(pad).station;
  if (has_failed_[station] == has_failed) return;
  has_failed_[station] = has_failed;
  out.note({.kind = has_failed ? EventKind::kStationFailed : EventKind::kStationWorks,
            .station = static_cast<std::uint32_t>(station)});
}

void Recharging::follow(const Situation& now, std::size_t drone, Snapshot& out) noexcept {
  DroneMemory& memory = now.drones[drone];
  Visit& visit = visits_[drone];
  if (!is_grounded(memory)) visit.surely_left_s = surely_left_s(memory);
  if (memory.intent != Intent::kRecharge) {
    // On the pad it keeps the pad, whatever it is to do; off it, it does not need it.
    const bool is_off = !is_grounded(memory) && memory.last_good.mode != VehicleMode::kTakingOff;
    if (is_off) give_back(drone);
    return;
  }
  switch (memory.errand) {
    case Errand::kFly:
      return follow_flight(memory, drone);
    case Errand::kLand:
      return follow_landing(memory, drone);
    case Errand::kCharge:
      return follow_charge(memory, visit, out);
    case Errand::kWait:
      return follow_wait(memory, visit, out);
    case Errand::kRise:
      if (is_flying(memory)) memory.errand = Errand::kFly;
      return;
  }
}

void Recharging::follow_flight(DroneMemory& memory, std::size_t drone) noexcept {
  Visit& visit = visits_[drone];
  if (is_grounded(memory)) return follow_landing(memory, drone);
  const ChargingPad& pad = pad_at(visit.pad);
  see_beside(memory, visit);
  const double distance_m = std::max(visit.beside.norm(), (memory.last_good.position - pad.place).norm());
  visit.near_s = distance_m <= kNearPad * pad.radius_m ? visit.near_s + dt_s_ : 0.0;
  const bool is_there = distance_m <= kAtPad * pad.radius_m || visit.near_s > kNearForS;
  const bool is_its_own = users_[static_cast<std::size_t>(visit.pad)] == static_cast<std::int32_t>(drone);
  if (is_there && is_its_own && memory.activity == Activity::kReturning) memory.errand = Errand::kLand;
}

void Recharging::follow_landing(DroneMemory& memory, std::size_t drone) noexcept {
  Visit& visit = visits_[drone];
  see_beside(memory, visit);
  visit.down_s = is_grounded(memory) ? visit.down_s + dt_s_ : 0.0;
  if (visit.down_s < kDownForS) return;
  visit.near_s = 0.0;
  visit.down_s = 0.0;
  if (visit.beside.norm() <= pad_at(visit.pad).radius_m) return begin_charge(memory, visit);
  try_again_or_stay(memory, drone);
}

/// It stands beside its pad, or without contact.
void Recharging::try_again_or_stay(DroneMemory& memory, std::size_t drone) noexcept {
  Visit& visit = visits_[drone];
  ++visit.landings_in_vain;
  constexpr double kBackOnPadS = 20.0;
  if (visit.landings_in_vain < kMostLandings && can_fly_for(memory, visit, take_off_s_ + kBackOnPadS + landing_s_)) {
    memory.errand = Errand::kRise;
    return;
  }
  memory.intent = Intent::kStayDown;
  give_back(drone);
}

void Recharging::begin_charge(DroneMemory& memory, Visit& visit) const noexcept {
  memory.errand = Errand::kCharge;
  visit.watched_s = -kSettleS;
  visit.watched_charge = memory.energy.charge();
}

void Recharging::follow_charge(DroneMemory& memory, Visit& visit, Snapshot& out) noexcept {
  const double charge = memory.energy.charge();
  if (charge >= kFull) {
    memory.intent = Intent::kTakeOff;
    return;
  }
  visit.watched_s += dt_s_;
  if (visit.watched_s <= 0.0) visit.watched_charge = charge;
  if (visit.watched_s < kWatchedGrowth * pad_at(visit.pad).full_in_s) return;
  const bool grows = charge - visit.watched_charge >= kLeastShare * kWatchedGrowth;
  visit.watched_s = 0.0;
  visit.watched_charge = charge;
  if (grows) return note_station(visit.pad, false, out);
  if (charge >= kNearlyFull) {
    memory.intent = Intent::kTakeOff;
    return;
  }
  // The first time it may be the drone that stands badly.
  constexpr double kBackOnPadS = 20.0;
  if (visit.landings_in_vain == 0 && can_fly_for(memory, visit, take_off_s_ + kBackOnPadS + landing_s_)) {
    ++visit.landings_in_vain;
    memory.errand = Errand::kRise;
    return;
  }
  note_station(visit.pad, true, out);
  memory.errand = Errand::kWait;
}

void Recharging::follow_wait(DroneMemory& memory, Visit& visit, Snapshot& out) noexcept {
  const double charge = memory.energy.charge();
  visit.watched_charge = std::min(visit.watched_charge, charge);
  if (charge < visit.watched_charge + kGrowthAgain) return;
  note_station(visit.pad, false, out);
  begin_charge(memory, visit);
}

void Recharging::look_after_stations(const Situation& now) noexcept {
  take_pads_that_are_stood_on(now);
  measure_ways(now);
  for (std::size_t drone = 0; drone < visits_.size(); ++drone)
    if (visits_[drone].pad >= 0) move_on(now, drone);
  plan(now);
  hurry_whose_pad_is_awaited(now);
}

/// Also by who was not sent there.
void Recharging::take_pads_that_are_stood_on(const Situation& now) noexcept {
  for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
    if (visits_[drone].pad >= 0 || !is_grounded(now.drones[drone])) continue;
    for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
      const double distance_m = (now.drones[drone].last_good.position - pads_[pad].place).norm();
      if (users_[pad] >= 0 || !(distance_m <= pads_[pad].radius_m)) continue;
      take(drone, pad);
      break;
    }
  }
}

/// Who flies to a station that has failed, or waits there, takes another one where it can.
void Recharging::move_on(const Situation& now, std::size_t drone) noexcept {
  DroneMemory& memory = now.drones[drone];
  Visit& visit = visits_[drone];
  const bool flies = memory.errand == Errand::kFly;
  if (memory.intent != Intent::kRecharge || !(flies || memory.errand == Errand::kWait)) return;
  if (is_usable(static_cast<std::size_t>(visit.pad))) return;
  const std::int32_t other = nearest_free_pad(drone);
  if (other < 0) return;
  const double flight_s = way_s(drone, static_cast<std::size_t>(other)) + landing_s_;
  if (!can_fly_for(memory, visit, flies ? flight_s : take_off_s_ + flight_s)) return;
  give_back(drone);
  send(now, drone, other);
  if (!flies) memory.errand = Errand::kRise;
}

void Recharging::send(const Situation& now, std::size_t drone, std::int32_t pad) noexcept {
  take(drone, static_cast<std::size_t>(pad));
  Visit& visit = visits_[drone];
  visit.beside = now.drones[drone].last_good.position - pad_at(pad).place;
  visit.near_s = 0.0;
  visit.down_s = 0.0;
  visit.landings_in_vain = 0;
  visit.leaves_in_s = 0.0;
  DroneMemory& memory = now.drones[drone];
  memory.intent = Intent::kRecharge;
  memory.errand = Errand::kFly;
  memory.place = pad_at(pad).place;
}

/// In turns where there are many drones; what was measured some time ago counts for longer by that.
void Recharging::measure_ways(const Situation& now) noexcept {
  const std::size_t drones = std::clamp<std::size_t>(kWaysAPlan / pads_.size(), 1, visits_.size());
  const double turn_s = kPlanEveryS * std::floor(static_cast<double>(visits_.size() - 1) / static_cast<double>(drones));
  for (std::size_t n = 0; n < drones; ++n) {
    const std::size_t drone = next_to_measure_;
    next_to_measure_ = (next_to_measure_ + 1) % visits_.size();
    const Vec2& from = now.drones[drone].last_good.position;
    if (!from.allFinite()) continue;
    for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
      const double speed = u_max_m_s_ * headway_.least(pads_[pad].place - from);
      // Towards a place a drone slows down from a spacing away: exponentially, with spacing / u_max.
      const double slow_m = std::max(0.0, std::log(spacing_m_ / (kAtPad * pads_[pad].radius_m))) * spacing_m_;
      const double length_m = now.ways.length_m(from, pads_[pad].place) + slow_m;
      ways_s_[drone * pads_.size() + pad] = length_m / speed + turn_s;
    }
  }
}

double Recharging::way_s(std::size_t drone, std::size_t pad) const noexcept {
  return ways_s_[drone * pads_.size() + pad];
}

double Recharging::way_to_one_of_s(std::size_t drone, std::size_t pads) noexcept {
  sorted_s_.clear();
  for (std::size_t pad = 0; pad < pads_.size(); ++pad)
    if (is_usable(pad)) sorted_s_.push_back(way_s(drone, pad));
  if (sorted_s_.empty()) return kNobodyPlans;
  const std::size_t at = std::min(pads, sorted_s_.size()) - 1;
  std::nth_element(sorted_s_.begin(), sorted_s_.begin() + static_cast<std::ptrdiff_t>(at), sorted_s_.end());
  return sorted_s_[at];
}

void Recharging::make_way(std::span<const DroneMemory> drones, std::span<Vec2> u_nom) const noexcept {
  const double last_way_m = kLastWay * spacing_m_;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    const DroneMemory& coming = drones[i];
    const bool comes = coming.activity == Activity::kReturning || coming.activity == Activity::kLanding;
    if (visits_[i].pad < 0 || coming.intent != Intent::kRecharge || !comes) continue;
    const Vec2& from = coming.last_good.position;
    const Vec2& to = pad_at(visits_[i].pad).place;
    if ((to - from).norm() > last_way_m) continue;
    for (std::size_t other = 0; other < visits_.size(); ++other) {
      if (drones[other].activity != Activity::kActive) continue;
      const Vec2& place = drones[other].last_good.position;
      const Vec2 beside = place - nearest_on(from, to, place);
      if (beside.norm() >= kWayWidth * spacing_m_) continue;
      const Vec2 wish = safe_normalized(beside) + 0.5 * safe_normalized(middle_ - place);  // not into a corner
      u_nom[other] = u_max_m_s_ * safe_normalized(wish);
    }
  }
}

std::int32_t Recharging::nearest_free_pad(std::size_t drone) const noexcept {
  std::int32_t nearest = -1;
  for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
    if (users_[pad] >= 0 || !is_usable(pad)) continue;
    if (nearest < 0 || way_s(drone, pad) < way_s(drone, static_cast<std::size_t>(nearest)))
      nearest = static_cast<std::int32_t>(pad);
  }
  return nearest;
}

}  // namespace vigil::swarm
