#pragma once

namespace vigil::dynamics {

/// A lithium-polymer battery: an open-circuit voltage that depends on the charge alone, behind a resistance.
///   V = cells OCV(charge) - R I,   charge' = -I / (3600 capacity health)
/// Temperature and the slow recovery after a load are left out.
struct Battery {
  int cells = 1;                ///< in series
  double capacity_ah = 0.25;    ///< > 0, when new
  double health = 1.0;          ///< in (0, 1]: capacity left by age; the resistance grows as 1 / health
  double resistance_ohm = 0.0;  ///< >= 0, of all cells and leads, when new
};

/// 1S 250 mAh: hovers for about 7 minutes. 6S 5 Ah: about 20 minutes. Resistances are typical values, not recorded.
[[nodiscard]] Battery crazyflie_battery() noexcept;
[[nodiscard]] Battery outdoor_battery() noexcept;

/// What hovering takes, chosen so that the new, full battery lasts as long as above. Watts.
inline constexpr double kCrazyflieHoverPower = 8.0;
inline constexpr double kOutdoorHoverPower = 343.0;

/// Below this voltage under load, per cell, a battery counts as empty: flying ends.
inline constexpr double kEmptyCellVoltage = 3.0;

struct BatteryState {
  double charge = 1.0;  ///< in [0, 1], the share of what this battery still can hold
};

/// The open-circuit voltage of one cell, strictly increasing in charge; outside of [0, 1] as at its ends.
[[nodiscard]] double open_cell_voltage(double charge) noexcept;

/// Its inverse: the charge at which a cell shows this voltage when nothing is drawn.
[[nodiscard]] double charge_at(double open_cell_voltage) noexcept;

/// At the terminals. May be negative for a current that the battery cannot give.
[[nodiscard]] double voltage_under(const Battery& battery, const BatteryState& state, double current_a) noexcept;

/// The current that delivers power_w >= 0 at the terminals: the smaller root of (V0 - R I) I = P; that of the greatest
/// power, V0 / (2 R), if the battery cannot deliver P.
[[nodiscard]] double current_for(const Battery& battery, const BatteryState& state, double power_w) noexcept;

/// How long the full battery keeps a power up, to a second; at most a day. Steps through the whole discharge: for
/// setup.
[[nodiscard]] double endurance_s(const Battery& battery, double power_w);

/// Whether the battery still delivers power_w at kEmptyCellVoltage or more.
[[nodiscard]] bool can_deliver(const Battery& battery, const BatteryState& state, double power_w) noexcept;

/// dt_s >= 0 later, exactly; the charge stops at 0.
[[nodiscard]] BatteryState after_current(const Battery& battery, const BatteryState& state, double current_a,
                                         double dt_s) noexcept;

/// The same for a constant power, in midpoint substeps of at most a second.
[[nodiscard]] BatteryState after_power(const Battery& battery, const BatteryState& state, double power_w,
                                       double dt_s) noexcept;

}  // namespace vigil::dynamics
