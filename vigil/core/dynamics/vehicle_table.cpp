// The autopilots' parameters, one table a vehicle. Residuals: RMS in m/s over the recording, and as a share of the
// step. "fit" recordings determined the numbers, "test" recordings did not. How the structures were chosen, and what
// they do not reproduce: docs/vehicle-models.md.
#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::dynamics {
namespace {

// Crazyflie firmware, velocity-world setpoints. Natural frequency sqrt(kp/Ta) = 5.69 rad/s, damping
// 1 / (2 sqrt(kp Ta)) = 0.467. Dead time is taken as 0: the onset of the recordings is known to 20 to 40 ms only.
//   fit   x 0 to -1    0.0046 (0.5 %)      x 0.5 to 0   0.0025 (0.6 %)
//   test  x 0 to 0.5   0.0027 (0.6 %)      x -1 to 0    0.0057 (0.6 %)
constexpr VelocityLoop kCrazyflie{.gain = 0.878, .proportional_per_s = 6.09, .actuator_lag_s = 0.188};

// ArduCopter 4.7-dev, GUIDED. Ta is chosen, not fitted: anything up to 0.08 s leaves the residuals where they are.
//   fit   x 0 to 5     0.067 (1.3 %)       x 0 to 2     0.028 (1.4 %)      y -2 to 0    0.024 (1.2 %)
//   test  x 5 to 0     0.071 (1.4 %)       y 0 to -2    0.031 (1.6 %)
constexpr VelocityLoop kArduCopterHorizontal{.proportional_per_s = 2.41,
                                             .actuator_lag_s = 0.05,
                                             .acceleration_limit_m_s2 = 2.57,
                                             .jerk_limit_m_s3 = 5.53,
                                             .response_delay_s = 0.12};
//   fit   z 0 to 1     0.016 (1.6 %)       z 1 to -1    0.022 (1.1 %)
//   test  z -1 to 0    0.016 (1.7 %)
constexpr VelocityLoop kArduCopterVertical{
    .proportional_per_s = 3.54, .actuator_lag_s = 0.254, .acceleration_limit_m_s2 = 1.15};

// PX4 v1.16-alpha on its own simulated quadrotor, OFFBOARD. The integral is slow and the drag strong, both as recorded.
//   fit   x 0 to 5     0.039 (0.9 %)       x 5 to 0     0.045 (1.1 %)
//   test  x 0 to 2     0.023 (1.4 %)       y 0 to -2    0.067 (3.7 %)      y -2 to 0    0.093 (5.8 %)
constexpr VelocityLoop kPx4Horizontal{.proportional_per_s = 1.50,
                                      .integral_per_s2 = 0.262,
                                      .drag_per_s = 0.767,
                                      .actuator_lag_s = 0.05,
                                      .response_delay_s = 0.135};
//   fit   z 0 to 1     0.036 (3.4 %)       z 1 to -1    0.036 (1.8 %)
//   test  z -1 to 0    0.041 (3.9 %)
constexpr VelocityLoop kPx4Vertical{.proportional_per_s = 3.64,
                                    .integral_per_s2 = 3.66,
                                    .drag_per_s = 1.56,
                                    .actuator_lag_s = 0.05,
                                    .response_delay_s = 0.0135};

}  // namespace

// No recording shows the Crazyflie's vertical: it is taken to be like its horizontal.
VehicleModel crazyflie_vehicle() noexcept { return {VehicleKind::kCrazyflie, kCrazyflie, kCrazyflie}; }

VehicleModel arducopter_vehicle() noexcept {
  return {VehicleKind::kArduCopter, kArduCopterHorizontal, kArduCopterVertical};
}

VehicleModel px4_vehicle() noexcept { return {VehicleKind::kPx4, kPx4Horizontal, kPx4Vertical}; }

}  // namespace vigil::dynamics
