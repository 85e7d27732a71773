#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/revisit.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/target_edit.hpp"
#include "vigil/swarm/command.hpp"
#include "vigil/swarm/protection.hpp"

namespace vigil::runtime {

/// How one cluster or area fares.
struct AreaState {
  TargetName what;
  double age_s = 0.0;    ///< since the part that has waited longest was seen
  double worst_s = 0.0;  ///< the longest that any part ever waited
  std::optional<double> deadline_s;
  bool is_overdue = false;
  double asked = 0.0;     ///< the share of the density that falls on it
  double achieved = 0.0;  ///< the share of the drones' time that falls on it
  /// The longest that a part of it will be unseen, as was looked ahead last; none: nobody did.
  std::optional<double> foreseen_s = std::nullopt;
};

/// A deadline that was missed, or kept again.
struct DeadlineChange {
  TargetName what;
  bool is_overdue = false;
  double age_s = 0.0;
  double deadline_s = 0.0;
};

/// Watches every cluster and area of a mission: when each part of it was seen last, and what share of the drones' time
/// it gets. A value: a copy watches on by itself. One thread at a time.
class AreaWatch {
 public:
  /// From time_s on these targets are meant; `target` is what they come to. What an area that was watched before has
  /// seen stays where its shape is the same. Some milliseconds for each new shape.
  void retarget(const Mission& mission, const ergodic::Basis& basis, const swarm::CoverageTarget& target,
                double time_s);
  /// Active drones, at `positions` or on their ways past them, see what is within footprint_m. Deadlines that changed
  /// are in the result.
  [[nodiscard]] std::vector<DeadlineChange> see(std::span<const Vec2> positions, double footprint_m, double time_s);
  /// c_k: the achieved coverage; one of another shape says that there is none yet. protection: of the moment.
  [[nodiscard]] std::vector<AreaState> states(const ergodic::Coefficients& c_k, double time_s,
                                              const swarm::ProtectedShare& protection = {}) const;

 private:
  struct Watched {
    TargetName what;
    std::vector<Vec2> shape;  ///< target points or outline, world frame
    field::RevisitLog log;
    std::optional<double> deadline_s;
    bool is_overdue = false;
    ergodic::Coefficients region;  ///< the integral of f_k over it: a share of a density is a scalar product
    double asked = 0.0;
    double asked_protected = 0.0;  ///< the part of it that is protected
  };

  [[nodiscard]] const Watched* known(const TargetName& what) const;
  [[nodiscard]] bool has_shape(const Watched* one, const std::vector<Vec2>& shape) const;
  void watch(TargetName what, std::vector<Vec2> places, std::optional<double> deadline_s, double time_s);

  std::vector<Watched> watched_;
  std::vector<Watched> before_;  ///< during retarget(): what was watched until then
  std::vector<NoFlyEntry> no_fly_;
  bool same_no_fly_ = false;  ///< during retarget()
};

}  // namespace vigil::runtime
