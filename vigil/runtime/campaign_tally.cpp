#include "vigil/runtime/campaign_tally.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vigil::runtime {
namespace {

enum class WorstIs : std::uint8_t { kLeast, kMost };

/// A number of a run's summary that a campaign compares. Where the summary has an object there (a value per area), the
/// worst of its values counts; where it has null or nothing, the run has no such figure.
struct Figure {
  std::string_view key;    ///< in the campaign's summary
  std::string_view title;  ///< for people
  std::string_view place;  ///< JSON pointer into the run's summary
  WorstIs worst_is;
};

constexpr std::array<Figure, 11> kFigures{{
    {"metric_percent_last", "metric at the end, %", "/metric/percent_last", WorstIs::kMost},
    {"min_separation_airborne_m", "least separation, airborne, m", "/min_separation_m/airborne", WorstIs::kLeast},
    {"min_separation_active_m", "least separation, active, m", "/min_separation_m/active", WorstIs::kLeast},
    {"min_wall_distance_m", "least distance to walls, m", "/min_wall_distance_m", WorstIs::kLeast},
    {"min_no_fly_distance_m", "least distance to no-fly, m", "/min_no_fly_distance_m", WorstIs::kLeast},
    {"max_speed_m_s", "highest speed, m/s", "/max_speed_m_s", WorstIs::kMost},
    {"worst_revisit_s", "longest time unseen, s", "/worst_revisit_s", WorstIs::kMost},
    {"fallback_ticks", "ticks with fall-back", "/fallback_ticks", WorstIs::kMost},
    {"least_charge", "least charge in the air", "/energy/least_charge", WorstIs::kLeast},
    {"most_away", "most drones away to charge", "/energy/most_away", WorstIs::kMost},
    {"goals_per_drone_minute", "goals per drone and minute", "/goals_per_drone_minute", WorstIs::kLeast},
}};

struct RuleEntry {
  std::string_view key;    ///< in the campaign's summary
  std::string_view count;  ///< JSON pointer into a run's summary; nothing there is none
};

/// What a run must not do; the order is that of CampaignTally::broken_.
constexpr std::array<RuleEntry, 5> kRules{{{"separation", "/separation_violations"},
                                           {"wall", "/wall_violations"},
                                           {"no_fly", "/no_fly_violations"},
                                           {"speed", "/speed_violations"},
                                           {"empty", "/energy/ran_empty"}}};

/// So many of the runs with a violation are named.
constexpr std::size_t kMostNamed = 100;
constexpr std::size_t kSeparationFigure = 1;

bool is_worse(const Figure& figure, double value, double than) {
  return figure.worst_is == WorstIs::kLeast ? value < than : value > than;
}

std::optional<double> value_in(const Figure& figure, const nlohmann::json& summary) {
  const nlohmann::json::json_pointer place{std::string(figure.place)};
  if (!summary.contains(place)) return std::nullopt;
  const nlohmann::json& found = summary.at(place);
  if (found.is_number()) return found.get<double>();
  std::optional<double> worst;
  if (!found.is_object()) return worst;
  for (const nlohmann::json& value : found)
    if (value.is_number() && (!worst || is_worse(figure, value.get<double>(), *worst))) worst = value.get<double>();
  return worst;
}

/// The middle value, or the mean of the middle two. Precondition: not empty.
double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

CampaignTally::CampaignTally() : columns_(kFigures.size()), broken_(kRules.size()) {}

void CampaignTally::add(const RunRecord& record) {
  ++runs_;
  for (std::size_t i = 0; i < kFigures.size(); ++i)
    if (const std::optional<double> value = value_in(kFigures.at(i), record.summary)) add_figure(i, *value, record);
  add_violations(record);
}

void CampaignTally::add_figure(std::size_t figure, double value, const RunRecord& record) {
  Column& column = columns_[figure];
  column.values.push_back(value);
  const auto replaces = [&](const Worst& worst) {
    return is_worse(kFigures.at(figure), value, worst.value) || (value == worst.value && record.number < worst.run);
  };
  if (!column.worst || replaces(*column.worst)) column.worst = {value, record.number, record.command};
}

void CampaignTally::add_violations(const RunRecord& record) {
  bool is_any = false;
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    const nlohmann::json::json_pointer count{std::string(kRules.at(i).count)};
    if (!record.summary.contains(count)) continue;
    const nlohmann::json& found = record.summary.at(count);
    if (!found.is_number() || found.get<double>() <= 0.0) continue;
    ++broken_[i];
    is_any = true;
  }
  if (is_any) violators_.push_back(record.number);
}

nlohmann::ordered_json CampaignTally::to_json() const {
  std::vector<std::uint64_t> named = violators_;
  std::ranges::sort(named);
  if (named.size() > kMostNamed) named.resize(kMostNamed);
  nlohmann::ordered_json violations{{"runs", violating_runs()}};
  for (std::size_t i = 0; i < kRules.size(); ++i) violations[std::string(kRules.at(i).key)] = broken_[i];
  violations["first_runs"] = named;
  nlohmann::ordered_json figures = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    const Column& column = columns_[i];
    if (!column.worst) continue;
    figures[std::string(kFigures.at(i).key)] = {{"runs", column.values.size()},
                                                {"median", median(column.values)},
                                                {"worst", column.worst->value},
                                                {"run", column.worst->run},
                                                {"command", column.worst->command}};
  }
  return {{"flown", runs_}, {"violations", violations}, {"figures", figures}};
}

std::string CampaignTally::table() const {
  std::string text = fmt::format("  {:<32}{:>12}{:>12}{:>10}\n", "", "median", "worst", "of run");
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    const Column& column = columns_[i];
    if (!column.worst) continue;
    text += fmt::format("  {:<32}{:>12.4g}{:>12.4g}{:>10}\n", kFigures.at(i).title, median(column.values),
                        column.worst->value, column.worst->run);
  }
  text += fmt::format("  runs with a violation           {:>12} of {}", violating_runs(), runs_);
  text += fmt::format(" (separation {}, wall {}, no-fly {}, speed {}, empty battery {}; by ground truth)\n", broken_[0],
                      broken_[1], broken_[2], broken_[3], broken_[4]);
  return text;
}

std::string CampaignTally::worst_so_far() const {
  std::string text = fmt::format("{} with a violation", violating_runs());
  if (const std::optional<Worst>& worst = columns_[kSeparationFigure].worst)
    text += fmt::format(", least separation {:.3f} m (run {})", worst->value, worst->run);
  return text;
}

}  // namespace vigil::runtime
