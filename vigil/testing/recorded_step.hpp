#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "vigil/core/dynamics/vehicle_model.hpp"

namespace vigil::testing {

/// A recorded velocity step: testing/reference/step-responses/README.md.
struct RecordedStep {
  const char* name;     ///< the file's, without .csv
  const char* vehicle;  ///< as vehicle_kind_of() reads it
  bool is_vertical;
  double from_m_s;       ///< commanded before
  double to_m_s;         ///< commanded from time 0 on
  double onset_s;        ///< what the file's time 0 is later than the change (Crazyflie only: see the README)
  bool was_fitted;       ///< the model's parameters were fitted to it; otherwise it tests them
  double rms_bound_m_s;  ///< what the residual must stay below
  double worst_bound_m_s;
};

struct Sample {
  double t_s;
  double measured_m_s;
  double model_m_s;
};

/// How far model and recording are apart, and how still the recording itself is. m/s.
struct Residual {
  double rms = 0.0;
  double worst = 0.0;
  double worst_at_s = 0.0;
  double worst_distance_m = 0.0;  ///< the greatest difference of the distances covered since the step
  double noise_floor = 0.0;       ///< RMS of the recording's last half second about its own straight line
};

inline std::vector<Sample> samples_of(const std::string& folder, const RecordedStep& step) {
  std::ifstream file(folder + "/step-responses/" + step.name + ".csv");
  std::string line;
  std::getline(file, line);
  std::vector<Sample> samples;
  while (std::getline(file, line)) {
    char* at = nullptr;
    const double t = std::strtod(line.c_str(), &at);
    const double commanded = std::strtod(at + 1, &at);
    if (commanded != step.to_m_s) return {};
    samples.push_back({t, std::strtod(at + 1, nullptr), 0.0});
  }
  return samples;
}

inline dynamics::VehicleModel model_of(const RecordedStep& step) {
  switch (*dynamics::vehicle_kind_of(step.vehicle)) {
    case dynamics::VehicleKind::kCrazyflie:
      return dynamics::crazyflie_vehicle();
    case dynamics::VehicleKind::kArduCopter:
      return dynamics::arducopter_vehicle();
    case dynamics::VehicleKind::kPx4:
      return dynamics::px4_vehicle();
    default:
      return dynamics::ideal_vehicle();
  }
}

inline dynamics::VelocityLoop loop_of(const RecordedStep& step) {
  const dynamics::VehicleModel model = model_of(step);
  return step.is_vertical ? model.vertical : model.horizontal;
}

/// What the vehicle flew at before the step: the mean before time 0, or the steady speed where there is nothing before.
inline double speed_before(const dynamics::VelocityLoop& loop, const RecordedStep& step,
                           const std::vector<Sample>& samples) {
  double sum = 0.0;
  int count = 0;
  for (const Sample& sample : samples)
    if (sample.t_s < 0.0) sum += sample.measured_m_s, ++count;
  return count > 0 ? sum / count : dynamics::steady_gain(loop) * step.from_m_s;
}

/// The state from which the loop, at its command's change, starts: steady flight. A loop without integral holds a speed
/// that is not quite the command's only under that speed's own command, which makes no difference after the step.
inline void simulate(const dynamics::VelocityLoop& loop, const RecordedStep& step, std::vector<Sample>& samples) {
  dynamics::AxisState state = dynamics::in_flight(loop, speed_before(loop, step, samples), step.from_m_s);
  double now = loop.response_delay_s + step.onset_s;
  for (Sample& sample : samples) {
    if (sample.t_s > now) {
      state = dynamics::advance(loop, state, step.to_m_s, sample.t_s - now);
      now = sample.t_s;
    }
    sample.model_m_s = state.velocity_m_s;
  }
}

inline double noise_floor(const std::vector<Sample>& samples) {
  double n = 0.0, st = 0.0, sy = 0.0, stt = 0.0, sty = 0.0, syy = 0.0;
  const double end = samples.back().t_s;
  for (const Sample& sample : samples) {
    const double t = sample.t_s - end, y = sample.measured_m_s;
    if (t < -0.5) continue;
    n += 1.0, st += t, sy += y, stt += t * t, sty += t * y, syy += y * y;
  }
  const double vt = stt - st * st / n, vy = syy - sy * sy / n, vty = sty - st * sy / n;
  return std::sqrt(std::max(0.0, vy - vty * vty / vt) / n);
}

/// The trapezoidal integral of model less recording from time 0 on, at its greatest.
inline double worst_distance(const std::vector<Sample>& samples) {
  double distance = 0.0;
  double worst = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& before = samples[i - 1];
    const Sample& now = samples[i];
    if (before.t_s < 0.0) continue;
    const double error = before.model_m_s - before.measured_m_s + now.model_m_s - now.measured_m_s;
    distance += 0.5 * error * (now.t_s - before.t_s);
    worst = std::max(worst, std::abs(distance));
  }
  return worst;
}

