#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"

namespace vigil::field {

/// A bivariate normal distribution: the paper's (1).
struct Gaussian {
  Vec2 mean = Vec2::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
};

/// A named list of target points (never empty) that an operator pointed at. Metres, field frame.
struct Cluster {
  std::string name;
  std::vector<Vec2> targets;
  double weight = 1.0;        ///< multiplies the number of targets in (2); zero or more
  bool is_protected = false;  ///< see rasterise_protected()
};

/// A drawn area: density 1 inside, falling to 0 over `soft_edge_m` outside its outline (a half Gaussian of that sigma).
/// Its mass in the mixture counts like `weight` target points, spread evenly.
struct Area {
  std::string name;
  Polygon outline;
  double weight = 5.0;
  double soft_edge_m = 0.0;
  bool is_protected = false;  ///< see rasterise_protected()
};

/// All that says where the swarm should look.
struct Importance {
  std::vector<Cluster> clusters;
  std::vector<Area> areas;
  std::vector<Polygon> no_fly;
  /// The share of all attention, in [0, 1], that is spread evenly over the allowed field.
  double uniform_floor = 0.0;
  /// Regularises a cluster's covariance: sigma_min^2 I is added, so that one point is a proper Gaussian. Metres, > 0.
  double sigma_min_m = 0.0;

  /// True where there is something to look at: a positive mass of clusters or areas, or a uniform floor.
  [[nodiscard]] bool has_targets() const;
};

/// Mean and sample covariance (n - 1) of the cluster's targets plus sigma_min^2 I (control.md 1).
/// Precondition: at least one target.
[[nodiscard]] Gaussian fit(const Cluster& cluster, double sigma_min_m);

}  // namespace vigil::field
