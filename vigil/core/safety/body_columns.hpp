#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vigil/core/safety/body.hpp"

namespace vigil::safety {

/// Bodies side by side, number by number, rounded: for a first look at many of them in turn. A few more entries than
/// bodies may be read at the end; like those of bodies that nobody avoids they are nowhere.
struct BodyColumns {
  static constexpr std::size_t kSlack = 16;

  std::vector<float> point_x, point_y;  ///< barrier_point(); NaN: nobody avoids it
  std::vector<float> position_x, position_y;
  std::vector<float> velocity_x, velocity_y;
  std::vector<float> drift_m;  ///< how far it may have come since it was seen; infinite where nobody controls it

  explicit BodyColumns(std::size_t capacity)
      : point_x(capacity + kSlack, kNowhere),
        point_y(capacity + kSlack, kNowhere),
        position_x(capacity + kSlack),
        position_y(capacity + kSlack),
        velocity_x(capacity + kSlack),
        velocity_y(capacity + kSlack),
        drift_m(capacity + kSlack) {}

  void set(std::size_t at, const Body& body, const Vec2& point, bool is_avoided, double u_max_m_s) noexcept {
    point_x[at] = is_avoided ? static_cast<float>(point.x()) : kNowhere;
    point_y[at] = is_avoided ? static_cast<float>(point.y()) : kNowhere;
    position_x[at] = static_cast<float>(body.position.x());
    position_y[at] = static_cast<float>(body.position.y());
    velocity_x[at] = static_cast<float>(body.velocity.x());
    velocity_y[at] = static_cast<float>(body.velocity.y());
    const double age_s = body.age_s > 0.0 ? body.age_s : 0.0;
    drift_m[at] = body.is_controlled ? static_cast<float>(u_max_m_s * age_s) : std::numeric_limits<float>::infinity();
  }

 private:
  static constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
};

}  // namespace vigil::safety
