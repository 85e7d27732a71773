#pragma once

#include <span>
#include <string>
#include <vector>

#include "vigil/core/field/importance.hpp"

namespace vigil::field {

/// Sample places, at most about 64, spread evenly over the part of a cluster that matters: its ellipse of two standard
/// deviations, inside the field and outside the no-fly polygons. At least one place (the mean, clamped) in any case.
[[nodiscard]] std::vector<Vec2> places_of(const Field& field, const Gaussian& gaussian,
                                          std::span<const Polygon> no_fly);
/// The same for a drawn area.
[[nodiscard]] std::vector<Vec2> places_of(const Field& field, const Polygon& outline, std::span<const Polygon> no_fly);

/// How long parts of one area have gone unseen. Time counts from the area's creation.
class RevisitLog {
 public:
  RevisitLog(std::string name, std::vector<Vec2> places, double created_s);

  /// Drones at `positions` see every place within `radius_m` at time now_s (never before the last call's). No
  /// allocation.
  void see(std::span<const Vec2> positions, double radius_m, double now_s) noexcept;

  /// From now_s on other places are meant: unless they are the same, their time begins anew; what was worst until now
  /// stays. Without places the area is not watched any more.
  void watch(std::vector<Vec2> places, double now_s);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// The longest that any place has gone unseen, up to now_s and counting the time since it was seen last.
  [[nodiscard]] double worst_s(double now_s) const noexcept;
  /// The oldest place's time since it was seen.
  [[nodiscard]] double age_s(double now_s) const noexcept;

 private:
  std::string name_;
  std::vector<Vec2> places_;
  std::vector<double> seen_s_;  ///< when each place was seen last
  double worst_gap_s_ = 0.0;    ///< between two sightings
};

}  // namespace vigil::field
