#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "vigil/runtime/campaign_plan.hpp"
#include "vigil/runtime/flight_summary.hpp"

/// One finished run of a campaign: a line of runs.jsonl.
namespace vigil::runtime {

/// The command that flies a run again and records it: `vigil simulate DIR/mission.yaml --set ... --out DIR/run-000123`,
/// quoted for a POSIX shell. `folder` is the campaign's directory as its caller named it, with the plan's mission in
/// it.
[[nodiscard]] std::string repeat_command(const CampaignRun& run, std::string_view folder);

/// One line of JSON, without its end: run, seed, settings, command, summary.
[[nodiscard]] std::string record_line(const CampaignRun& run, std::string_view command, const FlightSummary& summary);

/// A line read back.
struct RunRecord {
  std::uint64_t number = 0;
  std::string command;
  nlohmann::json summary;
};

/// Nothing where the line is no record of a run.
[[nodiscard]] std::optional<RunRecord> parse_record(std::string_view line);

/// A word as a POSIX shell takes it for itself: in single quotes where it needs them.
[[nodiscard]] std::string shell_quoted(std::string_view word);

}  // namespace vigil::runtime
