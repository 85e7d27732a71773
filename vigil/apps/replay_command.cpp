#include "vigil/apps/replay_command.hpp"

#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/progress_bar.hpp"
#include "vigil/runtime/mission_file.hpp"
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

}  // namespace

int replay(const ReplayOptions& options) {
  runtime::ReplayedFlight flight(std::make_unique<recording::BagRecording>(options.directory));
  const runtime::FlightRecording& recording = flight.recording();
  const runtime::Mission mission = runtime::parse_mission(recording.head().mission_text,
                                                          (options.directory / "recording" / "mission.yaml").string());
  const Verdict verdict = verify(flight);
  if (options.json)
    fmt::print("{}\n", in_json(verdict, recording, mission).dump(2));
  else
    print_for_people(verdict, recording, mission);
  return verdict.holds() ? kDone : kCheckFailed;
}

}  // namespace vigil::apps
