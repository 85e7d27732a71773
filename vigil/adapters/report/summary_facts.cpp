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

void add_count(Rows& rows, const Summary& summary, const char* what, const char* path) {
  if (const auto count = summary.number(path)) rows.push_back({what, fmt::format("{:g}", *count), "0"});
}

Rows safety_rows(const FlightData& data, const Summary& summary) {
  const runtime::SafetySection& safety = data.mission.safety;
  const auto distance = [&](const char* path, double runtime::Clearances::* recorded) {
    return metres(summary.number(path).value_or(recorded_least(data, recorded)));
  };
  Rows rows{{"", "least or most", "asked for"},
            {"between active drones", distance("/min_separation_m/active", &runtime::Clearances::active_pair_m),
             metres(safety.separation_m)},
            {"between drones in the air", distance("/min_separation_m/airborne", &runtime::Clearances::airborne_pair_m),
             metres(safety.separation_m)},
            {"to the border", distance("/min_wall_distance_m", &runtime::Clearances::wall_m),
             metres(safety.wall_distance_m)}};
  if (!data.mission.no_fly.empty()) {
    rows.push_back({"to no-fly areas", distance("/min_no_fly_distance_m", &runtime::Clearances::no_fly_m),
                    metres(safety.no_fly_buffer_m.value_or(safety.wall_distance_m))});
  }
  const auto speed = summary.number("/max_speed_m_s");
  rows.push_back({speed ? "speed" : "speed asked for", fmt::format("{:.4g} m/s", speed.value_or(fastest_command(data))),
                  fmt::format("{:.4g} m/s", data.mission.control.speed_limit_m_s)});
  add_count(rows, summary, "violations of the distance between drones in the air", "/separation_violations");
  add_count(rows, summary, "violations of the distance to the border", "/wall_violations");
  add_count(rows, summary, "violations of no-fly areas", "/no_fly_violations");
  add_count(rows, summary, "violations of the speed limit", "/speed_violations");
  rows.push_back(
      {"ticks with a least-violation fall-back",
       fmt::format("{:g}", summary.number("/fallback_ticks").value_or(static_cast<double>(recorded_fallbacks(data)))),
       "0"});
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
            {fmt::format("longest that part of '{}' went unseen", area), fmt::format("{:.3g} s", worst.get<double>())});
    }
  }
  return rows;
}

Rows timing_rows(const FlightData& data, const Summary& summary) {
  Rows rows{{"", "value"},
            {"recorded", fmt::format("{:.4g} s in {} ticks", data.end_s() - data.time_s(0), data.ticks())},
            {"control rate", fmt::format("{:g} Hz", data.mission.control.rate_hz)}};
  for (const char* name : {"p50", "p99", "max"}) {
    const std::string path = fmt::format("/tick_us/{}", name);
    if (const auto us = summary.number(path.c_str()))
      rows.push_back({fmt::format("one tick, {}", name), fmt::format("{:.3g} us", *us)});
  }
  return rows;
}

std::vector<SummaryFacts::Tile> tiles_of(const FlightData& data, const Summary& summary) {
  const auto distance = [&](const char* path, double runtime::Clearances::* recorded) {
    return metres(summary.number(path).value_or(recorded_least(data, recorded)));
  };
  std::vector<SummaryFacts::Tile> tiles{
      {percent_text(data, summary), "metric at the end, of its first value"},
      {distance("/min_separation_m/active", &runtime::Clearances::active_pair_m),
       fmt::format("nearest two active drones (R_s = {:g} m)", data.mission.safety.separation_m)},
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
        fmt::format("This recording is partial: {}. It is read up to its last complete tick, at {:.4g} s.",
                    data.flight.incomplete_reason, data.end_s()));
  }
  const Json* complete = summary.at("/complete");
  if (complete != nullptr && complete->is_boolean() && !complete->get<bool>()) {
    warnings.push_back(fmt::format("The flight was stopped before its time, at {:.4g} of {:.4g} s.", data.end_s(),
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
  return {tiles_of(data, summary), safety_rows(data, summary), coverage_rows(data, summary), timing_rows(data, summary),
          warnings_of(data, summary, summary_json.has_value())};
}

}  // namespace vigil::report
