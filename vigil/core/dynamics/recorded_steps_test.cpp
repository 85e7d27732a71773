// The vehicle models against the recordings of testing/reference/step-responses/.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/dynamics/response_bounds.hpp"
#include "vigil/testing/recorded_step.hpp"

namespace vigil::dynamics {
namespace {

using testing::RecordedStep;
using testing::Residual;
using testing::Sample;

std::vector<Sample> simulated(const RecordedStep& step) {
  std::vector<Sample> samples = testing::samples_of(VIGIL_REFERENCE_DIR, step);
  testing::simulate(testing::loop_of(step), step, samples);
  return samples;
}

const RecordedStep& recording(const char* name) {
  for (const RecordedStep& step : testing::kRecordedSteps)
    if (std::strcmp(step.name, name) == 0) return step;
  throw std::out_of_range(name);
}

std::string row(const RecordedStep& step, const Residual& residual) {
  std::ostringstream text;
  text << std::left << std::setw(22) << step.name << (step.was_fitted ? "fit  " : "test ") << std::fixed
       << std::setprecision(4) << residual.rms << "  " << residual.worst << " at " << std::setprecision(2)
       << std::setw(5) << residual.worst_at_s << std::setprecision(3) << "  " << residual.worst_distance_m << "  "
       << std::setprecision(4) << residual.noise_floor;
  return text.str();
}

TEST(RecordedSteps, Every_model_follows_its_recordings) {
  std::string table = "recording             use  rms m/s  worst m/s at s  distance m  noise m/s\n";
  for (const RecordedStep& step : testing::kRecordedSteps) {
    const std::vector<Sample> samples = simulated(step);
    ASSERT_GT(samples.size(), 180U) << step.name;
    const Residual residual = testing::residual_of(samples);
    table += row(step, residual) + "\n";
    EXPECT_LT(residual.rms, step.rms_bound_m_s) << step.name;
    EXPECT_LT(residual.worst, step.worst_bound_m_s) << step.name;
  }
  std::fputs(table.c_str(), stdout);
}

TEST(RecordedSteps, Another_vehicle_s_model_does_not_follow_them) {
  for (const RecordedStep& step : testing::kRecordedSteps) {
    const VehicleModel other = std::strcmp(step.vehicle, "crazyflie") == 0 ? arducopter_vehicle() : crazyflie_vehicle();
    std::vector<Sample> samples = testing::samples_of(VIGIL_REFERENCE_DIR, step);
    testing::simulate(step.is_vertical ? other.vertical : other.horizontal, step, samples);
    EXPECT_GT(testing::residual_of(samples).rms, 1.5 * step.rms_bound_m_s) << step.name;
  }
}

/// What a recorded vehicle covered from the command on.
double recorded_distance(const std::vector<Sample>& samples) {
  double distance = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i - 1].t_s < 0.0) continue;
    const double mean = 0.5 * (samples[i].measured_m_s + samples[i - 1].measured_m_s);
    distance += mean * (samples[i].t_s - samples[i - 1].t_s);
    farthest = std::max(farthest, std::abs(distance));
  }
  return farthest;
}

TEST(RecordedSteps, The_stopping_distance_is_the_recorded_one) {
  for (const char* name : {"arducopter_x_5_to_0", "arducopter_y_-2_to_0"}) {
    const RecordedStep& step = recording(name);
    const double recorded = recorded_distance(testing::samples_of(VIGIL_REFERENCE_DIR, step));
    EXPECT_NEAR(stop_from(testing::loop_of(step), std::abs(step.from_m_s)).distance_m, recorded, 0.05 * recorded)
        << name;
  }
  // Time 0 of a Crazyflie's recording is up to 40 ms after the command.
  for (const char* name : {"crazyflie_x_-1_to_0", "crazyflie_x_0.5_to_0"}) {
    const RecordedStep& step = recording(name);
    const VelocityLoop loop = testing::loop_of(step);
    const double speed = std::abs(step.from_m_s) * steady_gain(loop);
    const double recorded = recorded_distance(testing::samples_of(VIGIL_REFERENCE_DIR, step));
    EXPECT_NEAR(stop_from(loop, speed).distance_m, recorded - speed * step.onset_s, 0.06 * recorded) << name;
  }
}

TEST(RecordedSteps, A_px4_comes_as_far_as_recorded_and_a_little_farther) {
  // The recording ends at 0.44 m/s, so that the model's whole stop is longer; over the recorded time they agree.
  const RecordedStep& step = recording("px4_x_5_to_0");
  const std::vector<Sample> samples = simulated(step);
  const double recorded = recorded_distance(samples);
  const VelocityLoop loop = testing::loop_of(step);
  const double whole = stop_from(loop, in_flight(loop, samples.front().model_m_s, step.from_m_s)).distance_m;
  EXPECT_NEAR(testing::residual_of(samples).worst_distance_m / recorded, 0.0, 0.05);
  EXPECT_GT(whole, recorded);
  EXPECT_LT(whole, 2.0 * recorded);
}

}  // namespace
}  // namespace vigil::dynamics
