#include "vigil/adapters/sim/simulated_battery.hpp"

#include <algorithm>

namespace vigil::sim {

void SimulatedBattery::advance(bool is_airborne, double dt_s) noexcept {
  const double power_w = is_airborne ? parameters_.hover_power_w : 0.0;
  state_ = dynamics::after_power(parameters_.battery, state_, power_w, dt_s);
  current_a_ = dynamics::current_for(parameters_.battery, state_, power_w);
}

void SimulatedBattery::charge(double share) noexcept { state_.charge = std::min(1.0, state_.charge + share); }

bool SimulatedBattery::is_empty() const noexcept {
  return !dynamics::can_deliver(parameters_.battery, state_, parameters_.hover_power_w);
}

double SimulatedBattery::reported() const noexcept {
  const dynamics::Battery& battery = parameters_.battery;
  const double voltage = dynamics::voltage_under(battery, state_, current_a_);
  return dynamics::charge_at((voltage + battery.resistance_ohm * current_a_) / battery.cells);
}

}  // namespace vigil::sim
