#pragma once

#include <cstddef>

namespace vigil::runtime {

/// How quick a crowd is: goals that its drones reached, per drone and minute. A goal counts when its drone is first
/// within the goal's radius; the drone then has a new one. A flight that gives its drones goals says this figure in its
/// summary as `goals_per_drone_minute`, where campaigns look for it. Precondition: drones > 0, duration_s > 0.
[[nodiscard]] constexpr double goals_per_drone_minute(std::size_t goals, std::size_t drones,
                                                      double duration_s) noexcept {
  return static_cast<double>(goals) / static_cast<double>(drones) / (duration_s / 60.0);
}

}  // namespace vigil::runtime
