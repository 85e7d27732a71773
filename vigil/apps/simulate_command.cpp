#include "vigil/apps/simulate_command.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/apps/interrupt.hpp"
#include "vigil/apps/progress_bar.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/apps/text_file.hpp"
#include "vigil/apps/thread_choice.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

std::chrono::nanoseconds now() { return std::chrono::steady_clock::now().time_since_epoch(); }

void fly(runtime::VirtualFlight& flight) {
  ProgressBar progress("flying");
  while (!flight.is_over() && !is_interrupted()) {
    flight.step();
    const double share = static_cast<double>(flight.ticks_flown()) / static_cast<double>(flight.ticks_to_fly());
    if (flight.ticks_flown() % 50 == 0)
      progress.show(
          share, fmt::format("{:.0f} s, metric {:.2f} %", flight.snapshot().time_s, flight.snapshot().metric_percent));
  }
}

std::string metres(double value) { return std::isfinite(value) ? fmt::format("{:.3f} m", value) : std::string("-"); }

void print_for_people(const runtime::FlightSummary& summary, const fs::path& out) {
  const runtime::AuditTotals& audit = summary.audit;
  fmt::print("{}: {} drones, {:g} s{}\n", summary.mission, summary.drones, summary.duration_s,
             summary.complete ? "" : " (stopped before its time)");
  if (summary.first_metric) fmt::print("  ergodic metric     {:.2f} % of its first value\n", summary.last_percent);
  if (summary.goals) fmt::print("  goals reached      {}\n", summary.goals->reached);
  fmt::print("  least separation   {} airborne, {} active\n", metres(audit.least.airborne_pair_m),
             metres(audit.least.active_pair_m));
  fmt::print("  least wall         {}\n", metres(audit.least.wall_m));
  fmt::print("  fastest            {:.3f} m/s\n", audit.max_speed_m_s);
  fmt::print("  violations         {} separation, {} wall, {} no-fly, {} speed (by ground truth)\n",
             audit.separation_violations, audit.wall_violations, audit.no_fly_violations, audit.speed_violations);
  if (summary.energy) {
    const nlohmann::ordered_json energy = summary.energy->to_json(audit);
    fmt::print("  charging           {} charges, {:.2f} drones away on average, {} at most; {} ran empty in the air\n",
               energy["charges"].get<std::uint64_t>(), energy["mean_away"].get<double>(),
               energy["most_away"].get<std::uint64_t>(), energy["ran_empty"].get<std::uint64_t>());
  }
  fmt::print("  written to         {}\n  figures            vigil report {}\n", in_words(out), in_words(out));
}

}  // namespace

int simulate(const SimulateOptions& options) {
  const runtime::Mission mission = choose_mission(options.mission, options.settings, options.shorthands);
  create_results("--out", options.out);
  catch_interrupts();

  parallel::Workers workers(threads_for(mission.drones.size(), options.threads));
  const std::unique_ptr<runtime::VirtualFleet> fleet = simulated_fleet(mission, &workers);
  recording::BagRecorder recorder(options.out, runtime::mission_yaml(mission), recorder_options(options.recording));
  recorder.begin(mission, {runtime::first_intent(mission), {}});
  runtime::VirtualFlight flight(mission, *fleet, &recorder, now, &workers);
  fly(flight);
  recorder.finish();

  const runtime::FlightSummary summary = flight.summary();
  const std::string text = runtime::to_json(summary).dump(2) + "\n";
  write_whole(options.out / "summary.json", text);
  if (options.json)
    std::fputs(text.c_str(), stdout);
  else
    print_for_people(summary, options.out);
  if (summary.complete) return kDone;
  fmt::print(stderr, "vigil: stopped at {:g} s of {:g} s; what was flown is in {}\n", summary.duration_s,
             mission.simulation.duration_s, in_words(options.out));
  return kInterrupted;
}

}  // namespace vigil::apps
