// What of recharging is decided once a second: who goes when.

#include <algorithm>
#include <cmath>
#include <tuple>

#include "vigil/swarm/recharging.hpp"

namespace vigil::swarm {
namespace {

/// Of a time that is left, about what will surely be left of it when it comes to an end: that is when a drone goes.
constexpr double kSureShare = 0.6;
/// A turn is planned for longer than it should take by so much, so that one that takes longer is not in the next one's
/// way.
constexpr double kTurnsBuffer = 1.25;
/// From a charged battery to the take-off's beginning.
constexpr double kGetReadyS = 5.0;

/// A plan that comes so much too late is as good as feasible; one that was good before, so much.
constexpr double kPunctualS = 2.0;
constexpr double kStillGoodS = 60.0;
/// Numbers of drones away that are tried for one plan.
constexpr std::size_t kTries = 16;

/// Whoever makes room must have taken so much beyond the reserve.
constexpr double kWorthGoing = 0.4;
/// So long before a drone has to go, another one makes room for it.
constexpr double kRoomAheadS = 20.0;
/// A drone that is sent to a pad that is still taken arrives so long after that one has left.
constexpr double kBehindS = 10.0;

bool may_be_sent(const DroneMemory& memory) {
  const bool is_up = memory.last_good.mode == VehicleMode::kFlying;
  const bool is_ours =
      memory.intent == Intent::kCover || memory.intent == Intent::kHold || memory.intent == Intent::kGoTo;
  return is_up && is_ours && memory.energy.is_known();
}

bool leaves_its_pad(const DroneMemory& memory) { return memory.intent == Intent::kTakeOff; }

/// Away from coverage, and back by itself.
bool is_in_turn(const DroneMemory& memory) {
  return leaves_its_pad(memory) || (memory.intent == Intent::kRecharge && memory.errand != Errand::kWait);
}

}  // namespace

void Recharging::foresee_returns(const Situation& now) noexcept {
  for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
    const bool comes_back = visits_[drone].pad >= 0 && is_in_turn(now.drones[drone]);
    visits_[drone].away_for_s = comes_back ? back_in_s(now.drones[drone], drone) : kNobodyPlans;
  }
}

/// Those first whose batteries end first.
void Recharging::gather_candidates(const Situation& now) noexcept {
  candidates_.clear();
  for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
    const DroneMemory& memory = now.drones[drone];
    if (visits_[drone].pad >= 0) continue;
    visits_[drone].leaves_in_s = kNobodyPlans;
    if (!may_be_sent(memory) || !std::isfinite(way_to_one_of_s(drone, pads_.size()))) continue;
    const TimeLeft left = *memory.energy.time_to(reserve_);
    candidates_.push_back(
        {.drone = drone, .left_s = left.s, .surely_left_s = left.least_s, .is_free = memory.intent == Intent::kCover});
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& one, const Candidate& other) {
    return std::tie(one.surely_left_s, one.drone) < std::tie(other.surely_left_s, other.drone);
  });
}

std::size_t Recharging::away(const Situation& now) const noexcept {
  std::size_t count = 0;
  for (std::size_t drone = 0; drone < visits_.size(); ++drone)
    count += visits_[drone].pad >= 0 && is_in_turn(now.drones[drone]) ? std::size_t{1} : 0;
  return count;
}

/// Those that work, less those on which somebody stays.
std::size_t Recharging::usable_pads(const Situation& now) const noexcept {
  std::size_t count = 0;
  for (std::size_t pad = 0; pad < pads_.size(); ++pad) count += is_usable(pad) ? std::size_t{1} : 0;
  for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
    const std::int32_t pad = visits_[drone].pad;
    if (pad >= 0 && is_usable(static_cast<std::size_t>(pad)) && !is_in_turn(now.drones[drone])) --count;
  }
  return count;
}

double Recharging::back_in_s(const DroneMemory& memory, std::size_t drone) const noexcept {
  if (leaves_its_pad(memory)) return take_off_s_;
  const Visit& visit = visits_[drone];
  const ChargingPad& pad = pad_at(visit.pad);
  const bool is_there = memory.errand == Errand::kCharge;
  const double there_in_s = is_there ? 0.0 : way_s(drone, static_cast<std::size_t>(visit.pad)) + landing_s_;
  const double charge = std::max(0.0, memory.energy.charge() - there_in_s * memory.energy.rate_per_s());
  return there_in_s + std::max(0.0, kFull - charge) * pad.full_in_s + kGetReadyS + take_off_s_;
}

