// Prints recordings and models side by side for docs/figures/vehicle_models.gp: for each recorded step a gnuplot data
// block of its name in a comment, then of time, commanded, measured and modelled velocity.
#include <cstdio>
#include <vector>

#include "vigil/testing/recorded_step.hpp"

int main() {
  const char* separator = "";
  for (const vigil::testing::RecordedStep& step : vigil::testing::kRecordedSteps) {
    std::vector<vigil::testing::Sample> samples = vigil::testing::samples_of(VIGIL_REFERENCE_DIR, step);
    vigil::testing::simulate(vigil::testing::loop_of(step), step, samples);
    std::printf("%s# %s\n", separator, step.name);
    separator = "\n\n";
    for (const vigil::testing::Sample& sample : samples)
      std::printf("%.3f %g %.4f %.4f\n", sample.t_s, sample.t_s < 0.0 ? step.from_m_s : step.to_m_s,
                  sample.measured_m_s, sample.model_m_s);
  }
}
