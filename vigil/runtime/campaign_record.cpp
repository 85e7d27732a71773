#include "vigil/runtime/campaign_record.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vigil::runtime {
namespace {

bool is_harmless(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("_-./:=,+@%").find(c) != std::string_view::npos;
}

std::string in_words(const Override& setting) { return setting.key + "=" + setting.value; }

}  // namespace

std::string shell_quoted(std::string_view word) {
  if (!word.empty() && std::ranges::all_of(word, is_harmless)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string repeat_command(const CampaignRun& run, std::string_view folder) {
  std::string command = fmt::format("vigil simulate {}", shell_quoted(fmt::format("{}/mission.yaml", folder)));
  for (const Override& setting : run.settings) command += " --set " + shell_quoted(in_words(setting));
  return command + " --out " + shell_quoted(fmt::format("{}/run-{:06}", folder, run.number));
}

std::string record_line(const CampaignRun& run, std::string_view command, const FlightSummary& summary) {
  nlohmann::ordered_json settings = nlohmann::ordered_json::array();
  for (const Override& setting : run.settings) settings.push_back(in_words(setting));
  const nlohmann::ordered_json line{{"run", run.number},
                                    {"seed", run.seed},
                                    {"settings", settings},
                                    {"command", command},
                                    {"summary", to_json(summary)}};
  // A path may be any bytes; JSON is UTF-8.
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<RunRecord> parse_record(std::string_view line) {
  auto parsed = nlohmann::json::parse(line, nullptr, false);
  try {
    RunRecord record;
    parsed.at("run").get_to(record.number);
    parsed.at("command").get_to(record.command);
    record.summary = std::move(parsed.at("summary"));
    if (!record.summary.is_object()) return std::nullopt;
    return record;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace vigil::runtime
