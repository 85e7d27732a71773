#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vigil/core/safety/body.hpp"

namespace vigil::safety {

/// Bodies side by side, number by number, rounded: for a first look at many of them in turn. A few more entries than
/// bodies may be read at the end; like those of bodies that nobody avoids they are nowhere.
class BodyColumns {
 public:
  static constexpr std::size_t kSlack = 16;

  /// How many bodies it has room for.
  explicit BodyColumns(std::size_t capacity)
      : stride_(stride_of(capacity + kSlack)), numbers_(kColumns * stride_, kNowhere) {}

  void set(std::size_t at, const Body& body, const Vec2& point, bool is_avoided, double u_max_m_s) noexcept {
    const double age_s = body.age_s > 0.0 ? body.age_s : 0.0;
    float* const to = numbers_.data() + at;
    to[0 * stride_] = is_avoided ? static_cast<float>(point.x()) : kNowhere;
    to[1 * stride_] = is_avoided ? static_cast<float>(point.y()) : kNowhere;
    to[2 * stride_] = static_cast<float>(body.position.x());
    to[3 * stride_] = static_cast<float>(body.position.y());
    to[4 * stride_] = static_cast<float>(body.velocity.x());
    to[5 * stride_] = static_cast<float>(body.velocity.y());
    to[6 * stride_] =
        body.is_controlled ? static_cast<float>(u_max_m_s * age_s) : std::numeric_limits<float>::infinity();
  }

  // barrier_point(); NaN: nobody avoids it.
  [[nodiscard]] const float* point_x() const noexcept { return column(0); }
  [[nodiscard]] const float* point_y() const noexcept { return column(1); }
  [[nodiscard]] const float* position_x() const noexcept { return column(2); }
  [[nodiscard]] const float* position_y() const noexcept { return column(3); }
  [[nodiscard]] const float* velocity_x() const noexcept { return column(4); }
  [[nodiscard]] const float* velocity_y() const noexcept { return column(5); }
  /// How far it may have come since it was seen; infinite where nobody controls it.
  [[nodiscard]] const float* drift_m() const noexcept { return column(6); }

 private:
  static constexpr std::size_t kColumns = 7;
  static constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

  /// Columns a whole number of pages apart would all fight for the same lines of the cache: they are nine lines off.
  static std::size_t stride_of(std::size_t entries) {
    constexpr std::size_t kPage = 1024;  // in numbers
    constexpr std::size_t kOff = 144;
    return (entries + kPage - 1) / kPage * kPage + kOff;
  }
  [[nodiscard]] const float* column(std::size_t which) const noexcept { return numbers_.data() + which * stride_; }

  std::size_t stride_;
  std::vector<float> numbers_;
};

}  // namespace vigil::safety
