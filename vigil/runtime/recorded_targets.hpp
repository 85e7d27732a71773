#pragma once

#include <cstddef>
#include <span>

#include "vigil/runtime/mission_targets.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::runtime {

/// How many of the lists, which are in the order of time, hold from time_s or before.
[[nodiscard]] std::size_t targets_until(std::span<const RecordedTargets> all, double time_s);

/// Those of a moment; what no operator changes in flight (sigma_min, what lies outside the field) is as `targets` has
/// it.
[[nodiscard]] MissionTargets with(MissionTargets targets, const RecordedTargets& now);

/// The mission with the targets and no-fly polygons of a moment.
[[nodiscard]] Mission mission_at(Mission mission, std::span<const RecordedTargets> all, double time_s);

}  // namespace vigil::runtime
