#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vigil/core/field/vec2.hpp"

namespace vigil::report {

/// A curve of few points that looks like the whole: x, y pairs; a NaN breaks the line.
using Curve = std::vector<Vec2>;

/// Keeps the first, the least, the greatest and the last value of each of at most `pieces` stretches, so that no peak
/// is lost. Precondition: as many times as values, pieces >= 1.
[[nodiscard]] Curve envelope(std::span<const double> times, std::span<const double> values, std::size_t pieces);

/// A path in the plane with at most `points` points: those that lie far enough from the one kept before, and the last.
/// Places that are not finite break it.
[[nodiscard]] Curve thinned(const Curve& path, std::size_t points);

}  // namespace vigil::report
