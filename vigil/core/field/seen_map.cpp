#include "vigil/core/field/seen_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vigil::field {
namespace {

/// The cells of one axis whose middles lie within [low, high]: first, one past the last.
struct CellRange {
  Eigen::Index first;
  Eigen::Index end;
};

CellRange cells_within(double low, double high, double cell, Eigen::Index count) {
  const auto clamped = [count](double index) {
    return static_cast<Eigen::Index>(std::clamp(index, 0.0, static_cast<double>(count)));
  };
  return {clamped(std::ceil(low / cell - 0.5)), clamped(std::floor(high / cell - 0.5) + 1.0)};
}

}  // namespace

SeenMap::SeenMap(const Field& field, GridShape shape)
    : field_(field),
      shape_(shape),
      cell_(field.length_x / static_cast<double>(shape.nx), field.length_y / static_cast<double>(shape.ny)),
      seen_s_(static_cast<std::size_t>(shape.nx * shape.ny), kNever) {
  assert(shape.nx > 0 && shape.ny > 0);
}

void SeenMap::see(const Vec2& position, double radius_m, double now_s) noexcept {
  const CellRange rows = cells_within(position.y() - radius_m, position.y() + radius_m, cell_.y(), shape_.ny);
  for (Eigen::Index iy = rows.first; iy < rows.end; ++iy) {
    const double dy = (static_cast<double>(iy) + 0.5) * cell_.y() - position.y();
    const double half = std::sqrt(std::max(0.0, radius_m * radius_m - dy * dy));
    const CellRange cells = cells_within(position.x() - half, position.x() + half, cell_.x(), shape_.nx);
    const auto row = seen_s_.begin() + iy * shape_.nx;
    if (cells.first < cells.end) std::fill(row + cells.first, row + cells.end, now_s);
  }
}

void SeenMap::see_along(const Vec2& a, const Vec2& b, double radius_m, double now_s) noexcept {
  const std::size_t steps = steps_along(a, b, radius_m);
  for (std::size_t n = 1; n <= steps; ++n)
    see(a + static_cast<double>(n) / static_cast<double>(steps) * (b - a), radius_m, now_s);
}

bool SeenMap::restore(std::span<const double> seen_s) {
  const bool has_nan = std::any_of(seen_s.begin(), seen_s.end(), [](double t) { return std::isnan(t); });
  if (seen_s.size() != seen_s_.size() || has_nan) return false;
  std::copy(seen_s.begin(), seen_s.end(), seen_s_.begin());
  return true;
}

// Two circles whose centres are s apart meet at sqrt(r^2 - s^2/4) from the line between them: 0.968 r for s = r/2.
std::size_t steps_along(const Vec2& a, const Vec2& b, double radius_m) noexcept {
  constexpr double kMost = 64.0;
  const double steps = std::ceil((b - a).norm() / (0.5 * radius_m));
  return static_cast<std::size_t>(std::clamp(steps, 1.0, kMost));
}

void add_way(const Vec2& a, const Vec2& b, double radius_m, std::vector<Vec2>& places) {
  const std::size_t steps = steps_along(a, b, radius_m);
  for (std::size_t n = 1; n <= steps; ++n)
    places.push_back(a + static_cast<double>(n) / static_cast<double>(steps) * (b - a));
}

}  // namespace vigil::field
