#include "vigil/runtime/standing_orders.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

using swarm::CommandKind;
using swarm::Intent;
using swarm::VehicleMode;

std::vector<CommandKind> given(StandingOrders& standing, const std::vector<swarm::DroneObservation>& seen) {
  std::vector<swarm::Command> commands;
  commands.reserve(16);
  standing.give(seen, commands);
  std::vector<CommandKind> kinds;
  for (const swarm::Command& command : commands) kinds.push_back(command.kind);
  return kinds;
}

swarm::Command order(CommandKind kind, std::size_t drone) {
  swarm::Command command;
  command.kind = kind;
  command.drone = swarm::DroneId(drone);
  return command;
}

TEST(StandingOrders, A_drone_is_stopped_at_once_and_landed_when_it_is_heard_of_each_once) {
  StandingOrders standing({Intent::kEmergencyStop, Intent::kLand, Intent::kMarkedFailed});
  std::vector<swarm::DroneObservation> seen(3);
  EXPECT_EQ(given(standing, seen), (std::vector{CommandKind::kEmergencyStop, CommandKind::kMarkFailed}));
  swarm::DroneMemory memory;
  memory.intent = Intent::kHold;
  EXPECT_EQ(standing.intent_of(1, memory), Intent::kLand);
  seen[1].mode = VehicleMode::kFlying;
  EXPECT_EQ(given(standing, seen), std::vector{CommandKind::kLand});
  EXPECT_EQ(standing.intent_of(1, memory), Intent::kHold);
  EXPECT_TRUE(given(standing, seen).empty());
}

TEST(StandingOrders, What_covered_held_travelled_or_took_off_is_given_no_order_so_it_holds) {
  StandingOrders standing({Intent::kCover, Intent::kHold, Intent::kGoTo, Intent::kTakeOff, Intent::kStayDown});
  std::vector<swarm::DroneObservation> seen(5);
  for (swarm::DroneObservation& one : seen) one.mode = VehicleMode::kGrounded;
  EXPECT_TRUE(given(standing, seen).empty());
}

TEST(StandingOrders, A_newer_order_takes_the_place_of_one_that_still_waits) {
  StandingOrders standing({Intent::kLand, Intent::kLand});
  standing.replaced_by(order(CommandKind::kHold, 1));
  std::vector<swarm::DroneObservation> seen(2);
  for (swarm::DroneObservation& one : seen) one.mode = VehicleMode::kFlying;
  EXPECT_EQ(given(standing, seen), std::vector{CommandKind::kLand});
}

TEST(StandingOrders, Orders_that_no_tick_has_taken_are_foreseen_as_the_swarm_will_take_them) {
  std::vector<swarm::DroneSnapshot> drones(3);
  drones[0].mode = drones[1].mode = VehicleMode::kFlying;
  drones[2].mode = VehicleMode::kGrounded;
  std::vector<Intent> standing{Intent::kCover, Intent::kEmergencyStop, Intent::kStayDown};
  const std::vector orders{order(CommandKind::kLand, 0), order(CommandKind::kLand, 1), order(CommandKind::kLand, 2)};
  foresee(orders, drones, standing);
  EXPECT_EQ(standing, (std::vector{Intent::kLand, Intent::kEmergencyStop, Intent::kStayDown}));
  swarm::Command all;
  all.kind = CommandKind::kMarkFailed;
  foresee(std::vector{all}, drones, standing);
  EXPECT_EQ(standing, (std::vector{Intent::kMarkedFailed, Intent::kEmergencyStop, Intent::kMarkedFailed}));
}

}  // namespace
}  // namespace vigil::runtime
