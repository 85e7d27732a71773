#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vigil/core/guidance/way_finder.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/headway.hpp"
#include "vigil/swarm/parameters.hpp"
#include "vigil/swarm/recharge_plan.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::swarm {

/// Sends drones to pads to be charged, and back to coverage, by their intents (Intent::kRecharge). What it keeps:
///
///   - In time: a drone leaves, whatever it does, when what surely is left of its battery above the reserve just covers
///     the way to a pad, round no-fly polygons and against the wind that drones have met, and the landing.
///   - As few at a time as the energy allows: drones that would need pads together go in turns, some of them sooner.
///     Every second the least number of drones away for which all can be charged in time is looked for, and who is to
///     go by that plan goes. Nobody waits for a pad in the air.
///   - Each pad is kept for one drone from when that is sent there until it is in the air again. Only where pads are
///     too few for that a drone is sent to a pad that will be free by the time when it arrives.
///   - A pad where a charge does not grow belongs to a station that has failed: nobody is sent there, and who stands
///     there flies to another pad, with half of the reserve if need be, or stays down. It works again where a charge
///     grows.
///   - Where pads are short, the drone that was charged most makes room for one that has to come down.
///
/// Who comes down elsewhere stays down until somebody lets it take off. An operator may hold or send a drone that is on
/// its way; it goes again when its battery demands it. A value; allocates when it is constructed, and never again, but
/// for a copy in its first decide(). One thread at a time.
class Recharging {
 public:
  explicit Recharging(const SwarmParameters& parameters);

  [[nodiscard]] bool has_pads() const noexcept { return !pads_.empty(); }

  /// What is known when a tick begins; spans of all drones.
  struct Situation {
    std::span<DroneMemory> drones;
    std::span<const Vec2> told;  ///< the velocities of the last tick
    guidance::WayFinder& ways;
    std::uint64_t tick = 0;
  };

  /// Once a tick, before drones are judged: changes intents, errands and places, and notes what stations do.
  void decide(const Situation& now, Snapshot& out) noexcept;

  /// Covering drones that are in the way of one on its last way to a pad wish themselves away from there: they have
  /// time, it has not, and where both insist the safety filter lets both hover. Field frame.
  void make_way(std::span<const DroneMemory> drones, std::span<Vec2> u_nom) const noexcept;

  /// The pad that is kept for a drone; -1: none. Precondition of all three: has_pads().
  [[nodiscard]] std::int32_t pad_of(std::size_t drone) const noexcept { return visits_[drone].pad; }
  /// See DroneSnapshot::leaves_in_s.
  [[nodiscard]] double leaves_in_s(std::size_t drone) const noexcept { return visits_[drone].leaves_in_s; }

  /// See DroneSnapshot::away_for_s.
  [[nodiscard]] double away_for_s(std::size_t drone) const noexcept { return visits_[drone].away_for_s; }

  /// From now on a tick lasts so long. Precondition: > 0.
  void set_tick(double dt_s) noexcept;

  /// A battery is full enough to go.
  static constexpr double kFull = 0.97;

 private:
  /// A drone's dealings with pads.
  struct Visit {
    std::int32_t pad = -1;
    double leaves_in_s = kNobodyPlans;
    double away_for_s = kNobodyPlans;
    Vec2 beside = Vec2::Zero();  ///< from its pad to it, over a second or so: single sightings are not that good
    double near_s = 0.0;         ///< kFly: it has been close to its pad for so long
    double down_s = 0.0;         ///< kFly, kLand: it has been on the ground for so long
    double surely_left_s =
        0.0;                 ///< until half of the reserve, when it was in the air last: on the ground nothing is used
    double watched_s = 0.0;  ///< kCharge, kWait: since `watched_charge` was
    double watched_charge = 0.0;
    int landings_in_vain = 0;
    Vec2 told = Vec2::Zero();  ///< about this, for told_s
    double told_s = 0.0;
  };
  /// A drone that may be sent.
  struct Candidate {
    std::size_t drone = 0;
    double left_s = 0.0;  ///< in the air until the reserve, best guess
    double surely_left_s = 0.0;
    bool is_free = false;  ///< goes by the plan; false: not before its battery demands it
  };
  static constexpr double kNobodyPlans = std::numeric_limits<double>::infinity();
  static constexpr double kLongestS = 1e6;

  /// What a flight may take longer than it should.
  [[nodiscard]] static double slack_s(double flight_s) noexcept { return 10.0 + 0.1 * flight_s; }

  void learn_headway(const Situation& now) noexcept;

