#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/revisit.hpp"
#include "vigil/core/field/seen_map.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/target_edit.hpp"

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
};

/// A deadline that was missed, or kept again.
struct DeadlineChange {
  TargetName what;
  bool is_overdue = false;
  double age_s = 0.0;
  double deadline_s = 0.0;
};

/// What has been seen of the field, place by place and area by area, by what a live flight's frames tell of its active
/// drones and of the ways between. One thread, not the control thread.
class GroundPicture {
 public:
  /// Precondition: a mission that mission checks accepted.
  explicit GroundPicture(const Mission& mission);

  /// From time_s on other targets are meant. phi_k: their coefficients.
  void retarget(const Mission& mission, const ergodic::Coefficients& phi_k, double time_s);
  /// Takes in a frame that is newer than the last one. Deadlines that changed are in the result.
  [[nodiscard]] std::vector<DeadlineChange> look(const LiveFrame& frame);

  [[nodiscard]] std::vector<AreaState> areas(const LiveFrame& frame) const;
  [[nodiscard]] const field::SeenMap& seen() const { return seen_; }
  [[nodiscard]] field::SeenMap& seen() { return seen_; }
  [[nodiscard]] const ergodic::Basis& basis() const { return basis_; }

 private:
  struct Watched {
    TargetName what;
    field::RevisitLog log;
    std::optional<double> deadline_s;
    bool is_overdue = false;
    ergodic::Coefficients region;  ///< the integral of f_k over it: a share of a density is a scalar product
    double asked = 0.0;
  };

  void watch(TargetName what, std::vector<Vec2> places, std::optional<double> deadline_s, double time_s,
             std::vector<Watched>& watched);
  void note_way(std::size_t drone, const Vec2& from, const Vec2& to, double time_s);

  ergodic::Basis basis_;
  double footprint_m_;
  field::SeenMap seen_;
  std::vector<Watched> watched_;
  std::vector<std::optional<Vec2>> last_places_;  ///< of the drones that were active in the last frame
  std::vector<Vec2> ways_;                        ///< work space: everywhere that an active drone has been
};

}  // namespace vigil::runtime
