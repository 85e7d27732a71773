#include "vigil/runtime/campaign_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/core/dynamics/random_stream.hpp"
#include "vigil/runtime/campaign_draws.hpp"
#include "vigil/runtime/flow_yaml.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

using dynamics::RandomStream;

constexpr int kFormat = 1;
constexpr std::uint64_t kMostDraws = 100;
/// Steps of the grid that uniform values are drawn on, so that they have few digits.
constexpr double kSteps = 1e6;

const std::string kName = "the campaign's mission";

/// Each kind of variation has a stream of its own, at each repetition another.
RandomStream stream(const CampaignPlan& plan, std::uint64_t number, VariationKind kind, std::uint64_t draw) {
  return {plan.seed, number, draw * 16 + static_cast<std::uint64_t>(kind)};
}

/// 53 bits: what every JSON reader keeps exact.
std::uint64_t seed_of_run(const CampaignPlan& plan, std::uint64_t number) {
  return stream(plan, number, VariationKind::kSeed, 0).next() >> 11U;
}

std::string draw_in_range(const Variation& variation, double share) {
  if (variation.is_whole) {
    const double count = std::floor(variation.high) - std::ceil(variation.low) + 1.0;
    return fmt::format("{:.0f}", std::ceil(variation.low) + std::min(std::floor(share * count), count - 1.0));
  }
  const double value = variation.low + (variation.high - variation.low) * std::round(share * kSteps) / kSteps;
  return fmt::format("{}", std::clamp(std::stod(fmt::format("{:.9g}", value)), variation.low, variation.high));
}

std::string draw_choice(const Variation& variation, double share) {
  const auto count = static_cast<double>(variation.choices.size());
  return variation.choices[static_cast<std::size_t>(std::min(share * count, count - 1.0))];
}

/// Values of keys; the first of what a run is made of, because places and times depend on them.
std::vector<Override> draw_values(const CampaignPlan& plan, RandomStream random) {
  std::vector<Override> settings;
  for (const Variation& variation : plan.variations) {
    if (variation.kind != VariationKind::kRange && variation.kind != VariationKind::kChoice) continue;
    const double share = random.uniform();
    const bool is_range = variation.kind == VariationKind::kRange;
    settings.push_back({variation.key, is_range ? draw_in_range(variation, share) : draw_choice(variation, share)});
  }
  return settings;
}

const Variation* find(const CampaignPlan& plan, VariationKind kind) {
  const auto found = std::ranges::find(plan.variations, kind, &Variation::kind);
  return found == plan.variations.end() ? nullptr : &*found;
}

/// False where no room was found.
bool add_starts(const Mission& mission, RandomStream random, std::vector<Override>& settings) {
  const std::optional<std::vector<Vec2>> starts = draw_starts(mission, random);
  if (!starts) return false;
  std::vector<DroneEntry> drones = mission.drones;
  for (std::size_t i = 0; i < drones.size(); ++i) drones[i].start_m = (*starts)[i];
  if (mission.drone_grid) settings.push_back({"drone_grid", "none"});
  settings.push_back({"drones", in_flow(drones)});
  return true;
}

bool add_targets(const Mission& mission, RandomStream random, std::vector<Override>& settings) {
  const auto clusters = draw_targets(mission, random);
  if (!clusters) return false;
  for (std::size_t i = 0; i < clusters->size(); ++i)
    settings.push_back({fmt::format("targets.clusters[{}].points_m", i), in_flow((*clusters)[i])});
  return true;
}

/// Beside the mission's own events.
void add_faults(const Mission& mission, const Variation& faults, RandomStream random, std::vector<Override>& settings) {
  std::vector<EventEntry> events = mission.simulation.events;
  std::ranges::copy(draw_incidents(mission, faults.incidents, faults.kinds, random), std::back_inserter(events));
  std::ranges::stable_sort(events, {}, &EventEntry::at_s);
  settings.push_back({"simulation.events", in_flow(events)});
}

