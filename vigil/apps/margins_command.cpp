#include "vigil/apps/margins_command.hpp"

#include <array>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/mission_choice.hpp"
#include "vigil/runtime/mission_margins.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::apps {
namespace {

using Json = nlohmann::ordered_json;
using runtime::MarginParts;

struct Part {
  std::string_view name;
  std::string_view meaning;
  double MarginParts::* value;
};

constexpr std::array kParts = {
    Part{"model", "what the vehicle does unlike a lag, limits and predictions included", &MarginParts::model_m},
    Part{"delay", "how far delays are from their average", &MarginParts::delay_m},
    Part{"noise", "noise of positions and velocities", &MarginParts::noise_m},
    Part{"bias", "wandering errors of positions", &MarginParts::bias_m},
    Part{"gusts", "gusts that push", &MarginParts::gusts_m},
    Part{"swaps", "bodies taken for each other", &MarginParts::swaps_m},
};

/// What a mission needs, and what it is flown with.
struct Findings {
  runtime::Mission mission;
  runtime::MarginProblem problem;
  runtime::Margins margins;
  safety::BarrierParameters flown;
};

Findings find(const MarginsOptions& options) {
  Findings findings;
  findings.mission = choose_mission(options.mission, options.settings);
  if (findings.mission.safety.barrier == safety::BarrierKind::kPaper) {
    throw Failure(kBadInput,
                  "the barrier `paper` knows neither lag nor margin; try --set safety.barrier=lag_aware, with "
                  "safety.pair_gain=none and safety.wall_gain=none where the mission gives gains");
  }
  findings.problem = runtime::margin_problem(findings.mission);
  findings.margins = runtime::derive_margins(findings.problem);
  findings.flown = runtime::barrier_parameters(findings.mission);
  return findings;
}

std::string in_words(const Findings& findings) {
  const runtime::Margins& margins = findings.margins;
  const runtime::MarginProblem& problem = findings.problem;
  std::string text = fmt::format("{}: {}, at most {:.4g} m/s, {:.4g} Hz\n", findings.mission.name,
                                 dynamics::name_of(runtime::assumed_vehicle(findings.mission).kind), problem.u_max_m_s,
                                 1.0 / problem.dt_s);
  text += fmt::format("  {:<8} {:>9} {:>9}\n", "metres", "pair", "wall");
  for (const Part& part : kParts)
    text += fmt::format("  {:<8} {:9.3f} {:9.3f}   {}\n", part.name, margins.pair.*part.value, margins.wall.*part.value,
                        part.meaning);
  text += fmt::format("  {:<8} {:9.3f} {:9.3f}\n", "margin", margins.pair.total(), margins.wall.total());
  text += fmt::format(
      "\n  Orders act after {:.3g} s, positions are up to {:.3g} s old; both are made up for. Orders may stay away for "
      "{:.3g} s.\n",
      problem.command_delay_s, problem.observation_delay_s, problem.silence_s);
  text += fmt::format("  Flown with: R {:.4g} m (R_s {:.4g} m), sensing range {:.4g} m.\n",
                      safety::barrier_radius(findings.flown), findings.flown.separation_m,
                      findings.flown.sensing_range_m.value_or(safety::derived_sensing_range(findings.flown)));
  return text;
}

/// Four digits say it as well, upwards where more is safer.
std::string yaml_lines(const Findings& findings) {
  const runtime::Margins& margins = findings.margins;
  return fmt::format(
      "\nsafety:  # as derived; what is left out is derived anew\n  lag_s: {:.4g}\n  margin_m: {:.4f}\n  "
      "pair_margin_m: {:.4f}\n  pair_gain: {:.4g}\n  wall_gain: {:.4g}\n  command_delay_s: {:.4g}\n  "
      "observation_delay_s: {:.4g}\n",
      margins.lag_s, margins.wall.total() + 5e-5, margins.pair.total() + 5e-5, margins.pair_gain, margins.wall_gain,
      findings.problem.command_delay_s, findings.problem.observation_delay_s);
}

Json parts_json(const MarginParts& parts) {
  Json json;
  for (const Part& part : kParts) json[fmt::format("{}_m", part.name)] = parts.*part.value;
  json["total_m"] = parts.total();
  return json;
}

Json json_of(const Findings& findings) {
  const runtime::Margins& margins = findings.margins;
  return {
      {"mission", findings.mission.name},
      {"vehicle", dynamics::name_of(runtime::assumed_vehicle(findings.mission).kind)},
      {"lag_s", margins.lag_s},
      {"pair_gain", margins.pair_gain},
      {"wall_gain", margins.wall_gain},
      {"command_delay_s", findings.problem.command_delay_s},
      {"observation_delay_s", findings.problem.observation_delay_s},
      {"silence_s", findings.problem.silence_s},
      {"pair", parts_json(margins.pair)},
      {"wall", parts_json(margins.wall)},
      {"flown",
       {{"barrier_radius_m", safety::barrier_radius(findings.flown)},
        {"pair_margin_m", findings.flown.pair_margin_m},
        {"margin_m", findings.flown.margin_m},
        {"sensing_range_m", findings.flown.sensing_range_m.value_or(safety::derived_sensing_range(findings.flown))}}}};
}

}  // namespace

int margins(const MarginsOptions& options) {
  const Findings findings = find(options);
  const std::string text = options.json ? json_of(findings).dump(2) + "\n" : in_words(findings) + yaml_lines(findings);
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace vigil::apps
