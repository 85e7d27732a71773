#include "vigil/runtime/area_watch.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

constexpr Eigen::Index kRegionCells = 192;  ///< along the longer side

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

ergodic::Coefficients region_of(const ergodic::Basis& basis, const field::Importance& map,
                                const field::Gaussian& gaussian) {
  constexpr double kSigmas = 2.0;
  const Eigen::Matrix2d inverse = gaussian.covariance.inverse();
  return region_of(basis, map, [&](const Vec2& p) {
    return (p - gaussian.mean).dot(inverse * (p - gaussian.mean)) <= kSigmas * kSigmas;
  });
}

double share_of(const ergodic::Coefficients& region, const ergodic::Coefficients& density) {
  if (density.size() != region.size()) return 0.0;
  return std::clamp((region.array() * density.array()).sum(), 0.0, 1.0);
}

}  // namespace

const AreaWatch::Watched* AreaWatch::known(const TargetName& what) const {
  const auto found = std::find_if(before_.begin(), before_.end(), [&](const Watched& one) { return one.what == what; });
  return found == before_.end() ? nullptr : &*found;
}

bool AreaWatch::has_shape(const Watched* one, const std::vector<Vec2>& shape) const {
  return one != nullptr && same_no_fly_ && one->shape == shape;
}

void AreaWatch::watch(TargetName what, std::vector<Vec2> places, std::optional<double> deadline_s, double time_s) {
  if (const Watched* const before = known(what)) {
    watched_.push_back({std::move(what), {}, before->log, deadline_s, before->is_overdue, {}});
    watched_.back().log.watch(std::move(places), time_s);
  } else {
    field::RevisitLog log(what.name, std::move(places), time_s);
    watched_.push_back({std::move(what), {}, std::move(log), deadline_s, false, {}});
  }
}

void AreaWatch::retarget(const Mission& mission, const ergodic::Basis& basis, const swarm::CoverageTarget& target,
                         double time_s) {
  const field::Importance map = importance(mission);
  before_ = std::exchange(watched_, {});
  same_no_fly_ = no_fly_ == mission.no_fly;
  no_fly_ = mission.no_fly;
  const auto keep_shape = [&](const std::vector<Vec2>& shape, const auto& make_region) {
    const Watched* const before = known(watched_.back().what);
    watched_.back().region = has_shape(before, shape) ? before->region : make_region();
    watched_.back().shape = shape;
    watched_.back().asked = share_of(watched_.back().region, target.phi_k);
    watched_.back().asked_protected = share_of(watched_.back().region, target.protected_k);
  };
  for (std::size_t n = 0; n < map.clusters.size(); ++n) {
    const ClusterEntry& entry = mission.targets.clusters[n];
    const field::Gaussian gaussian = field::fit(map.clusters[n], map.sigma_min_m);
    watch({TargetKind::kCluster, entry.name}, field::places_of(basis.field(), gaussian, map.no_fly), entry.revisit_s,
          time_s);
    keep_shape(entry.points_m, [&] { return region_of(basis, map, gaussian); });
  }
  for (std::size_t n = 0; n < map.areas.size(); ++n) {
    const AreaEntry& entry = mission.targets.areas[n];
    const field::Polygon& outline = map.areas[n].outline;
    watch({TargetKind::kArea, entry.name}, field::places_of(basis.field(), outline, map.no_fly), entry.revisit_s,
          time_s);
    keep_shape(entry.outline_m,
               [&] { return region_of(basis, map, [&](const Vec2& p) { return contains(outline, p); }); });
  }
  before_.clear();
}

std::vector<DeadlineChange> AreaWatch::see(std::span<const Vec2> positions, double footprint_m, double time_s) {
  std::vector<DeadlineChange> changes;
  for (Watched& one : watched_) {
    one.log.see(positions, footprint_m, time_s);
    const double age_s = one.log.age_s(time_s);
    const bool is_overdue = one.deadline_s && age_s > *one.deadline_s;
    if (is_overdue != one.is_overdue) changes.push_back({one.what, is_overdue, age_s, one.deadline_s.value_or(0.0)});
    one.is_overdue = is_overdue;
  }
  return changes;
}

std::vector<AreaState> AreaWatch::states(const ergodic::Coefficients& c_k, double time_s,
                                         const swarm::ProtectedShare& protection) const {
  std::vector<AreaState> states;
  states.reserve(watched_.size());
  for (const Watched& one : watched_)
    states.push_back({.what = one.what,
                      .age_s = one.log.age_s(time_s),
                      .worst_s = one.log.worst_s(time_s),
                      .deadline_s = one.deadline_s,
                      .is_overdue = one.is_overdue,
                      .asked = protection.factor() * one.asked_protected +
                               protection.rest_factor() * (one.asked - one.asked_protected),
                      .achieved = share_of(one.region, c_k)});
  return states;
}

}  // namespace vigil::runtime
