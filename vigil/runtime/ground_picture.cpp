#include "vigil/runtime/ground_picture.hpp"

#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

constexpr Eigen::Index kSeenCells = 96;  ///< along the longer side

}  // namespace

GroundPicture::GroundPicture(const Mission& mission)
    : basis_(monitored_field(mission), mission.control.basis_max_index, mission.control.basis_smoothness),
      footprint_m_(footprint_radius_m(mission)),
      seen_(monitored_field(mission), grid_of(monitored_field(mission), kSeenCells)),
      last_places_(mission.drones.size()) {}

void GroundPicture::retarget(const Mission& mission, const swarm::CoverageTarget& target, double time_s) {
  watch_.retarget(mission, basis_, target, time_s);
}

void GroundPicture::note_way(std::size_t drone, const Vec2& from, const Vec2& to, double time_s) {
  field::add_way(from, to, footprint_m_, ways_);
  seen_.see_along(from, to, footprint_m_, time_s);
  last_places_[drone] = to;
}

std::vector<DeadlineChange> GroundPicture::look(const swarm::Snapshot& snapshot) {
  const double time_s = snapshot.time_s;
  ways_.clear();
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i) {
    const swarm::DroneSnapshot& drone = snapshot.drones[i];
    if (drone.activity == swarm::Activity::kActive)
      note_way(i, last_places_[i].value_or(drone.position), drone.position, time_s);
    else
      last_places_[i].reset();
  }
  return watch_.see(ways_, footprint_m_, time_s);
}

std::vector<AreaState> GroundPicture::areas(const LiveFrame& frame) const {
  const bool has_coverage = frame.past.coverage.has_samples;
  return watch_.states(has_coverage ? frame.c_k : ergodic::Coefficients(), frame.snapshot.time_s,
                       frame.snapshot.protection);
}

}  // namespace vigil::runtime