/// From leaving with what the flight needs above the reserve until covering again, by the slowest station.
double Recharging::time_away_s(double flight_s) const noexcept {
  double slowest_s = 0.0;
  for (std::size_t pad = 0; pad < pads_.size(); ++pad)
    if (is_usable(pad)) slowest_s = std::max(slowest_s, pads_[pad].full_in_s);
  return flight_s + std::max(0.0, kFull - reserve_) * slowest_s + kGetReadyS + take_off_s_;
}

/// So many are away on average where each goes as late as it may: fewer at a time is not enough in the long run.
std::size_t Recharging::least_turns(const Situation& now) noexcept {
  double away_on_average = 0.0;
  for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
    const DroneMemory& memory = now.drones[drone];
    const bool is_away = visits_[drone].pad >= 0 && is_in_turn(memory);
    if (!is_away && !may_be_sent(memory)) continue;
    const double flight_s = way_to_one_of_s(drone, 1) + landing_s_;
    const double away_s = time_away_s(flight_s);
    const double covers_s = std::max(0.0, (kFull - reserve_) / memory.energy.rate_per_s() - flight_s);
    away_on_average += away_s / (away_s + covers_s);
  }
  constexpr double kMost = 1e6;  // also for what is not a number
  return static_cast<std::size_t>(std::ceil(std::clamp(away_on_average, 1.0, kMost)));
}

/// Everybody takes one of `most_away` turns, from when it leaves until it covers again: so that no more are away at a
/// time, and each finds a pad free, the farthest of so many at worst.
void Recharging::plan_turns(const Situation& now, std::size_t most_away) noexcept {
  free_at_s_.clear();
  for (std::size_t drone = 0; drone < visits_.size(); ++drone)
    if (visits_[drone].pad >= 0 && is_in_turn(now.drones[drone]))
      free_at_s_.push_back(std::min(back_in_s(now.drones[drone], drone), kLongestS));
  while (free_at_s_.size() < most_away) free_at_s_.push_back(0.0);
  needs_.clear();
  for (const Candidate& candidate : candidates_) {
    const double flight_s = way_to_one_of_s(candidate.drone, most_away) + landing_s_;
    needs_.push_back({.latest_leave_s = latest_leave_s(candidate, flight_s),
                      .way_s = 0.0,
                      .charge_s = kTurnsBuffer * time_away_s(flight_s)});
  }
  turns_.resize(needs_.size());  // within its capacity
  planner_.plan(needs_, free_at_s_, turns_);
}

/// Where there are too few pads for that, they are what is shared out: a drone sets out while its pad is still taken.
void Recharging::plan_pads(const Situation& now) noexcept {
  free_at_s_.clear();
  for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
    const std::int32_t last = next_[pad] >= 0 ? next_[pad] : users_[pad];
    if (!is_usable(pad)) continue;
    const auto drone = static_cast<std::size_t>(std::max(last, 0));
    if (last >= 0 && !is_in_turn(now.drones[drone])) continue;
    free_at_s_.push_back(last < 0 ? 0.0 : std::min(back_in_s(now.drones[drone], drone), kLongestS));
  }
  needs_.clear();
  for (const Candidate& candidate : candidates_) {
    const double way = way_to_one_of_s(candidate.drone, pads_.size());
    const double flight_s = way + landing_s_;
    needs_.push_back(
        {.latest_leave_s = latest_leave_s(candidate, flight_s), .way_s = way, .charge_s = time_away_s(flight_s) - way});
  }
  turns_.resize(needs_.size());  // within its capacity
  planner_.plan(needs_, free_at_s_, turns_);
}

double Recharging::latest_leave_s(const Candidate& candidate, double flight_s) const noexcept {
  return candidate.left_s - (flight_s + slack_s(flight_s)) / kSureShare;
}

double Recharging::too_soon_s() const noexcept {
  double most_s = 0.0;
  for (const RechargeTurn& turn : turns_) most_s = std::max(most_s, turn.too_soon_s);
  return most_s;
}

