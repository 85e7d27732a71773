// How long a whole mission takes: the paper's 120 s, flown and recorded as `vigil simulate` does it; and ten drones of
// each recorded autopilot. One core.

#include <filesystem>
#include <string>
#include <unistd.h>

#include <benchmark/benchmark.h>

#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil {
namespace {

namespace fs = std::filesystem;

runtime::FlightSummary fly(const runtime::Mission& mission, runtime::Recorder* recorder) {
  const auto fleet = apps::simulated_fleet(mission);
  if (recorder != nullptr) recorder->begin(mission, {runtime::first_intent(mission), {}});
  runtime::VirtualFlight flight(mission, *fleet, recorder, [] { return std::chrono::nanoseconds{}; });
  while (!flight.is_over()) flight.step();
  if (recorder != nullptr) recorder->finish();
  return flight.summary();
}

bool is_right(const runtime::FlightSummary& summary) {
  return summary.complete && summary.last_percent <= 5.0 && summary.audit.separation_violations == 0 &&
         summary.audit.wall_violations == 0 && summary.audit.speed_violations == 0;
}

void report(benchmark::State& state, const runtime::FlightSummary& summary) {
  state.counters["simulated_s"] = summary.duration_s;
  state.counters["times_real_time"] =
      benchmark::Counter(summary.duration_s, benchmark::Counter::kIsIterationInvariantRate);
}

void FlyThePaper(benchmark::State& state) {
  const runtime::Mission mission = runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml", {});
  runtime::FlightSummary summary = fly(mission, nullptr);
  if (!is_right(summary)) return state.SkipWithError("the flight is not the paper's");
  for (auto _ : state) benchmark::DoNotOptimize(summary = fly(mission, nullptr));
  report(state, summary);
}
BENCHMARK(FlyThePaper)->Unit(benchmark::kMillisecond);

void FlyAndRecordThePaper(benchmark::State& state) {
  const runtime::Mission mission = runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml", {});
  const fs::path out = fs::temp_directory_path() / ("vigil-flight-benchmark-" + std::to_string(::getpid()));
  runtime::FlightSummary summary;
  for (auto _ : state) {
    recording::BagRecorder recorder(out, runtime::mission_yaml(mission));
    summary = fly(mission, &recorder);
    state.PauseTiming();
    fs::remove_all(out);
    state.ResumeTiming();
  }
  if (!is_right(summary)) return state.SkipWithError("the flight is not the paper's");
  report(state, summary);
}
BENCHMARK(FlyAndRecordThePaper)->Unit(benchmark::kMillisecond);

/// 120 s of a recorded autopilot at 50 Hz. Set-up, which draws a map of 400 x 300 m, is a part of it.
void FlyTheVehicle(benchmark::State& state, const std::string& vehicle, const std::string& drones) {
  const runtime::Mission mission =
      runtime::load_mission(VIGIL_MISSIONS_DIR "/vehicles/" + vehicle + ".yaml",
                            std::vector<runtime::Override>{{"drone_grid.count", drones}, {"control.rate_hz", "50"}});
  runtime::FlightSummary summary = fly(mission, nullptr);
  if (!summary.complete || summary.last_percent > 10.0) return state.SkipWithError("nothing was covered");
  for (auto _ : state) benchmark::DoNotOptimize(summary = fly(mission, nullptr));
  report(state, summary);
}
BENCHMARK_CAPTURE(FlyTheVehicle, three_crazyflies, "crazyflie", "3")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FlyTheVehicle, ten_crazyflies, "crazyflie", "10")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FlyTheVehicle, three_arducopters, "arducopter", "3")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FlyTheVehicle, ten_arducopters, "arducopter", "10")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FlyTheVehicle, three_px4, "px4", "3")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FlyTheVehicle, ten_px4, "px4", "10")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vigil
