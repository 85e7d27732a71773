#pragma once

#include <vector>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// Where something may be put: inside the field and outside no-fly polygons, so far from their borders. Field frame.
class FreePlaces {
 public:
  FreePlaces(const Mission& mission, double wall_m, double no_fly_m);

  /// Uniform between the walls; may still not be free.
  [[nodiscard]] Vec2 dart(dynamics::RandomStream& random) const;
  [[nodiscard]] bool is_free(const Vec2& place) const;

 private:
  field::Field field_;
  double wall_m_;
  double no_fly_m_;
  std::vector<field::Polygon> no_fly_;
};

}  // namespace vigil::runtime
