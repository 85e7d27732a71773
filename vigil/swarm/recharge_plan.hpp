#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vigil::swarm {

/// What a drone needs of the places where batteries are charged. Seconds from now.
struct RechargeNeed {
  double latest_leave_s = 0.0;  ///< so late it may leave for its place; negative: it is late
  double way_s = 0.0;           ///< >= 0, from leaving to standing there
  double charge_s = 0.0;        ///< >= 0, from then until the place is free again
};

/// When a drone is to go where.
struct RechargeTurn {
  double leave_s = 0.0;     ///< <= latest_leave_s; 0 or less: it goes now
  std::size_t place = 0;    ///< of the places
  double too_soon_s = 0.0;  ///< so long before the place is free it would be there; 0: it finds it free
};

/// Who charges when: so that no two need one place at the same time, nobody waits for one in the air, and everybody
/// leaves as late as that allows. Backwards from the end: of the drones that are not planned yet, the one that would be
/// the last to begin takes the place where it can begin latest, before all that were planned there already. Where all
/// charge for the same time, no plan lets the first one to leave begin later. A plan holds until something changes;
/// making it again costs drones x places steps. Allocates when it is constructed, and never again, but
/// for a copy in its first plan().
class RechargePlanner {
 public:
  RechargePlanner(std::size_t most_drones, std::size_t most_places);

  /// turns[i] for needs[i]. `free_at_s`: when each place is free of who is there or on its way, from now; infinity
  /// where it has failed. Preconditions: finite needs, as many as turns, at most most_drones; 1 to most_places places.
  void plan(std::span<const RechargeNeed> needs, std::span<const double> free_at_s,
            std::span<RechargeTurn> turns) noexcept;

 private:
  [[nodiscard]] std::size_t latest_place(const RechargeNeed& need, std::span<const double> free_at_s) const noexcept;
  [[nodiscard]] double begin_at(const RechargeNeed& need, std::size_t place) const noexcept;

  std::vector<std::size_t> order_;
  std::vector<double> taken_from_s_;  ///< of each place: when the first of those planned there begins
};

}  // namespace vigil::swarm
