#pragma once

#include "vigil/runtime/margins.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::runtime {

/// What derive_margins() is asked for a mission: its assumed vehicle and the simulated tracker, link and wind, which
/// are what is known of the world. What the mission itself gives of delays, lag and gains counts as given.
[[nodiscard]] MarginProblem margin_problem(const Mission& mission);

/// The vehicle of `safety.vehicle`: a recorded one, or the simulated one.
[[nodiscard]] dynamics::VehicleModel assumed_vehicle(const Mission& mission);

/// From a decision to the vehicle's answer on average: its dead time, the link's way, half of the time between two
/// packets. In whole ticks where all of it is steady, as the simulator has it.
[[nodiscard]] double derived_command_delay_s(const Mission& mission);
/// The same, however long it is: derived_command_delay_s() is at most what can be made up for.
[[nodiscard]] double simulated_command_delay_s(const Mission& mission);

/// The greatest age of an observation while nothing is lost.
[[nodiscard]] double derived_observation_delay_s(const Mission& mission);

/// For so long orders may stay away, and nothing may be hit: until the vehicle's failsafe lets it hover, and its stop,
/// so that the swarm is safe should this program end at any moment. A vehicle without a failsafe: a loss of packets
/// that one in a million is longer than.
[[nodiscard]] double derived_silence_s(const Mission& mission);

/// The length of silence that one burst of lost packets in a million exceeds.
[[nodiscard]] double longest_burst_s(const Mission& mission);

/// What the mission would be given where it gives nothing. Meaningless for the barrier `paper`.
[[nodiscard]] Margins derived_margins(const Mission& mission);

}  // namespace vigil::runtime