void Recharging::plan(const Situation& now) noexcept {
  foresee_returns(now);
  gather_candidates(now);
  const std::size_t pads = usable_pads(now);
  if (pads == 0 || candidates_.empty()) return;
  const std::size_t are_away = away(now);
  const std::size_t most = std::max(are_away, std::min(pads, candidates_.size() + are_away));
  const std::size_t least = std::max({std::size_t{1}, are_away, least_turns(now), planned_away_ - 1});
  std::size_t turns = std::min(least, most);
  for (std::size_t tries = 0;; ++turns, ++tries) {
    plan_turns(now, turns);
    const double good_s = turns == planned_away_ ? kStillGoodS : kPunctualS;
    if (turns >= most || tries >= kTries || too_soon_s() <= good_s) break;
  }
  planned_away_ = turns;
  are_pads_short_ = turns >= most && too_soon_s() > kStillGoodS;
  if (are_pads_short_) plan_pads(now);
  for (std::size_t n = 0; n < candidates_.size(); ++n) {
    Visit& visit = visits_[candidates_[n].drone];
    visit.leaves_in_s = std::max(0.0, turns_[n].leave_s);
    visit.away_for_s = time_away_s(way_to_one_of_s(candidates_[n].drone, turns) + landing_s_);
  }
  send_whose_time_it_is(now, turns);
}

void Recharging::send_whose_time_it_is(const Situation& now, std::size_t most_away) noexcept {
  std::size_t are_away = away(now);
  std::size_t without_pad = 0;
  for (std::size_t n = 0; n < candidates_.size(); ++n) {
    const Candidate& candidate = candidates_[n];
    const std::int32_t pad = pad_for(now, candidate.drone);
    const double flight_s = landing_s_ + (pad >= 0 ? way_s(candidate.drone, static_cast<std::size_t>(pad))
                                                   : way_to_one_of_s(candidate.drone, 1));
    const double spare_s = candidate.surely_left_s - flight_s - slack_s(flight_s);
    const bool has_its_turn =
        candidate.is_free && turns_[n].leave_s <= 0.0 && (are_away < most_away || are_pads_short_);
    if (pad >= 0 && (spare_s <= 0.0 || has_its_turn)) {
      send(now, candidate.drone, pad);
      ++are_away;
    } else if (pad < 0 && spare_s <= take_off_s_ + kRoomAheadS) {
      ++without_pad;
    }
  }
  make_room(now, without_pad);
}

std::int32_t Recharging::pad_for(const Situation& now, std::size_t drone) const noexcept {
  const std::int32_t free = nearest_free_pad(drone);
  if (free >= 0 || !are_pads_short_) return free;
  for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
    if (!is_usable(pad) || next_[pad] >= 0) continue;
    const auto user = static_cast<std::size_t>(users_[pad]);
    const bool is_there = leaves_its_pad(now.drones[user]) ||
                          (is_in_turn(now.drones[user]) && now.drones[user].errand == Errand::kCharge);
    if (is_there && back_in_s(now.drones[user], user) + kBehindS <= way_s(drone, pad))
      return static_cast<std::int32_t>(pad);
  }
  return -1;
}

/// Nobody waits for a pad in the air.
void Recharging::hurry_whose_pad_is_awaited(const Situation& now) noexcept {
  for (std::size_t pad = 0; pad < pads_.size(); ++pad) {
    if (next_[pad] < 0 || way_s(static_cast<std::size_t>(next_[pad]), pad) > take_off_s_ + kBehindS) continue;
    DroneMemory& memory = now.drones[static_cast<std::size_t>(users_[pad])];
    const bool charges = memory.intent == Intent::kRecharge && memory.errand == Errand::kCharge;
    if (charges && memory.energy.charge() >= reserve_ + kWorthGoing) memory.intent = Intent::kTakeOff;
  }
}

/// Whoever has been charged most goes first.
void Recharging::make_room(const Situation& now, std::size_t wanted) noexcept {
  std::size_t made = 0;
  for (std::size_t drone = 0; drone < visits_.size(); ++drone)
    made += visits_[drone].pad >= 0 && leaves_its_pad(now.drones[drone]) ? std::size_t{1} : 0;
  for (; made < wanted; ++made) {
    DroneMemory* fullest = nullptr;
    for (std::size_t drone = 0; drone < visits_.size(); ++drone) {
      DroneMemory& memory = now.drones[drone];
      const bool charges =
          visits_[drone].pad >= 0 && memory.intent == Intent::kRecharge && memory.errand == Errand::kCharge;
      if (!charges || memory.energy.charge() < reserve_ + kWorthGoing) continue;
      if (fullest == nullptr || memory.energy.charge() > fullest->energy.charge()) fullest = &memory;
    }
    if (fullest == nullptr) return;
    fullest->intent = Intent::kTakeOff;
  }
}

}  // namespace vigil::swarm
