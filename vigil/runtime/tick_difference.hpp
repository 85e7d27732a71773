#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "vigil/runtime/recorded_tick.hpp"

namespace vigil::runtime {

/// Where a recorded tick is not what its inputs lead to.
struct TickDifference {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  std::optional<std::size_t> drone{};  ///< none: what concerns the whole swarm
  std::string what{};                  ///< for people: "velocity asked for, x"
  std::string recorded{};
  std::string recomputed{};  ///< empty where the recording itself is damaged
};

/// The first damage of the recorded tick, or the first of what it decided that differs from the recomputed one, bit by
/// bit, what concerns the whole swarm last.
[[nodiscard]] std::optional<TickDifference> first_difference(const RecordedTick& recorded,
                                                             const swarm::Snapshot& recomputed);

}  // namespace vigil::runtime
