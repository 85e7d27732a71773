#include "vigil/apps/replay_command.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

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
#include "vigil/runtime/velocity_reasons.hpp"

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
  if (const std::uint64_t missing = flight.recording().missing_ticks(); missing > 0)
    verdict.cannot = fmt::format("{} more ticks were kept, and are not there any more", missing);
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

/// Without what is not measured when a flight is flown again.
ordered_json rest_in_json(const runtime::FlightSummary& summary) {
  ordered_json json = runtime::to_json(summary);
  json.erase("tick_us");
  json.erase("worst_revisit_s");
  return json;
}

runtime::TwoFlights flown_on(const ReplayOptions& options, runtime::ReplayedFlight& flight,
                             const runtime::Mission& mission, const runtime::ChangedMission& changed,
                             runtime::VirtualFleet& fleet, runtime::Recorder* recorder) {
  try {
    return runtime::fly_on(flight, mission, changed, *options.from_s, fleet, recorder);
  } catch (const std::invalid_argument& error) {
    throw Failure(kBadInput, fmt::format("--from: {}", error.what()));
  }
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
  const runtime::TwoFlights two = flown_on(options, flight, mission, changed, *fleet, recorder ? &*recorder : nullptr);
  if (recorder) recorder->finish();
  if (options.json)
    fmt::print("{}\n", ordered_json{{"from_s", two.from_s},
                                    {"happened", rest_in_json(two.happened)},
                                    {"would_have", rest_in_json(two.would_have)}}
                           .dump(2));
  else
    print_for_people(two);
  return kDone;
}

swarm::DroneId drone_named(const std::string& id, const runtime::Mission& mission) {
  for (std::size_t i = 0; i < mission.drones.size(); ++i)
    if (mission.drones[i].id == id) return swarm::DroneId(i);
  throw Failure(kBadInput, fmt::format("--why {}: no drone of this recording is called that; its first is {}", id,
                                       mission.drones.front().id));
}

/// To the newest tick at or before a moment, or to the end.
void go_to(runtime::ReplayedFlight& flight, std::optional<double> at_s) {
  const double half_a_tick_s = 0.5 * flight.recording().head().parameters.dt_s;
  while (flight.number() == 0 || !at_s || flight.snapshot().time_s + half_a_tick_s < *at_s)
    if (!flight.step()) break;
  if (flight.number() == 0) throw Failure(kComponentFailed, "the recording has no complete tick");
  const double end_s = flight.snapshot().time_s;
  if (at_s && end_s + half_a_tick_s < *at_s)
    throw Failure(kBadInput, fmt::format("--at {:g}: the recording ends at {:g} s", *at_s, end_s));
  if (!flight.is_recomputed())
    throw Failure(kComponentFailed,
                  "this moment cannot be recomputed: not every tick before it was kept (see --verify)");
}

int print_reasons(const ReplayOptions& options, runtime::ReplayedFlight& flight, const runtime::Mission& mission) {
  const swarm::DroneId drone = drone_named(options.why, mission);
  go_to(flight, options.at_s);
  if (options.json)
    fmt::print("{}\n", runtime::velocity_reasons_json(flight.state(), drone, mission).dump(2));
  else
    fmt::print("{}", runtime::velocity_reasons(flight.state(), drone, mission));
  return kDone;
}

void check_moment(const char* option, std::optional<double> moment_s) {
  if (moment_s && !(*moment_s >= 0.0 && std::isfinite(*moment_s)))
    throw Failure(kBadInput, fmt::format("replay: {} {:g}: must be a moment of the recording, in seconds: 0 to its end",
                                         option, *moment_s));
}

void check(const ReplayOptions& options) {
  const int asked = (options.verify ? 1 : 0) + (options.from_s ? 1 : 0) + (options.why.empty() ? 0 : 1);
  if (asked > 1)
    throw Failure(kBadInput,
                  "replay: give one of --verify, --from T with --set key=value, --why DRONE with --at T, or none");
  if (options.at_s && options.why.empty()) throw Failure(kBadInput, "replay: --at T belongs to --why DRONE");
  check_moment("--from", options.from_s);
  check_moment("--at", options.at_s);
  const bool shows = asked == 0;
  if (!shows && options.asks_for_console)
    throw Failure(kBadInput,
                  "replay: --address, --port, --name, --tokens, --certificate, --key and --page are for seeing the "
                  "recording in a browser; leave them out with --verify, --from and --why");
  if ((shows && options.json) || (!options.from_s && (!options.settings.empty() || !options.out.empty())))
    throw Failure(kBadInput,
                  "replay: --set and --out belong to --from T, --json to --verify, --from or --why; give one of these, "
                  "or leave them out to see the recording in a browser");
}

}  // namespace

int replay(const ReplayOptions& options, const std::string& version) {
  check(options);
  if (!options.verify && !options.from_s && options.why.empty())
    return replay_in_console(options.directory, options.console, version);
  ChosenRecording chosen = choose_recording(options.directory);
  const runtime::Mission& mission = chosen.mission;
  runtime::ReplayedFlight flight(std::move(chosen.recording));
  if (!options.why.empty()) return print_reasons(options, flight, mission);
  return options.from_s ? print_two_flights(options, flight, mission) : print_verdict(options, flight, mission);
}

}  // namespace vigil::apps