inline Residual residual_of(const std::vector<Sample>& samples) {
  Residual residual;
  for (const Sample& sample : samples) {
    const double error = sample.model_m_s - sample.measured_m_s;
    residual.rms += error * error / static_cast<double>(samples.size());
    if (std::abs(error) > residual.worst) residual.worst = std::abs(error), residual.worst_at_s = sample.t_s;
  }
  residual.rms = std::sqrt(residual.rms);
  residual.worst_distance_m = worst_distance(samples);
  residual.noise_floor = noise_floor(samples);
  return residual;
}

/// Every recording. The bounds are the residuals measured when the models were fitted, and a tenth.
inline constexpr RecordedStep kRecordedSteps[] = {
    {"crazyflie_x_0_to_-1", "crazyflie", false, 0.0, -1.0, -0.0014, true, 0.0052, 0.020},
    {"crazyflie_x_0.5_to_0", "crazyflie", false, 0.5, 0.0, -0.0396, true, 0.0029, 0.005},
    {"crazyflie_x_0_to_0.5", "crazyflie", false, 0.0, 0.5, -0.0409, false, 0.0031, 0.005},
    {"crazyflie_x_-1_to_0", "crazyflie", false, -1.0, 0.0, -0.0026, false, 0.0064, 0.0125},
    {"arducopter_x_0_to_5", "arducopter", false, 0.0, 5.0, 0.0, true, 0.075, 0.20},
    {"arducopter_x_0_to_2", "arducopter", false, 0.0, 2.0, 0.0, true, 0.032, 0.05},
    {"arducopter_y_-2_to_0", "arducopter", false, -2.0, 0.0, 0.0, true, 0.027, 0.046},
    {"arducopter_x_5_to_0", "arducopter", false, 5.0, 0.0, 0.0, false, 0.079, 0.27},
    {"arducopter_y_0_to_-2", "arducopter", false, 0.0, -2.0, 0.0, false, 0.035, 0.09},
    {"arducopter_z_0_to_1", "arducopter", true, 0.0, 1.0, 0.0, true, 0.018, 0.044},
    {"arducopter_z_1_to_-1", "arducopter", true, 1.0, -1.0, 0.0, true, 0.025, 0.057},
    {"arducopter_z_-1_to_0", "arducopter", true, -1.0, 0.0, 0.0, false, 0.018, 0.033},
    {"px4_x_0_to_5", "px4", false, 0.0, 5.0, 0.0, true, 0.042, 0.11},
    {"px4_x_5_to_0", "px4", false, 5.0, 0.0, 0.0, true, 0.050, 0.155},
    {"px4_x_0_to_2", "px4", false, 0.0, 2.0, 0.0, false, 0.026, 0.05},
    {"px4_y_0_to_-2", "px4", false, 0.0, -2.0, 0.0, false, 0.074, 0.17},
    {"px4_y_-2_to_0", "px4", false, -2.0, 0.0, 0.0, false, 0.103, 0.25},
    {"px4_z_0_to_1", "px4", true, 0.0, 1.0, 0.0, true, 0.040, 0.12},
    {"px4_z_1_to_-1", "px4", true, 1.0, -1.0, 0.0, true, 0.040, 0.11},
    {"px4_z_-1_to_0", "px4", true, -1.0, 0.0, 0.0, false, 0.045, 0.135},
};

}  // namespace vigil::testing
