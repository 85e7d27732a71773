// What previews promise, against what then happens, on random missions without faults: prints the table of
// docs/preview.md. usage: preview_honesty [missions]   20 unless told

#include "vigil/runtime/preview_honesty.hpp"

#include <charconv>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "vigil/apps/fleet_choice.hpp"

namespace vigil {
namespace {

using runtime::AreaPromise;
using runtime::HonestyCase;
using runtime::Promise;

std::string in_words(const std::optional<double>& time_s) { return time_s ? fmt::format("{:.1f}", *time_s) : "–"; }

std::string in_words(const std::vector<AreaPromise>& promises, Promise AreaPromise::* which) {
  std::string text;
  for (const AreaPromise& promise : promises) {
    const Promise& one = promise.*which;
    text += fmt::format("{}{} / {}", text.empty() ? "" : ", ", in_words(one.foreseen_s), in_words(one.was_s));
  }
  return text;
}

void print_case(const HonestyCase& one) {
  const runtime::SimulationSection& simulation = one.mission.simulation;
  fmt::print("| {} | {} | {} | {} | {} |\n", one.seed, one.mission.drones.size(),
             dynamics::name_of(simulation.vehicle.model), in_words(one.promises, &AreaPromise::covered),
             in_words(one.promises, &AreaPromise::seen));
}

constexpr std::size_t kMostMissions = 2000;

/// The number of missions that the command line asks for; 0 where it is none of 1 to kMostMissions.
std::size_t missions_asked(int argc, char** argv) {
  if (argc == 1) return 20;
  std::size_t missions = 0;
  const char* end = argv[1] + std::strlen(argv[1]);
  const auto read = std::from_chars(argv[1], end, missions);
  return argc == 2 && read.ec == std::errc{} && read.ptr == end && missions <= kMostMissions ? missions : 0;
}

}  // namespace
}  // namespace vigil

int main(int argc, char** argv) {
  using vigil::runtime::AreaPromise;
  const std::size_t missions = vigil::missions_asked(argc, argv);
  if (missions == 0) {
    fmt::print(stderr, "usage: preview_honesty [missions]   1 to {}, 20 unless told\n", vigil::kMostMissions);
    return 2;
  }
  const auto cases = vigil::runtime::honesty_cases(
      missions, [](const vigil::runtime::Mission& mission) { return vigil::apps::simulated_fleet(mission); });
  fmt::print("| seed | drones | vehicle | covered in: foreseen / was, s | all seen in: foreseen / was, s |\n");
  fmt::print("| --- | --- | --- | --- | --- |\n");
  for (const vigil::runtime::HonestyCase& one : cases) vigil::print_case(one);
  fmt::print("\nmedian of the relative errors: covered {:.1f} %, seen {:.1f} %\n",
             100.0 * vigil::runtime::median_error(cases, &AreaPromise::covered),
             100.0 * vigil::runtime::median_error(cases, &AreaPromise::seen));
  return 0;
}
