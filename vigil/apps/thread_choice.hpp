#pragma once

#include <cstddef>

namespace vigil::apps {

/// How many threads share the work of so many drones: as many as were `asked` for, or, where that is 0, as are worth
/// it, one for every thousand drones, and no more than the machine has cores.
[[nodiscard]] std::size_t threads_for(std::size_t drones, std::size_t asked);

}  // namespace vigil::apps
