#pragma once

#include <cstdint>
#include <limits>

#include "vigil/core/field/vec2.hpp"

namespace vigil::swarm {

/// What a vehicle says of itself.
enum class VehicleMode : std::uint8_t {
  kUnknown,    ///< nothing has been heard yet
  kGrounded,   ///< motors off or idling, on the ground
  kTakingOff,  ///< climbing to its altitude by itself
  kFlying,     ///< follows velocity commands
  kLanding,    ///< descending by itself
  kFalling,    ///< motors stopped in the air
  kManual,     ///< a pilot flies it
  kFailed      ///< in the air, follows nobody
};

/// The newest that is known of one drone when a tick begins. Field frame. Adapters convert; nothing in it is trusted:
/// the tick copes with values that are not finite, old, repeated or absent.
struct DroneObservation {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Vec2 position = Vec2::Zero();  ///< metres
  Vec2 velocity = Vec2::Zero();  ///< metres per second, estimated
  double height_m = 0.0;         ///< above the ground
  double age_s = kNever;         ///< since position was true; kNever: never seen
  VehicleMode mode = VehicleMode::kUnknown;
  double link_age_s = kNever;                                 ///< since the vehicle was last heard
  double battery = std::numeric_limits<double>::quiet_NaN();  ///< share of full, 0..1; NaN: not reported
};

}  // namespace vigil::swarm
