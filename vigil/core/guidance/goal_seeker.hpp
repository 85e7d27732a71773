#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vigil/core/field/vec2.hpp"

namespace vigil::guidance {

/// The scales of a crowd. All times and distances of the remedies below are multiples of them.
struct SeekerParameters {
  double u_max_m_s = 0.0;  ///< > 0
  double spacing_m = 0.0;  ///< > 0: how close two drones at rest may come, the barrier's radius
  double lag_s = 0.0;      ///< >= 0, of v' = (u - v)/lag
  double dt_s = 0.0;       ///< > 0, the tick
};

/// A drone that has a place to go to, or that waits there. Field frame.
struct Traveller {
  std::size_t drone = 0;  ///< its index in the swarm
  Vec2 position = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();
  Vec2 goal = Vec2::Zero();
  Vec2 flown = Vec2::Zero();  ///< the velocity that it was last allowed to fly
  bool passes = false;        ///< its goal is a corner on its way: it neither slows down for it nor arrives there
};

/// Flies drones to places through other drones, without ever touching what keeps them apart: it only wishes, and the
/// safety filter decides. A filter that cannot be argued with makes drones freeze where their wishes oppose each other;
/// the remedies turn the wish:
///
///     on its way --allowed less than a third of its wish, for 0.8 T--> turning: wishes 75 degrees to the right of its
///     goal, for 0.6 to 3 T, then on its way again; 15 degrees more for every turn in vain, up to 150
///     (everybody to the right: who meets head-on passes)
///     no nearer to its goal for 4 T: it asks for room; whoever waits at a goal within 1.6 spacings of it, and not
///     behind it, steps aside for 1.6 T, then flies back
///
/// with T = spacing / u_max. The lengths of turns follow a fixed sequence of their own for every drone, so that no two
/// keep doing the same. A value: a copy goes on like its original. steer() allocates nothing. One thread at a time.
class GoalSeeker {
 public:
  GoalSeeker(const SeekerParameters& parameters, std::size_t drones);

  /// u[i] for travellers[i], |u| <= u_max. Call once a tick. A drone with another goal than in the last call begins a
  /// new journey. Precondition: finite travellers, each drone at most once, as many as u.
  void steer(std::span<const Traveller> travellers, std::span<Vec2> u) noexcept;

  /// From now on a tick lasts so long. Precondition: > 0.
  void set_tick(double dt_s) noexcept { parameters_.dt_s = dt_s; }

  /// Closer to its goal than this a drone waits: it has arrived.
  [[nodiscard]] double arrival_distance_m() const noexcept { return 0.5 * parameters_.spacing_m; }

 private:
  struct Journey {
    Vec2 goal = Vec2::Zero();
    bool has_begun = false;
    double nearest_m = 0.0;   ///< to the goal so far
    double waiting_s = 0.0;   ///< since it came nearer
    double blocked_s = 0.0;   ///< allowed too little for so long
    double turning_s = 0.0;   ///< still to turn for so long
    double turn_rad = 0.0;    ///< by how much, or did last; 0 since it came nearer
    double yielding_s = 0.0;  ///< still to make room for so long
    Vec2 aside = Vec2::Zero();
    Vec2 wish = Vec2::Zero();  ///< of the last call; zero where being held means nothing
    unsigned turns = 0;
  };

  void keep_track(const Traveller& traveller) noexcept;
  void ask_for_room(const Traveller& asking, std::span<const Traveller> travellers) noexcept;
  [[nodiscard]] Vec2 wish_of(const Traveller& traveller) noexcept;
  void notice_being_blocked(const Traveller& traveller, Journey& journey) noexcept;
  [[nodiscard]] bool has_arrived(const Traveller& traveller) const noexcept;
  /// T, seconds.
  [[nodiscard]] double unit_s() const noexcept { return parameters_.spacing_m / parameters_.u_max_m_s; }

  SeekerParameters parameters_;
  double approach_per_s_;
  std::vector<Journey> journeys_;
};

}  // namespace vigil::guidance
