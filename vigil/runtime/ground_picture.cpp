#include "vigil/runtime/ground_picture.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

constexpr Eigen::Index kSeenCells = 96;     ///< along the longer side
constexpr Eigen::Index kRegionCells = 192;  ///< the same

bool is_forbidden(const field::Importance& map, const Vec2& p) {
  return std::any_of(map.no_fly.begin(), map.no_fly.end(), [&](const auto& polygon) { return contains(polygon, p); });
}

/// The integral of f_k over the allowed part of the field that `is_inside` accepts.
template <typename IsInside>
ergodic::Coefficients region_of(const ergodic::Basis& basis, const field::Importance& map, const IsInside& is_inside) {
  const field::GridShape shape = grid_of(basis.field(), kRegionCells);
  field::DensityGrid region{basis.field(), Eigen::ArrayXXd::Zero(shape.nx, shape.ny),
                            field::midpoint_weights(shape.nx, basis.field().length_x, field::EndRule::kKinked),
                            field::midpoint_weights(shape.ny, basis.field().length_y, field::EndRule::kKinked)};
  for (Eigen::Index iy = 0; iy < shape.ny; ++iy)
    for (Eigen::Index ix = 0; ix < shape.nx; ++ix) {
      const Vec2 p = region.midpoint(ix, iy);
      if (is_inside(p) && !is_forbidden(map, p)) region.values(ix, iy) = 1.0;
    }
  return ergodic::target_coefficients(basis, region);
}

double share_of(const ergodic::Coefficients& region, const ergodic::Coefficients& density) {
  return std::clamp((region.array() * density.array()).sum(), 0.0, 1.0);
}

}  // namespace

GroundPicture::GroundPicture(const Mission& mission)
    : basis_(monitored_field(mission), mission.control.basis_max_index, mission.control.basis_smoothness),
      footprint_m_(footprint_radius_m(mission)),
      seen_(monitored_field(mission), grid_of(monitored_field(mission), kSeenCells)),
      last_places_(mission.drones.size()) {}

void GroundPicture::watch(TargetName what, std::vector<Vec2> places, std::optional<double> deadline_s, double time_s,
                          std::vector<Watched>& watched) {
  const auto known =
      std::find_if(watched_.begin(), watched_.end(), [&](const Watched& one) { return one.what == what; });
  if (known != watched_.end()) {
    known->log.watch(std::move(places), time_s);
    watched.push_back({std::move(what), known->log, deadline_s, known->is_overdue, {}, 0.0});
  } else {
    watched.push_back({what, field::RevisitLog(what.name, std::move(places), time_s), deadline_s, false, {}, 0.0});
  }
}

void GroundPicture::retarget(const Mission& mission, const ergodic::Coefficients& phi_k, double time_s) {
  constexpr double kSigmas = 2.0;
  const field::Importance map = importance(mission);
  std::vector<Watched> watched;
  for (std::size_t n = 0; n < map.clusters.size(); ++n) {
    const field::Gaussian gaussian = field::fit(map.clusters[n], map.sigma_min_m);
    watch({TargetKind::kCluster, map.clusters[n].name}, field::places_of(basis_.field(), gaussian, map.no_fly),
          mission.targets.clusters[n].revisit_s, time_s, watched);
    const Eigen::Matrix2d inverse = gaussian.covariance.inverse();
    watched.back().region = region_of(basis_, map, [&](const Vec2& p) {
      return (p - gaussian.mean).dot(inverse * (p - gaussian.mean)) <= kSigmas * kSigmas;
    });
  }
  for (std::size_t n = 0; n < map.areas.size(); ++n) {
    const field::Polygon& outline = map.areas[n].outline;
    watch({TargetKind::kArea, map.areas[n].name}, field::places_of(basis_.field(), outline, map.no_fly),
          mission.targets.areas[n].revisit_s, time_s, watched);
    watched.back().region = region_of(basis_, map, [&](const Vec2& p) { return contains(outline, p); });
  }
  for (Watched& one : watched) one.asked = phi_k.size() == one.region.size() ? share_of(one.region, phi_k) : 0.0;
  watched_ = std::move(watched);
}

void GroundPicture::note_way(std::size_t drone, const Vec2& from, const Vec2& to, double time_s) {
  const std::size_t steps = field::steps_along(from, to, footprint_m_);
  for (std::size_t n = 1; n <= steps; ++n)
    ways_.push_back(from + static_cast<double>(n) / static_cast<double>(steps) * (to - from));
  seen_.see_along(from, to, footprint_m_, time_s);
  last_places_[drone] = to;
}

std::vector<DeadlineChange> GroundPicture::look(const LiveFrame& frame) {
  const double time_s = frame.snapshot.time_s;
  ways_.clear();
  for (std::size_t i = 0; i < frame.snapshot.drones.size(); ++i) {
    const swarm::DroneSnapshot& drone = frame.snapshot.drones[i];
    if (drone.activity == swarm::Activity::kActive)
      note_way(i, last_places_[i].value_or(drone.position), drone.position, time_s);
    else
      last_places_[i].reset();
  }
  std::vector<DeadlineChange> changes;
  for (Watched& one : watched_) {
    one.log.see(ways_, footprint_m_, time_s);
    const double age_s = one.log.age_s(time_s);
    const bool is_overdue = one.deadline_s && age_s > *one.deadline_s;
    if (is_overdue != one.is_overdue) changes.push_back({one.what, is_overdue, age_s, one.deadline_s.value_or(0.0)});
    one.is_overdue = is_overdue;
  }
  return changes;
}

std::vector<AreaState> GroundPicture::areas(const LiveFrame& frame) const {
  const double time_s = frame.snapshot.time_s;
  std::vector<AreaState> states;
  for (const Watched& one : watched_) {
    const bool has_coverage = frame.c_k.size() == one.region.size() && frame.past.coverage.has_samples;
    states.push_back({.what = one.what,
                      .age_s = one.log.age_s(time_s),
                      .worst_s = one.log.worst_s(time_s),
                      .deadline_s = one.deadline_s,
                      .is_overdue = one.is_overdue,
                      .asked = one.asked,
                      .achieved = has_coverage ? share_of(one.region, frame.c_k) : 0.0});
  }
  return states;
}

}  // namespace vigil::runtime
