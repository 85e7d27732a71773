#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vigil/core/ergodic/controller_kind.hpp"
#include "vigil/core/ergodic/coverage_statistics.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/core/safety/filter.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/charging_pad.hpp"

namespace vigil::swarm {

/// No prediction adds more than the orders of so long.
inline constexpr double kLongestPredictionS = 2.0;

/// What the controller is set up with; it does not change in flight.
struct SwarmParameters {
  field::Field field;
  std::size_t drones = 0;
  double dt_s = 0.02;
  int basis_max_index = 10;       ///< K
  double basis_smoothness = 1.5;  ///< s
  ergodic::Accounting accounting = ergodic::Accounting::kDroneTime;
  std::optional<double> memory_s;
  ergodic::ControllerKind controller = ergodic::ControllerKind::kLookAhead;
  double fade = 0.1;  ///< kGradient: delta of the faded gradient in units of gradient_scale()
  /// kLookAhead: how far it looks; none: as long as a drone takes to cross 0.6 of its share of the field.
  std::optional<double> look_ahead_s;
  safety::BarrierParameters barrier;
  /// From a tick to the moment at which its orders begin to act on a vehicle; kLagAware only. Within
  /// [0, kLongestPredictionS].
  double command_delay_s = 0.0;
  /// How old observations usually are. Only what is older counts as unknown: the way up to here is predicted.
  double observation_delay_s = 0.0;
  /// The paper's reading: a drone that is not active is no obstacle, wherever it is.
  bool only_active_are_obstacles = false;
  HealthParameters health;
  FaultParameters faults;
  RechargeParameters recharge;
  Intent first_intent = Intent::kStayDown;  ///< of every drone before any command
  /// Where each drone is expected before it is seen, field frame; none where nobody knows.
  std::vector<Vec2> starts;
};

}  // namespace vigil::swarm
