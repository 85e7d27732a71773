#include "vigil/core/dynamics/battery.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vigil::dynamics {
namespace {

struct Point {
  double charge;
  double volt;
};

/// The usual shape of a lithium-polymer cell: a steep end, a long plateau, a rise to 4.2 V. Straight in between.
constexpr std::array kCurve = {Point{0.00, 3.27}, Point{0.05, 3.61}, Point{0.10, 3.69}, Point{0.20, 3.73},
                               Point{0.30, 3.77}, Point{0.40, 3.80}, Point{0.50, 3.84}, Point{0.60, 3.87},
                               Point{0.70, 3.95}, Point{0.80, 4.02}, Point{0.90, 4.11}, Point{1.00, 4.20}};

double interpolated(double x, double Point::* of, double Point::* to) {
  const double inside = std::clamp(x, kCurve.front().*of, kCurve.back().*of);
  std::size_t above = 1;
  while (above + 1 < kCurve.size() && kCurve[above].*of < inside) ++above;
  const Point& high = kCurve[above];
  const Point& low = kCurve[above - 1];
  return low.*to + (high.*to - low.*to) * (inside - low.*of) / (high.*of - low.*of);
}

double open_voltage(const Battery& battery, const BatteryState& state) {
  return battery.cells * open_cell_voltage(state.charge);
}

double resistance(const Battery& battery) { return battery.resistance_ohm / battery.health; }

}  // namespace

Battery crazyflie_battery() noexcept { return {.cells = 1, .capacity_ah = 0.25, .resistance_ohm = 0.06}; }

Battery outdoor_battery() noexcept { return {.cells = 6, .capacity_ah = 5.0, .resistance_ohm = 0.02}; }

double open_cell_voltage(double charge) noexcept { return interpolated(charge, &Point::charge, &Point::volt); }

double charge_at(double open_cell_voltage) noexcept {
  return interpolated(open_cell_voltage, &Point::volt, &Point::charge);
}

double voltage_under(const Battery& battery, const BatteryState& state, double current_a) noexcept {
  return open_voltage(battery, state) - resistance(battery) * current_a;
}

double current_for(const Battery& battery, const BatteryState& state, double power_w) noexcept {
  const double v0 = open_voltage(battery, state);
  const double root = std::sqrt(std::max(0.0, v0 * v0 - 4.0 * resistance(battery) * power_w));
  // The form that does not cancel where R is small: I = 2 P / (V0 + root); beyond the greatest power, V0^2 / (4 R).
  const double deliverable = root > 0.0 ? power_w : std::min(power_w, v0 * v0 / (4.0 * resistance(battery)));
  return 2.0 * deliverable / (v0 + root);
}

bool can_deliver(const Battery& battery, const BatteryState& state, double power_w) noexcept {
  const double voltage = voltage_under(battery, state, current_for(battery, state, power_w));
  return state.charge > 0.0 && voltage >= battery.cells * kEmptyCellVoltage;
}

double endurance_s(const Battery& battery, double power_w) {
  constexpr double kLongest = 86'400.0;
  double flown_s = 0.0;
  for (BatteryState state; flown_s < kLongest && can_deliver(battery, state, power_w); flown_s += 1.0)
    state = after_power(battery, state, power_w, 1.0);
  return flown_s;
}

BatteryState after_current(const Battery& battery, const BatteryState& state, double current_a, double dt_s) noexcept {
  const double drawn = current_a * dt_s / (3600.0 * battery.capacity_ah * battery.health);
  return {std::clamp(state.charge - drawn, 0.0, 1.0)};
}

BatteryState after_power(const Battery& battery, const BatteryState& state, double power_w, double dt_s) noexcept {
  constexpr double kLongestSubstep = 1.0;
  const double substeps = std::max(1.0, std::ceil(dt_s / kLongestSubstep));
  const double h = dt_s / substeps;
  BatteryState now = state;
  for (double n = 0.0; n < substeps; n += 1.0) {
    const BatteryState middle = after_current(battery, now, current_for(battery, now, power_w), 0.5 * h);
    now = after_current(battery, now, current_for(battery, middle, power_w), h);
  }
  return now;
}

}  // namespace vigil::dynamics
