#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vigil/core/ergodic/basis.hpp"
#include "vigil/core/field/polygon.hpp"
#include "vigil/swarm/drone_id.hpp"

namespace vigil::swarm {

/// Where to look, ready for the controller. Made outside the tick, immutable afterwards.
struct CoverageTarget {
  ergodic::Coefficients phi_k;  ///< (K+1) x (K+1); ignored where has_targets is false
  /// Of the part that keeps its drones where there are fewer (Protection); of no size where nothing is protected.
  ergodic::Coefficients protected_k;
  bool has_targets = false;            ///< false: nothing to look at, the drones hover
  std::vector<field::Segment> no_fly;  ///< edges, inside on the left; at most kMaxNoFlyEdges
};

inline constexpr std::size_t kMaxNoFlyEdges = 4096;

enum class CommandKind : std::uint8_t {
  kTakeOff,
  kLand,
  kHold,           ///< hover, out of coverage, still avoiding others
  kGoTo,           ///< fly to `place` and wait there, out of coverage
  kResume,         ///< back to coverage after kHold, kGoTo or kMarkFailed
  kMarkFailed,     ///< an operator declares it failed: whatever it does, it is not ours
  kEmergencyStop,  ///< motors off
  kOverride,       ///< a pilot takes it
  kGiveBack,       ///< the pilot gives it back
  kSetTarget,      ///< a new importance map
  kStartAfresh     ///< forget where the swarm has been
};

/// An operator's wish. It takes effect at the tick that it is given to.
struct Command {
  CommandKind kind = CommandKind::kHold;
  std::optional<DroneId> drone;                  ///< none: all drones
  Vec2 place = Vec2::Zero();                     ///< kGoTo only: field frame, inside the field
  std::shared_ptr<const CoverageTarget> target;  ///< kSetTarget only, never null there
};

}  // namespace vigil::swarm
