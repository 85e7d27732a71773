#pragma once

#include <cstdint>

#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// A mission that is right, with every optional value given or not and every number drawn to its last bit: same seed,
/// same mission. For tests.
[[nodiscard]] Mission random_mission(std::uint64_t seed);

}  // namespace vigil::runtime
