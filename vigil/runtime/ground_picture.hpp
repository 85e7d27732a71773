#pragma once

#include <optional>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/seen_map.hpp"
#include "vigil/runtime/area_watch.hpp"
#include "vigil/runtime/live_frame.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// What has been seen of the field, place by place and area by area, by what a live flight's frames tell of its active
/// drones and of the ways between. One thread, not the control thread.
class GroundPicture {
 public:
  /// Precondition: a mission that mission checks accepted.
  explicit GroundPicture(const Mission& mission);

  /// From time_s on other targets are meant. `target`: what they come to.
  void retarget(const Mission& mission, const swarm::CoverageTarget& target, double time_s);
  /// Takes in a tick that is newer than the last one. Deadlines that changed are in the result.
  [[nodiscard]] std::vector<DeadlineChange> look(const swarm::Snapshot& snapshot);

  [[nodiscard]] std::vector<AreaState> areas(const LiveFrame& frame) const;
  [[nodiscard]] const AreaWatch& watch() const { return watch_; }
  [[nodiscard]] const field::SeenMap& seen() const { return seen_; }
  [[nodiscard]] field::SeenMap& seen() { return seen_; }
  [[nodiscard]] const ergodic::Basis& basis() const { return basis_; }

 private:
  void note_way(std::size_t drone, const Vec2& from, const Vec2& to, double time_s);

  ergodic::Basis basis_;
  double footprint_m_;
  field::SeenMap seen_;
  AreaWatch watch_;
  std::vector<std::optional<Vec2>> last_places_;  ///< of the drones that were active in the last frame
  std::vector<Vec2> ways_;                        ///< work space: everywhere that an active drone has been
};

}  // namespace vigil::runtime
