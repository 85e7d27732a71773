#include "vigil/runtime/free_places.hpp"

#include <algorithm>
#include <cmath>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {

FreePlaces::FreePlaces(const Mission& mission, double wall_m, double no_fly_m)
    : field_(monitored_field(mission)), wall_m_(wall_m), no_fly_m_(no_fly_m) {
  for (const NoFlyEntry& entry : mission.no_fly) no_fly_.push_back(polygon_in_field(mission, entry.outline_m));
}

Vec2 FreePlaces::dart(dynamics::RandomStream& random) const {
  const double x = wall_m_ + (field_.length_x - 2.0 * wall_m_) * random.uniform();
  return {x, wall_m_ + (field_.length_y - 2.0 * wall_m_) * random.uniform()};
}

bool FreePlaces::is_free(const Vec2& place) const {
  const double wall = std::min({place.x(), place.y(), field_.length_x - place.x(), field_.length_y - place.y()});
  return wall >= wall_m_ && std::ranges::all_of(no_fly_, [&](const field::Polygon& polygon) {
           return field::signed_distance(polygon, place) >= no_fly_m_;
         });
}

}  // namespace vigil::runtime
