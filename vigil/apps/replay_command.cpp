#include "vigil/apps/replay_command.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/apps/progress_bar.hpp"
#include "vigil/apps/recording_choice.hpp"
#include "vigil/apps/replay_console.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/runtime/fly_on.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/replayed_flight.hpp"

namespace vigil::apps {
namespace {

using nlohmann::ordered_json;

/// What came of recomputing.
struct Verdict {
  std::uint64_t same = 0;  ///< ticks that are
  std::optional<runtime::TickDifference> difference;
  std::string cannot;  ///< why the rest could not be recomputed; empty where it could

  [[nodiscard]] bool holds() const { return !difference && cannot.empty(); }
};

Verdict verify(runtime::ReplayedFlight& flight) {
  Verdict verdict;
  if (flight.recording().head().keep_every > 1) {
    verdict.cannot = fmt::format("only every {}th tick was kept", flight.recording().head().keep_every);
    return verdict;
  }
  ProgressBar progress("recomputing");
  while (flight.step()) {
    if (!flight.is_recomputed()) {
      verdict.cannot = fmt::format("ticks before {} at {:g} s are not in the recording",
                                   flight.recorded().snapshot.tick, flight.recorded().snapshot.time_s);
      return verdict;
    }
    verdict.difference = flight.difference();
    if (verdict.difference) return verdict;
    if (++verdict.same % 500 == 0)
      progress.show(static_cast<double>(verdict.same) / static_cast<double>(flight.tick_count()),
                    fmt::format("{:.0f} s", flight.snapshot().time_s));
  }
  return verdict;
}

std::string drone_of(const runtime::TickDifference& difference, const runtime::Mission& mission) {
  if (!difference.drone || *difference.drone >= mission.drones.size()) return {};
  return mission.drones[*difference.drone].id;
}

void print_for_people(const Verdict& verdict, const runtime::FlightRecording& recording,
                      const runtime::Mission& mission) {
  fmt::print("{}: {} of {} ticks recomputed, all of them the same\n", mission.name, verdict.same,
             recording.tick_count());
  if (!recording.incomplete_reason().empty()) fmt::print("  not whole: {}\n", recording.incomplete_reason());
  if (!verdict.cannot.empty()) fmt::print("  cannot be recomputed further: {}\n", verdict.cannot);
  if (!verdict.difference) return;
  const runtime::TickDifference& difference = *verdict.difference;
  const std::string drone = drone_of(difference, mission);
  fmt::print("  first difference   tick {}, {:g} s{}: {}\n", difference.tick, difference.time_s,
             drone.empty() ? "" : ", " + drone, difference.what);
  fmt::print("  recorded           {}\n", difference.recorded);
  if (!difference.recomputed.empty()) fmt::print("  recomputed         {}\n", difference.recomputed);
}

ordered_json in_json(const Verdict& verdict, const runtime::FlightRecording& recording,
                     const runtime::Mission& mission) {
  ordered_json result{{"mission", mission.name},
                      {"ticks", recording.tick_count()},
                      {"same", verdict.same},
                      {"holds", verdict.holds()},
                      {"incomplete", recording.incomplete_reason()},
                      {"cannot", verdict.cannot},
                      {"difference", nullptr}};
  if (verdict.difference)
    result["difference"] = {{"tick", verdict.difference->tick},
                            {"time_s", verdict.difference->time_s},
                            {"drone", drone_of(*verdict.difference, mission)},
                            {"what", verdict.difference->what},
                            {"recorded", verdict.difference->recorded},
                            {"recomputed", verdict.difference->recomputed}};
  return result;
}

int print_verdict(const ReplayOptions& options, runtime::ReplayedFlight& flight, const runtime::Mission& mission) {
  const runtime::FlightRecording& recording = flight.recording();
  const Verdict verdict = verify(flight);
  if (options.json)
    fmt::print("{}\n", in_json(verdict, recording, mission).dump(2));
  else
    print_for_people(verdict, recording, mission);
  return verdict.holds() ? kDone : kCheckFailed;
}

std::string metres(double value) { return std::isfinite(value) ? fmt::format("{:.3f} m", value) : std::string("-"); }

void print_for_people(const runtime::TwoFlights& two) {
  const auto line = [](const char* what, const std::string& happened, const std::string& would_have) {
    fmt::print("  {:<24} {:>14} {:>14}\n", what, happened, would_have);
  };
  const runtime::FlightSummary& a = two.happened;
  const runtime::FlightSummary& b = two.would_have;
  const auto number = [](auto value) { return fmt::format("{}", value); };
  fmt::print("{}, from {:g} s on for {:g} s\n", a.mission, two.from_s, a.duration_s);
  line("", "happened", "would have");
  line("metric at the end", fmt::format("{:.3g}", a.last_metric), fmt::format("{:.3g}", b.last_metric));
  line("of its first value", fmt::format("{:.2f} %", a.last_percent), fmt::format("{:.2f} %", b.last_percent));
  line("least separation", metres(a.audit.least.airborne_pair_m), metres(b.audit.least.airborne_pair_m));
  line("least wall", metres(a.audit.least.wall_m), metres(b.audit.least.wall_m));
  line("fastest", fmt::format("{:.3f} m/s", a.audit.max_speed_m_s), fmt::format("{:.3f} m/s", b.audit.max_speed_m_s));
  line("separation violations", number(a.audit.separation_violations), number(b.audit.separation_violations));
  line("wall violations", number(a.audit.wall_violations), number(b.audit.wall_violations));
  line("no-fly violations", number(a.audit.no_fly_violations), number(b.audit.no_fly_violations));
  line("ticks with fall-back", number(a.fallback_ticks), number(b.fallback_ticks));
}

int print_two_flights(const ReplayOptions& options, runtime::ReplayedFlight& flight, const runtime::Mission& mission) {
  std::vector<runtime::Override> overrides;
  for (const std::string& setting : options.settings) overrides.push_back(runtime::parse_override(setting));
  const auto changed = [&overrides](const runtime::Mission& with_targets) {
    return runtime::parse_mission(runtime::mission_yaml(with_targets), "the recorded mission", overrides);
  };
  std::optional<recording::BagRecorder> recorder;
  if (!options.out.empty()) {
    create_results("--out", options.out);
    recorder.emplace(options.out, runtime::mission_yaml(changed(mission)));
  }
  const auto fleet = simulated_fleet(mission);
  const runtime::TwoFlights two =
      runtime::fly_on(flight, mission, changed, *options.from_s, *fleet, recorder ? &*recorder : nullptr);
  if (recorder) recorder->finish();
  if (options.json)
    fmt::print("{}\n", ordered_json{{"from_s", two.from_s},
                                    {"happened", runtime::to_json(two.happened)},
                                    {"would_have", runtime::to_json(two.would_have)}}
                           .dump(2));
  else
    print_for_people(two);
  return kDone;
}

}  // namespace

int replay(const ReplayOptions& options, const std::string& version) {
  if (options.verify && options.from_s)
    throw Failure(kBadInput, "replay: give either --verify, or --from T with --set key=value, or neither");
  const bool shows = !options.verify && !options.from_s;
  if (shows && (options.json || !options.settings.empty() || !options.out.empty()))
    throw Failure(kBadInput,
                  "replay: --set and --out belong to --from T, --json to --verify or --from; give one of these, or "
                  "leave them out to see the recording in a browser");
  if (shows) return replay_in_console(options.directory, options.console, version);
  ChosenRecording chosen = choose_recording(options.directory);
  const runtime::Mission& mission = chosen.mission;
  runtime::ReplayedFlight flight(std::move(chosen.recording));
  return options.from_s ? print_two_flights(options, flight, mission) : print_verdict(options, flight, mission);
}

}  // namespace vigil::apps
