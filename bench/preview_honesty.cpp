// What previews promise, against what then happens, on 20 random missions without faults: prints the table of
// docs/preview.md.

#include "vigil/runtime/preview_honesty.hpp"

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

}  // namespace
}  // namespace vigil

int main() {
  using vigil::runtime::AreaPromise;
  constexpr std::size_t kMissions = 20;
  const auto cases = vigil::runtime::honesty_cases(
      kMissions, [](const vigil::runtime::Mission& mission) { return vigil::apps::simulated_fleet(mission); });
  fmt::print("| seed | drones | vehicle | covered in: foreseen / was, s | all seen in: foreseen / was, s |\n");
  fmt::print("| --- | --- | --- | --- | --- |\n");
  for (const vigil::runtime::HonestyCase& one : cases) vigil::print_case(one);
  fmt::print("\nmedian of the relative errors: covered {:.1f} %, seen {:.1f} %\n",
             100.0 * vigil::runtime::median_error(cases, &AreaPromise::covered),
             100.0 * vigil::runtime::median_error(cases, &AreaPromise::seen));
  return 0;
}
