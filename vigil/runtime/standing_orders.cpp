#include "vigil/runtime/standing_orders.hpp"

#include <algorithm>
#include <optional>

namespace vigil::runtime {
namespace {

using swarm::CommandKind;
using swarm::Intent;

/// What brings a drone that holds back under an order; none where it is to hold.
std::optional<CommandKind> wish_for(Intent intent) {
  switch (intent) {
    case Intent::kLand:
    case Intent::kCalledBack:
      return CommandKind::kLand;
    case Intent::kMarkedFailed:
      return CommandKind::kMarkFailed;
    case Intent::kEmergencyStop:
      return CommandKind::kEmergencyStop;
    case Intent::kOverride:
      return CommandKind::kOverride;
    default:
      return std::nullopt;
  }
}

/// Who has not been heard of can only be stopped or given up.
bool can_be_given(CommandKind wish, const swarm::DroneObservation& observed) {
  return wish == CommandKind::kEmergencyStop || wish == CommandKind::kMarkFailed ||
         observed.mode != swarm::VehicleMode::kUnknown;
}

}  // namespace

StandingOrders::StandingOrders(const std::vector<Intent>& standing) {
  for (std::size_t drone = 0; drone < standing.size(); ++drone)
    if (wish_for(standing[drone])) waiting_.push_back({drone, standing[drone]});
}

void StandingOrders::give(std::span<const swarm::DroneObservation> observations,
                          std::vector<swarm::Command>& commands) noexcept {
  std::erase_if(waiting_, [&](const Order& order) {
    const CommandKind wish = *wish_for(order.intent);
    if (!can_be_given(wish, observations[order.drone]) || commands.size() == commands.capacity()) return false;
    swarm::Command command;
    command.kind = wish;
    command.drone = swarm::DroneId(order.drone);
    commands.push_back(command);
    return true;
  });
}

void StandingOrders::replaced_by(const swarm::Command& command) noexcept {
  std::erase_if(waiting_, [&](const Order& order) { return !command.drone || command.drone->index() == order.drone; });
}

Intent StandingOrders::intent_of(std::size_t drone, const swarm::DroneMemory& memory) const noexcept {
  const auto waiting = std::ranges::find(waiting_, drone, &Order::drone);
  return waiting == waiting_.end() ? memory.intent : waiting->intent;
}

void foresee(std::span<const swarm::Command> orders, std::span<const swarm::DroneSnapshot> drones,
             std::span<Intent> standing) noexcept {
  const auto take = [&](CommandKind wish, std::size_t drone) {
    swarm::DroneMemory memory;
    memory.intent = standing[drone];
    memory.last_good.mode = drones[drone].mode;
    memory.last_good.age_s = drones[drone].age_s;
    if (swarm::apply_wish(memory, wish)) standing[drone] = memory.intent;
  };
  for (const swarm::Command& order : orders) {
    if (order.drone) {
      take(order.kind, order.drone->index());
      continue;
    }
    for (std::size_t drone = 0; drone < standing.size(); ++drone) take(order.kind, drone);
  }
}

}  // namespace vigil::runtime
