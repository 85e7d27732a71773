#include "vigil/adapters/report/summary_facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vigil::report {
namespace {

using Json = nlohmann::ordered_json;  // times stay in their order
using Rows = std::vector<std::vector<std::string>>;

constexpr double kRounding = 1e-9;  // of positions, velocities and times: no violation
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// summary.json, or nothing of it. Every look-up is for something that may be missing or of another kind.
class Summary {
 public:
  explicit Summary(const std::optional<std::string>& text) {
    if (text) json_ = Json::parse(*text, nullptr, false);
  }
  [[nodiscard]] bool is_damaged() const { return json_.is_discarded() || (!json_.is_null() && !json_.is_object()); }
  [[nodiscard]] const Json* at(const char* path) const {
    const Json::json_pointer pointer(path);
    return json_.is_object() && json_.contains(pointer) ? &json_.at(pointer) : nullptr;
  }
  [[nodiscard]] std::optional<double> number(const char* path) const {
    const Json* value = at(path);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  }

 private:
  Json json_;
};

/// So many digits, and never an exponent for what is large.
std::string large(double value, int digits) {
  return std::abs(value) < std::pow(10.0, digits) ? fmt::format("{:.{}g}", value, digits)
                                                  : fmt::format("{:.0f}", value);
}

std::string metres(double value) { return std::isfinite(value) ? fmt::format("{:.4g} m", value) : "none"; }

double recorded_least(const FlightData& data, double runtime::Clearances::* distance) {
  double least = kInfinite;
  for (const runtime::Clearances& clearances : data.flight.ticks.clearances)
    least = std::min(least, clearances.*distance);
  return least;
}

double fastest_command(const FlightData& data) {
  double fastest = 0.0;
  for (const Vec2& u : data.commands) fastest = std::max(fastest, u.norm());
  return fastest;
}

std::uint64_t recorded_fallbacks(const FlightData& data) {
  return static_cast<std::uint64_t>(
      std::count(data.flight.ticks.fallback.begin(), data.flight.ticks.fallback.end(), 1));
}

std::string percent_text(const FlightData& data, const Summary& summary) {
  if (const auto percent = summary.number("/metric/percent_last")) return fmt::format("{:.3g} %", *percent);
  const double percent = data.flight.ticks.metric_percent.back();
  return std::isfinite(percent) ? fmt::format("{:.3g} %", percent) : "none";
}

std::string verdict_text(bool holds) { return holds ? "holds" : "does not hold"; }

void add_count(Rows& rows, const Summary& summary, const char* what, const char* path) {
  if (const auto count = summary.number(path))
    rows.push_back({what, fmt::format("{:g}", *count), "0", verdict_text(*count == 0.0)});
}

void add_fallbacks(Rows& rows, const FlightData& data, const Summary& summary) {
  const auto counted = summary.number("/fallback_ticks");
  const double fallbacks = counted.value_or(static_cast<double>(recorded_fallbacks(data)));
  const double ticks = (counted ? summary.number("/ticks") : std::nullopt).value_or(static_cast<double>(data.ticks()));
  rows.push_back({"ticks with a least-violation fall-back", fmt::format("{:.15g}", fallbacks), "0",
                  fallbacks == 0.0 ? verdict_text(true)
                                   : fmt::format("does not hold in {:.15g} of {:.15g} ticks", fallbacks, ticks)});
}

/// "between drones", its least distance, the bound, and whether it is kept.
std::vector<std::string> distance_row(const char* what, double least_m, double bound_m) {
  return {what, metres(least_m), metres(bound_m),
          std::isfinite(least_m) ? verdict_text(least_m >= bound_m - kRounding) : ""};
}

Rows safety_rows(const FlightData& data, const Summary& summary) {
  const runtime::SafetySection& safety = data.mission.safety;
  const auto least = [&](const char* path, double runtime::Clearances::* recorded) {
    return summary.number(path).value_or(recorded_least(data, recorded));
  };
  Rows rows{
      {"", "least or most", "asked for", "verdict"},
      distance_row("between active drones", least("/min_separation_m/active", &runtime::Clearances::active_pair_m),
                   safety.separation_m),
      distance_row("between drones in the air",
                   least("/min_separation_m/airborne", &runtime::Clearances::airborne_pair_m), safety.separation_m),
      distance_row("to the border", least("/min_wall_distance_m", &runtime::Clearances::wall_m),
                   safety.wall_distance_m)};
  if (!data.mission.no_fly.empty()) {
    rows.push_back(distance_row("to no-fly areas", least("/min_no_fly_distance_m", &runtime::Clearances::no_fly_m),
                                safety.no_fly_buffer_m.value_or(safety.wall_distance_m)));
  }
  const auto measured_speed = summary.number("/max_speed_m_s");
  const double speed = measured_speed.value_or(fastest_command(data));
  const double limit = data.mission.control.speed_limit_m_s;
  rows.push_back({measured_speed ? "speed" : "speed asked for", fmt::format("{:.4g} m/s", speed),
                  fmt::format("{:.4g} m/s", limit), verdict_text(speed <= limit + kRounding)});
  add_count(rows, summary, "violations of the distance between drones in the air", "/separation_violations");
  add_count(rows, summary, "violations of the distance to the border", "/wall_violations");
  add_count(rows, summary, "violations of no-fly areas", "/no_fly_violations");
  add_count(rows, summary, "violations of the speed limit", "/speed_violations");
  add_fallbacks(rows, data, summary);
  return rows;
}

Rows coverage_rows(const FlightData& data, const Summary& summary) {
  Rows rows{{"", "value"}, {"metric at the end, of its first value", percent_text(data, summary)}};
  if (const auto first = summary.number("/metric/first"))
    rows.push_back({"first metric", fmt::format("{:.4g}", *first)});
  if (const auto last = summary.number("/metric/last")) rows.push_back({"last metric", fmt::format("{:.4g}", *last)});
  if (const Json* at = summary.at("/metric/percent_at"); at != nullptr && at->is_object()) {
    for (const auto& [time, percent] : at->items()) {
      if (percent.is_number())
        rows.push_back({fmt::format("metric at {} s", time), fmt::format("{:.3g} %", percent.get<double>())});
    }
  }
  if (const Json* revisit = summary.at("/worst_revisit_s"); revisit != nullptr && revisit->is_object()) {
    for (const auto& [area, worst] : revisit->items()) {
      if (worst.is_number())
        rows.push_back(
            {fmt::format("longest that part of '{}' went unseen", area), large(worst.get<double>(), 3) + " s"});
    }
  }
  return rows;
}

Finding deadline(const Summary& summary, const std::string& name, double asked_s) {
  Finding finding{fmt::format("No part of '{}' goes unseen for more than {} s.", name, large(asked_s, 4)),
                  fmt::format("Asked: {} s. The worst is not known: summary.json does not tell it.", large(asked_s, 4)),
                  Verdict::kNotTested, Source::kMission};
  const Json* all = summary.at("/worst_revisit_s");
  if (all == nullptr || !all->is_object() || !all->contains(name) || !all->at(name).is_number()) return finding;
  const double worst_s = all->at(name).get<double>();
  finding.measured = fmt::format("Asked: {} s. Worst: {} s.", large(asked_s, 4), large(worst_s, 4));
  finding.verdict = worst_s <= asked_s + kRounding ? Verdict::kHolds : Verdict::kDiffers;
  return finding;
}

std::vector<Finding> deadlines_of(const FlightData& data, const Summary& summary) {
  std::vector<Finding> findings;
  for (const runtime::ClusterEntry& cluster : data.mission.targets.clusters)
    if (cluster.revisit_s) findings.push_back(deadline(summary, cluster.name, *cluster.revisit_s));
  for (const runtime::AreaEntry& area : data.mission.targets.areas)
    if (area.revisit_s) findings.push_back(deadline(summary, area.name, *area.revisit_s));
  return findings;
}

std::string text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// "cf1: drift at 20 s", "noticed after 0.4 s as not following".
std::vector<std::string> detection_row(const Json& found) {
  const auto seconds = [&](const char* key) { return large(found.at(key).get<double>(), 4); };
  const auto is_number = [&](const char* key) { return found.contains(key) && found.at(key).is_number(); };
  const auto in_words = [](std::string word) {
    std::ranges::replace(word, '_', ' ');
    return word;
  };
  const std::string when = is_number("at_s") ? fmt::format(" at {} s", seconds("at_s")) : "";
  const std::string what = fmt::format("{}: {}{}", text_at(found, "drone"), in_words(text_at(found, "befell")), when);
  if (!is_number("noticed_s")) return {what, "not noticed"};
  return {what, fmt::format("noticed after {} s as {}", seconds("noticed_s"), in_words(text_at(found, "noticed_as")))};
}

Rows fault_rows(const Summary& summary) {
  Rows rows;
  const Json* detections = summary.at("/detections");
  if (detections != nullptr && detections->is_array())
    for (const Json& found : *detections)
      if (found.is_object()) rows.push_back(detection_row(found));
  if (const Json* faults = summary.at("/faults"); faults != nullptr && faults->is_object())
    for (const auto& [word, count] : faults->items())
      if (count.is_number()) rows.push_back({"alarms: " + word, large(count.get<double>(), 3)});
  const double false_alarms = summary.number("/false_alarms").value_or(0.0);
  if (rows.empty() && false_alarms == 0.0) return {};
  rows.push_back({"alarms about drones that nothing befell", large(false_alarms, 3)});
  rows.insert(rows.begin(), {"", "value"});
  return rows;
}

Rows timing_rows(const FlightData& data, const Summary& summary) {
  Rows rows{{"", "value"},
            {"recorded", fmt::format("{} s in {} ticks", large(data.end_s() - data.time_s(0), 4), data.ticks())},
            {"control rate", fmt::format("{:g} Hz", data.mission.control.rate_hz)}};
  for (const char* name : {"p50", "p99", "max"}) {
    const std::string path = fmt::format("/tick_us/{}", name);
    if (const auto us = summary.number(path.c_str()))
      rows.push_back({fmt::format("one tick, {}", name), large(*us, 3) + " us"});
  }
  return rows;
}

std::vector<SummaryFacts::Tile> tiles_of(const FlightData& data, const Summary& summary) {
  const auto distance = [&](const char* path, double runtime::Clearances::* recorded) {
    return metres(summary.number(path).value_or(recorded_least(data, recorded)));
  };
  std::vector<SummaryFacts::Tile> tiles{
      {percent_text(data, summary), "metric at the end, of its first value"},
      {distance("/min_separation_m/airborne", &runtime::Clearances::airborne_pair_m),
       fmt::format("nearest two drones in the air (R_s = {:g} m)", data.mission.safety.separation_m)},
      {distance("/min_separation_m/active", &runtime::Clearances::active_pair_m), "nearest two active drones"},
      {distance("/min_wall_distance_m", &runtime::Clearances::wall_m),
       fmt::format("nearest to the border (R_wall = {:g} m)", data.mission.safety.wall_distance_m)},
      {fmt::format("{} of {}", data.flight.ticks.active.back(), data.drones()), "drones active at the end"}};
  if (const auto p99 = summary.number("/tick_us/p99"))
    tiles.push_back({fmt::format("{:.0f} us", *p99), "control tick, 99th percentile"});
  return tiles;
}

std::vector<std::string> warnings_of(const FlightData& data, const Summary& summary, bool has_summary) {
  std::vector<std::string> warnings;
  if (!data.flight.is_complete) {
    warnings.push_back(
        fmt::format("This recording is partial: {}. It is read up to its last complete tick, at {:.7g} s.",
                    data.flight.incomplete_reason, data.end_s()));
  }
  const Json* complete = summary.at("/complete");
  if (complete != nullptr && complete->is_boolean() && !complete->get<bool>()) {
    warnings.push_back(fmt::format("The flight was stopped before its time, at {:.7g} of {:.7g} s.", data.end_s(),
                                   data.mission.simulation.duration_s));
  }
  if (summary.is_damaged())
    warnings.push_back("summary.json cannot be read; the figures here are from the recording alone.");
  if (!has_summary) warnings.push_back("There is no summary.json; the figures here are from the recording alone.");
  if (!data.has_truth) {
    warnings.push_back(
        "There is no ground truth in this recording: distances are between the places that the controller believed "
        "in.");
  }
  return warnings;
}

}  // namespace

SummaryFacts summary_facts(const FlightData& data, const std::optional<std::string>& summary_json) {
  const Summary summary(summary_json);
  return {tiles_of(data, summary),
          safety_rows(data, summary),
          coverage_rows(data, summary),
          fault_rows(summary),
          timing_rows(data, summary),
          deadlines_of(data, summary),
          warnings_of(data, summary, summary_json.has_value())};
}

}  // namespace vigil::report