  // The way of one drone.
  void follow(const Situation& now, std::size_t drone, Snapshot& out) noexcept;
  void follow_flight(DroneMemory& memory, std::size_t drone) noexcept;
  void follow_landing(DroneMemory& memory, std::size_t drone) noexcept;
  void follow_charge(DroneMemory& memory, Visit& visit, Snapshot& out) noexcept;
  void follow_wait(DroneMemory& memory, Visit& visit, Snapshot& out) noexcept;
  void try_again_or_stay(DroneMemory& memory, std::size_t drone) noexcept;
  void begin_charge(DroneMemory& memory, Visit& visit) const noexcept;
  void give_back(std::size_t drone) noexcept;
  void take(std::size_t drone, std::size_t pad) noexcept;
  void see_beside(const DroneMemory& memory, Visit& visit) const noexcept;
  [[nodiscard]] bool can_fly_for(const DroneMemory& memory, const Visit& visit, double time_s) const noexcept;
  [[nodiscard]] double surely_left_s(const DroneMemory& memory) const noexcept;
  void note_station(std::int32_t pad, bool has_failed, Snapshot& out) noexcept;

  // All of them, once a second.
  void look_after_stations(const Situation& now) noexcept;
  void take_pads_that_are_stood_on(const Situation& now) noexcept;
  void move_on(const Situation& now, std::size_t drone) noexcept;
  void measure_ways(const Situation& now) noexcept;
  void plan(const Situation& now) noexcept;
  void foresee_returns(const Situation& now) noexcept;
  void gather_candidates(const Situation& now) noexcept;
  void plan_turns(const Situation& now, std::size_t most_away) noexcept;
  void plan_pads(const Situation& now) noexcept;
  [[nodiscard]] double too_soon_s() const noexcept;
  [[nodiscard]] double time_away_s(double flight_s) const noexcept;
  [[nodiscard]] double latest_leave_s(const Candidate& candidate, double flight_s) const noexcept;
  [[nodiscard]] std::size_t least_turns(const Situation& now) noexcept;
  void send_whose_time_it_is(const Situation& now, std::size_t most_away) noexcept;
  void make_room(const Situation& now, std::size_t wanted) noexcept;
  void hurry_whose_pad_is_awaited(const Situation& now) noexcept;
  void send(const Situation& now, std::size_t drone, std::int32_t pad) noexcept;

  [[nodiscard]] std::size_t usable_pads(const Situation& now) const noexcept;
  [[nodiscard]] std::size_t away(const Situation& now) const noexcept;
  [[nodiscard]] bool is_usable(std::size_t pad) const noexcept { return !has_failed_[pads_[pad].station]; }
  [[nodiscard]] std::int32_t nearest_free_pad(std::size_t drone) const noexcept;
  /// ... or, where pads are short, one that will be free when the drone arrives.
  [[nodiscard]] std::int32_t pad_for(const Situation& now, std::size_t drone) const noexcept;
  [[nodiscard]] double way_s(std::size_t drone, std::size_t pad) const noexcept;
  /// To the pad of so many in the order of their distance.
  [[nodiscard]] double way_to_one_of_s(std::size_t drone, std::size_t pads) noexcept;
  /// Until a drone that is away covers again.
  [[nodiscard]] double back_in_s(const DroneMemory& memory, std::size_t drone) const noexcept;
  [[nodiscard]] const ChargingPad& pad_at(std::int32_t pad) const noexcept {
    return pads_[static_cast<std::size_t>(pad)];
  }

  std::vector<ChargingPad> pads_;
  Vec2 middle_;  ///< of the field
  double take_off_s_;
  double landing_s_;
  double reserve_;
  double u_max_m_s_;
  double lag_s_;
  double spacing_m_;
  double dt_s_;
  std::uint64_t period_;  ///< ticks from one plan to the next
  Headway headway_;
  RechargePlanner planner_;
  std::vector<Visit> visits_;        ///< of each drone; empty without pads
  std::vector<bool> has_failed_;     ///< each station
  std::vector<std::int32_t> users_;  ///< of each pad: the drone that it is kept for; -1: none
  std::vector<std::int32_t> next_;   ///< ... and the one that comes when that one leaves
  std::vector<double> ways_s_;       ///< drones x pads; infinity: not measured yet
  std::size_t next_to_measure_ = 0;  ///< drone
  std::size_t planned_away_ = 1;
  bool are_pads_short_ = false;

  // Work space of a plan.
  std::vector<Candidate> candidates_;
  std::vector<RechargeNeed> needs_;
  std::vector<RechargeTurn> turns_;
  std::vector<double> free_at_s_;
  std::vector<double> sorted_s_;
};

}  // namespace vigil::swarm
