#include "vigil/core/field/importance.hpp"

#include <algorithm>
#include <cassert>

namespace vigil::field {

bool Importance::has_targets() const {
  const auto counts = [](const Cluster& cluster) { return cluster.weight > 0.0 && !cluster.targets.empty(); };
  const auto weighs = [](const Area& area) { return area.weight > 0.0; };
  return uniform_floor > 0.0 || std::any_of(clusters.begin(), clusters.end(), counts) ||
         std::any_of(areas.begin(), areas.end(), weighs);
}

Gaussian fit(const Cluster& cluster, double sigma_min_m) {
  assert(!cluster.targets.empty());
  const auto n = static_cast<double>(cluster.targets.size());

  Vec2 mean = Vec2::Zero();
  for (const Vec2& q : cluster.targets) mean += q / n;

  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Vec2& q : cluster.targets) scatter += (q - mean) * (q - mean).transpose();

  const double degrees_of_freedom = std::max(n - 1.0, 1.0);  // the scatter of one point is 0 whatever it is divided by
  return {mean, scatter / degrees_of_freedom + sigma_min_m * sigma_min_m * Eigen::Matrix2d::Identity()};
}

}  // namespace vigil::field
