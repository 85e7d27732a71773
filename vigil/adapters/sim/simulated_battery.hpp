#pragma once

#include "vigil/core/dynamics/battery.hpp"

namespace vigil::sim {

/// A battery in a vehicle, and what hovering takes from it.
struct BatteryParameters {
  dynamics::Battery battery;
  double hover_power_w = 0.0;
  double start = 1.0;  ///< charge at the start, share of what the battery still can hold
};

/// The battery as its vehicle wears it down. Flying takes the power of hovering, whatever the vehicle does; standing
/// takes none.
class SimulatedBattery {
 public:
  explicit SimulatedBattery(const BatteryParameters& parameters) : parameters_(parameters), state_{parameters.start} {}

  void advance(bool is_airborne, double dt_s) noexcept;

  /// Puts a share of what it can hold into it; what is too much is lost. Precondition: >= 0.
  void charge(double share) noexcept;

  /// The battery delivers no more what hovering takes.
  [[nodiscard]] bool is_empty() const noexcept;

  /// The share of charge that the vehicle reports: by the voltage that it measures and by the current that it takes a
  /// new battery's resistance for. An old battery is reported to hold less than it does.
  [[nodiscard]] double reported() const noexcept;

  [[nodiscard]] double state_of_charge() const noexcept { return state_.charge; }

 private:
  BatteryParameters parameters_;
  dynamics::BatteryState state_;
  double current_a_ = 0.0;
};

}  // namespace vigil::sim
