#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/runtime/lateness.hpp"
#include "vigil/swarm/snapshot.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// All that one tick of a live flight shows to others. Sized once.
struct LiveFrame {
  explicit LiveFrame(std::size_t drones) : snapshot(drones), intents(drones, swarm::Intent::kStayDown) {}

  swarm::Snapshot snapshot;
  swarm::SwarmPast past;                    ///< after the tick
  ergodic::Coefficients c_k;                ///< achieved coverage, 1/m
  std::vector<swarm::Intent> intents;       ///< after the tick: the orders that stand, one per drone
  std::uint64_t newest_order = 0;           ///< the highest ticket of an order to drones that took effect so far
  std::uint64_t revision = 0;               ///< of the targets that the tick used
  bool has_ticked = false;                  ///< false before the first tick
  std::chrono::nanoseconds computed_at{0};  ///< monotonic
};

/// How a live flight's clock goes.
struct ClockState {
  double speed = 1.0;  ///< factor of real time
  bool is_paused = false;
  LatenessFigures lateness;       ///< of the last 10 to 20 s
  LatenessFigures lateness_ever;  ///< since the flight began
};

/// In the air as far as is known.
[[nodiscard]] bool is_airborne(const swarm::DroneSnapshot& drone) noexcept;

/// The smallest distance between two drones that are in the air, as far as is known; infinite without such a pair.
[[nodiscard]] double least_airborne_pair_m(const swarm::Snapshot& snapshot);

}  // namespace vigil::runtime
