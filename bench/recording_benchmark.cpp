// How long it takes to fly a recording again: every tick read, recomputed and compared, as `vigil replay --verify` does
// it. One core.

#include <cmath>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/replayed_flight.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone afterwards.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("vigil-recording-benchmark-" + std::to_string(::getpid()))) {}
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void fly(const runtime::Mission& mission, runtime::Recorder& recorder) {
  const auto fleet = apps::simulated_fleet(mission);
  recorder.begin(mission, {runtime::first_intent(mission), {}});
  runtime::VirtualFlight flight(mission, *fleet, &recorder, [] { return std::chrono::nanoseconds{}; });
  while (!flight.is_over()) flight.step();
  recorder.finish();
}

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

/// How many ticks were the same; 0 at the first that was not.
std::uint64_t verified(const fs::path& folder) {
  runtime::ReplayedFlight flight(std::make_unique<recording::BagRecording>(folder));
  while (flight.step())
    if (!flight.is_recomputed() || flight.difference()) return 0;
  return flight.number();
}

/// Without recomputing and comparing: what of it is reading.
void read_only(const fs::path& folder) {
  recording::BagRecording recording(folder);
  runtime::RecordedTick tick(recording.head().parameters.drones);
  for (std::uint64_t n = 0; n < recording.tick_count(); ++n) recording.read(n, tick);
}

void report(benchmark::State& state, const runtime::Mission& mission, const fs::path& folder) {
  const double seconds = mission.simulation.duration_s;
  state.counters["simulated_s"] = seconds;
  state.counters["times_real_time"] = benchmark::Counter(seconds, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["MB_per_hour"] = static_cast<double>(bytes_in(folder)) / 1e6 * 3600.0 / seconds;
}

/// Sixty seconds at 50 Hz of so many drones on a field that has room for them.
runtime::Mission swarm_of(int drones) {
  const double side_m = 3.0 * std::sqrt(drones);
  return runtime::parse_mission(
      fmt::format("format: 1\nname: swarm\nfield: {{size_m: [{0}, {0}]}}\n"
                  "targets: {{clusters: [{{name: here, points_m: [[{1}, {1}], [{2}, {1}]]}},"
                  " {{name: there, points_m: [[{2}, {2}]]}}]}}\n"
                  "drone_grid: {{count: {3}}}\n"
                  "control: {{speed_limit_m_s: 1}}\n"
                  "safety: {{separation_m: 0.5, wall_distance_m: 0.2}}\n"
                  "simulation: {{duration_s: 60, vehicle: {{model: first_order_lag, lag_s: 0.2}},"
                  " tracker: {{noise_m: 0.002}}}}\n",
                  side_m, 0.3 * side_m, 0.7 * side_m, drones),
      "the benchmark's mission");
}

/// The mission flown and recorded once, then `work` timed on it.
template <class Work>
void time_on(benchmark::State& state, const runtime::Mission& mission, const Work& work) {
  const Folder folder;
  recording::BagRecorder recorder(folder.path(), runtime::mission_yaml(mission));
  fly(mission, recorder);
  if (verified(folder.path()) == 0) return state.SkipWithError("the recording does not come out as it was flown");
  for (auto _ : state) work(folder.path());
  report(state, mission, folder.path());
}

void VerifyThePaper(benchmark::State& state) {
  time_on(state, runtime::load_mission(VIGIL_MISSIONS_DIR "/paper.yaml"),
          [](const fs::path& folder) { benchmark::DoNotOptimize(verified(folder)); });
}
BENCHMARK(VerifyThePaper)->Unit(benchmark::kMillisecond);

void Verify(benchmark::State& state) {
  time_on(state, swarm_of(static_cast<int>(state.range(0))),
          [](const fs::path& folder) { benchmark::DoNotOptimize(verified(folder)); });
}
BENCHMARK(Verify)->Unit(benchmark::kMillisecond)->Arg(3)->Arg(10)->Arg(100)->Arg(1000);

/// The part of it that is reading.
void Read(benchmark::State& state) { time_on(state, swarm_of(static_cast<int>(state.range(0))), read_only); }
BENCHMARK(Read)->Unit(benchmark::kMillisecond)->Arg(1000);

}  // namespace
}  // namespace vigil
