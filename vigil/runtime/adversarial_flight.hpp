#pragma once

#include <cstdint>
#include <optional>

#include "vigil/core/dynamics/velocity_loop.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/core/safety/filter.hpp"

namespace vigil::runtime {

/// What the drones of an adversarial flight wish for: to hit each other, or the walls, at the worst moment.
enum class Wish : std::uint8_t {
  kPress,    ///< everybody straight at the next one
  kOrbit,    ///< at the next one, turned by `angle_rad`: round each other on the barrier's edge, pushing inwards
  kPulse,    ///< at the next one, and away from it for the last quarter of each period
  kChase,    ///< the even ones press; the odd ones flee, and turn on them half a period later
  kReverse,  ///< orbits whose sense is reversed every half period
  kRandom,   ///< at, away, or to a side, changed at random moments, half a period apart on average
  kWalls     ///< each at another wall, turned by `angle_rad`, and back for the last quarter of each period
};

/// Vehicles that are as bad as their model allows, seen without noise, in still air, over links that lose nothing.
struct AdversarialFlight {
  dynamics::VelocityLoop loop;                    ///< dead time included
  std::optional<double> acceleration_limit_m_s2;  ///< of a first-order lag, hard
  safety::BarrierParameters barrier;
  field::Field field;
  std::size_t drones = 2;
  double start_radius_m = 1.0;  ///< of the circle around the field's middle on which they begin, at rest
  std::size_t observation_delay_ticks = 0;
  std::size_t command_delay_ticks = 0;  ///< from an order to the vehicle's answer, dead time included: made up for
  Wish wish = Wish::kPress;
  double period_s = 4.0;
  double angle_rad = 1.0;
  double duration_s = 30.0;
  std::uint64_t seed = 1;  ///< of kRandom
};

/// The truth about a flight, metres.
struct Closest {
  double separation_m = 0.0;  ///< the least distance of two drones; infinite for one
  double wall_m = 0.0;        ///< the least distance from a wall, negative outside
};

/// Flies it, the filter deciding every tick with swarm::FlownOrders before it, as swarm::tick() has it. Same input,
/// same bits.
[[nodiscard]] Closest fly(const AdversarialFlight& flight);

}  // namespace vigil::runtime
