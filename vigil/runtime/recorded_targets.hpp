#pragma once

#include <cstddef>
#include <span>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::runtime {

/// How many of the lists, which are in the order of time, hold from time_s or before.
[[nodiscard]] std::size_t targets_until(std::span<const RecordedTargets> all, double time_s);

/// The mission with the targets of a moment; what a recording does not say of them is as `mission` has it.
[[nodiscard]] Mission mission_at(const Mission& mission, std::span<const RecordedTargets> all, double time_s);

}  // namespace vigil::runtime