/// Appends what is drawn once the values of keys are known. False where no room was found for it.
bool add_places_and_events(const CampaignPlan& plan, std::uint64_t number, std::uint64_t draw,
                           std::vector<Override>& settings) {
  const Variation* starts = find(plan, VariationKind::kStarts);
  const Variation* targets = find(plan, VariationKind::kTargets);
  const Variation* faults = find(plan, VariationKind::kFaults);
  if (starts == nullptr && targets == nullptr && faults == nullptr) return true;
  const Mission mission = parse_mission(plan.mission_yaml, kName, settings);
  const auto random = [&](VariationKind kind) { return stream(plan, number, kind, draw); };
  if (starts != nullptr && !add_starts(mission, random(VariationKind::kStarts), settings)) return false;
  if (targets != nullptr && !add_targets(mission, random(VariationKind::kTargets), settings)) return false;
  if (faults != nullptr) add_faults(mission, *faults, random(VariationKind::kFaults), settings);
  return true;
}

[[noreturn]] void give_up(std::uint64_t number, const std::string& last_refusal) {
  throw MissionError(
      {.place = fmt::format("run {}", number),
       .key = "--vary",
       .value = "",
       .problem = fmt::format("gave nothing that can be flown in {} draws; the last: {}", kMostDraws, last_refusal),
       .valid = "must lead to missions that `vigil check` accepts",
       .advice = "take narrower ranges, or fewer drones on a larger field"});
}

/// Nothing and the reason where the draw cannot be flown.
std::optional<CampaignRun> try_draw(const CampaignPlan& plan, std::uint64_t number, std::uint64_t draw,
                                    std::string& reason) {
  CampaignRun run{.number = number, .seed = seed_of_run(plan, number), .settings = {}, .mission = {}};
  try {
    run.settings = draw_values(plan, stream(plan, number, VariationKind::kRange, draw));
    if (!add_places_and_events(plan, number, draw, run.settings)) {
      reason = "there was no free place for a start or target";
      return std::nullopt;
    }
    run.settings.push_back({"simulation.seed", fmt::format("{}", run.seed)});
    run.mission = parse_mission(plan.mission_yaml, kName, run.settings);
    return run;
  } catch (const MissionError& error) {
    reason = error.what();
    return std::nullopt;
  }
}

[[noreturn]] void refuse_plan(const std::string& name, std::string problem) {
  throw MissionError({.place = name,
                      .key = "",
                      .value = "",
                      .problem = std::move(problem),
                      .valid = "must be the plan that a campaign wrote",
                      .advice = "name another directory"});
}

}  // namespace

std::string plan_json(const CampaignPlan& plan) {
  nlohmann::ordered_json vary = nlohmann::ordered_json::array();
  for (const Variation& variation : plan.variations) vary.push_back(variation.text);
  const nlohmann::ordered_json json{
      {"format", kFormat}, {"runs", plan.runs}, {"seed", plan.seed}, {"vary", vary}, {"mission", plan.mission_yaml}};
  return json.dump(2) + "\n";
}

CampaignPlan parse_plan(std::string_view json, const std::string& name) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  try {
    if (parsed.at("format") != kFormat) refuse_plan(name, "is of another format");
    CampaignPlan plan;
    parsed.at("runs").get_to(plan.runs);
    parsed.at("seed").get_to(plan.seed);
    parsed.at("mission").get_to(plan.mission_yaml);
    for (const auto& text : parsed.at("vary")) plan.variations.push_back(parse_variation(text.get<std::string>()));
    return plan;
  } catch (const nlohmann::json::exception&) {
    refuse_plan(name, "is no plan of a campaign");
  }
}

CampaignRun draw_run(const CampaignPlan& plan, std::uint64_t number) {
  std::string reason;
  for (std::uint64_t draw = 0; draw < kMostDraws; ++draw)
    if (std::optional<CampaignRun> run = try_draw(plan, number, draw, reason)) return std::move(*run);
  give_up(number, reason);
}

}  // namespace vigil::runtime
