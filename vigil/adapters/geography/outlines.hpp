#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vigil/core/field/vec2.hpp"
#include "vigil/runtime/mission.hpp"

/// What both formats of maps ask for.
namespace vigil::geography {

/// Counter-clockwise, the first corner again at the end. Precondition: at least three corners.
[[nodiscard]] std::vector<Vec2> closed_ring(std::span<const Vec2> outline);

/// The field's corners in the world frame.
[[nodiscard]] std::vector<Vec2> field_outline(const runtime::Mission& mission);

/// ISO 8601 in UTC with milliseconds: `began_ns` since 1970, and `time_s` later.
[[nodiscard]] std::string time_of_day(std::int64_t began_ns, double time_s);

}  // namespace vigil::geography
