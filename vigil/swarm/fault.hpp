#pragma once

#include <cstdint>
#include <optional>

#include "vigil/core/dynamics/fault_bounds.hpp"
#include "vigil/core/dynamics/velocity_loop.hpp"
#include "vigil/swarm/drone_id.hpp"

namespace vigil::swarm {

/// What is seen to be wrong with a drone, or with what is told of it, although every report looks fresh.
enum class Fault : std::uint8_t {
  kNone,
  kFrozen,        ///< fresh positions that are always the same one
  kJumped,        ///< its position is where it cannot have flown
  kSwapped,       ///< its position is that of another drone
  kDisagreeing,   ///< its reported velocity is not that of its positions
  kNotFollowing,  ///< it does not fly what it is told
  kOutside,       ///< it left the field
  kOwnMode        ///< it changed its mode by itself: its own failsafe, or a pilot
};

/// A fault with its evidence.
struct FaultReport {
  Fault kind = Fault::kNone;
  double since_s = 0.0;            ///< since when it has been suspected, on the monitor's clock
  double measured = 0.0;           ///< kFrozen: s; kOwnMode: nothing; the others: m
  double threshold = 0.0;          ///< what `measured` is beyond
  std::optional<DroneId> other{};  ///< kSwapped: whose position it has
};

/// What drones are held against. With `watches` false everything is believed, and no fault is found.
struct FaultParameters {
  bool watches = false;
  dynamics::VelocityLoop loop;                    ///< the plane's, its dead time not included
  std::optional<double> acceleration_limit_m_s2;  ///< of a first-order lag, hard
  dynamics::FaultBounds bounds;
};

}  // namespace vigil::swarm
