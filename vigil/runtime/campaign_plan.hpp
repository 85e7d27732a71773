#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/runtime/campaign_variation.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_source.hpp"

namespace vigil::runtime {

/// Everything that defines the runs of a campaign. Two campaigns with equal plans have the same runs.
struct CampaignPlan {
  std::string mission_yaml;  ///< the effective mission (mission_writer.hpp) that the runs vary
  std::vector<Variation> variations;
  std::uint64_t seed = 1;
  std::uint64_t runs = 0;
  friend bool operator==(const CampaignPlan&, const CampaignPlan&) = default;
};

[[nodiscard]] std::string plan_json(const CampaignPlan& plan);
/// The plan that plan_json wrote. Throws MissionError, with `name` for the place, where the text is no plan.
[[nodiscard]] CampaignPlan parse_plan(std::string_view json, const std::string& name);

/// One run of a campaign.
struct CampaignRun {
  std::uint64_t number = 0;
  std::uint64_t seed = 0;          ///< simulation.seed
  std::vector<Override> settings;  ///< what makes this run's mission of the plan's, the seed too
  Mission mission;                 ///< checked like any file
};

/// Run `number` of a plan: a pure function of the two. Where the mission's checks refuse what was drawn, it is drawn
/// again, up to a hundred times; then MissionError says so, with the last refusal. Another variation of the plan does
/// not change what this one draws, but for such repetitions.
[[nodiscard]] CampaignRun draw_run(const CampaignPlan& plan, std::uint64_t number);

}  // namespace vigil::runtime
