// How soon a look ahead is answered, from the question to the JSON, while its flight goes on in real time: a minute,
// both futures, other targets and a drone less. And how late the flight's ticks begin meanwhile. Median, p99, worst.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "vigil/adapters/console/preview_job.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/live_mission.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/preview_thread.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A thousand drones with 108 hectares and three places to watch.
constexpr const char* kThousand = R"(format: 1
name: thousand
field: {size_m: [1200, 900]}
targets:
  uniform_floor: 0.1
  clusters:
    - {name: camp, weight: 2, points_m: [[180, 180], [225, 150], [150, 225], [210, 225]]}
  areas:
    - {name: ridge, outline_m: [[120, 660], [450, 705], [420, 840], [150, 810]], weight: 6, soft_edge_m: 30}
    - {name: old-growth, outline_m: [[900, 180], [1110, 210], [1080, 600], [930, 540]], weight: 8, soft_edge_m: 30}
drone_grid: {count: 1000, prefix: d}
control: {rate_hz: 50, speed_limit_m_s: 5, memory_s: 1200}
safety: {separation_m: 3, contact_distance_m: 1, wall_distance_m: 10}
sensor: {footprint_radius_m: 25}
simulation:
  vehicle: {model: first_order_lag, lag_s: 0.8, acceleration_limit_m_s2: 8, altitude_m: 40}
  tracker: {noise_m: 0.3, velocity_noise_m_s: 0.05}
)";

runtime::Mission mission_of(int drones) {
  if (drones == 1000) return runtime::parse_mission(kThousand, "the benchmark's mission");
  return runtime::load_mission(VIGIL_MISSIONS_DIR "/vehicles/crazyflie.yaml", {});
}

/// Of the calling thread.
double cpu_s() {
  timespec time{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A mission in flight, and questions about what will become of it.
class Flown {
 public:
  explicit Flown(int drones) : mission_(mission_of(drones)) {
    auto fleet = apps::simulated_fleet(mission_);
    runtime::VirtualFleet* const world = fleet.get();
    flight_ = std::make_shared<runtime::LiveMission>(mission_, std::move(fleet), world, nullptr,
                                                     runtime::FlightStart{swarm::Intent::kCover, {}}, 1);
    const ergodic::Basis basis(runtime::swarm_parameters(mission_, swarm::Intent::kCover).field,
                               mission_.control.basis_max_index, mission_.control.basis_smoothness);
    target_ = runtime::coverage_target(mission_, basis);
    areas_.retarget(mission_, basis, *target_, 0.0);
    runtime::LiveCommand command;
    command.swarm = {.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = target_};
    is_ready_ = flight_->loop().submit({command});
    flight_->start();
    std::this_thread::sleep_for(1s);  // so that there is a past to go on from
  }

  /// Asks as the console does, on the thread that steps back for others. Whether it was answered rightly.
  [[nodiscard]] bool ask() {
    std::promise<bool> is_right;
    std::future<bool> answer = is_right.get_future();
    const bool is_asked = previews_.submit(1, [&](const std::atomic<bool>& cancelled) {
      const double before_s = cpu_s();
      const bool is_whole = is_answered(cancelled);
      used_s_ = cpu_s() - before_s;
      is_right.set_value(is_whole);
    });
    return is_asked && answer.get();
  }

  /// The processor's time of the last answer, s.
  [[nodiscard]] double used_s() const { return used_s_; }

  /// With both futures, a minute long, and their ghosts.
  [[nodiscard]] bool is_answered(const std::atomic<bool>& cancelled) const {
    console::PreviewJob job{1, flight_, areas_, 1, {}};
    job.question.without = {swarm::DroneId(1)};
    job.question.targets = mission_;
    job.question.targets->targets.clusters.front().weight = 9.0;
    const console::DeskNews news = console::answer_of(job, cancelled);
    const auto* const answer = std::get_if<console::PreviewNews>(&news);
    if (answer == nullptr || !is_ready_) return false;
    const std::string text = console::in_text(answer->answer);
    return answer->answer["what_if"]["in_s"].size() == 61 && text.find("\"ghosts\"") != std::string::npos;
  }

  [[nodiscard]] runtime::LatenessFigures lateness() const {
    runtime::ClockState clock;
    std::size_t version = 0;
    return flight_->loop().read(clock, version) ? clock.lateness : runtime::LatenessFigures{};
  }

 private:
  runtime::Mission mission_;
  std::shared_ptr<runtime::LiveMission> flight_;
  std::shared_ptr<const swarm::CoverageTarget> target_;  // the control thread must not be the last to let go of it
  runtime::AreaWatch areas_;
  bool is_ready_ = false;
  std::atomic<double> used_s_{0.0};
  runtime::PreviewThread previews_;  // last: it ends first
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Each iteration is one answer.
void LookAMinuteAhead(benchmark::State& state) {
  Flown flown(static_cast<int>(state.range(0)));
  std::vector<double> took_ms;
  std::vector<double> used_ms;
  for (auto _ : state) {
    const Clock::time_point before = Clock::now();
    if (!flown.ask()) return state.SkipWithError("no answer, or not the whole of it");
    took_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - before).count());
    used_ms.push_back(1000.0 * flown.used_s());
  }
  state.counters["cpu_median_ms"] = quantile(used_ms, 0.5);
  state.counters["median_ms"] = quantile(took_ms, 0.5);
  state.counters["p99_ms"] = quantile(took_ms, 0.99);
  state.counters["worst_ms"] = quantile(took_ms, 1.0);
}
BENCHMARK(LookAMinuteAhead)->ArgName("drones")->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Each iteration is ten seconds of flight, alone or beside a thread that looks ahead all the time. The flight's
/// control thread has real-time priority where the system allows it.
void Fly(benchmark::State& state) {
  Flown flown(static_cast<int>(state.range(0)));
  const bool looks_ahead = state.range(1) != 0;
  std::size_t answers = 0;
  for (auto _ : state) {
    const Clock::time_point end = Clock::now() + 10s;
    while (Clock::now() < end) {
      if (!looks_ahead)
        std::this_thread::sleep_until(end);
      else if (flown.ask())
        ++answers;
    }
  }
  const runtime::LatenessFigures late = flown.lateness();
  if (late.ticks == 0 || looks_ahead != (answers > 0)) return state.SkipWithError("nothing was measured");
  state.counters["answers"] = static_cast<double>(answers);
  state.counters["late_p50_us"] = late.p50_us;
  state.counters["late_p99_us"] = late.p99_us;
  state.counters["late_p999_us"] = late.p999_us;
}
BENCHMARK(Fly)
    ->ArgNames({"drones", "looks_ahead"})
    ->ArgsProduct({{10, 1000}, {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace vigil
