#include "vigil/runtime/flight_summary.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/runtime/goal_throughput.hpp"
#include "vigil/runtime/mission_description.hpp"

namespace vigil::runtime {
namespace {

/// Round times, and those at which something happens: where one would want to know how far coverage was.
std::vector<double> times_to_ask(const Mission& mission) {
  std::vector<double> times{1, 2, 5, 10, 20, 30, 40, 60, 90, 120, 180, 240, 300, 600, 900, 1200, 1800, 2700, 3600};
  for (double hours = 2.0; hours <= 48.0; ++hours) times.push_back(3600.0 * hours);
  for (const EventEntry& event : mission.simulation.events) times.push_back(event.at_s);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// JSON has no infinity: what never was is null.
nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

SummaryBuilder::SummaryBuilder(const Mission& mission)
    : faults_(mission),
      ask_percent_at_s_(times_to_ask(mission)),
      asked_duration_s_(mission.simulation.duration_s),
      dt_s_(1.0 / mission.control.rate_hz) {
  if (mission.simulation.battery) summary_.energy.emplace();
  summary_.mission = mission.name;
  summary_.seed = mission.simulation.seed;
  summary_.drones = mission.drones.size();
  summary_.accounting = name_of(mission.control.accounting);
  summary_.controller = name_of(mission.control.controller);
  summary_.barrier = name_of(mission.safety.barrier);
}

void SummaryBuilder::begin_at(double from_s, std::optional<double> first_metric) {
  from_s_ = from_s;
  faults_.begin_at(from_s);
  summary_.first_metric = first_metric;
  while (next_ask_ < ask_percent_at_s_.size() && ask_percent_at_s_[next_ask_] < from_s - 0.5 * dt_s_) ++next_ask_;
}

void SummaryBuilder::add(const swarm::Snapshot& snapshot, double tick_us) {
  ++summary_.ticks;
  tick_times_.add(std::chrono::nanoseconds(std::llround(1e3 * tick_us)));
  if (snapshot.fallback) ++summary_.fallback_ticks;
  faults_.add(snapshot);
  if (summary_.energy) summary_.energy->add(snapshot);
  if (summary_.active.empty() || summary_.active.back().second != snapshot.active)
    summary_.active.emplace_back(snapshot.time_s, snapshot.active);
  if (!snapshot.has_metric) return;
  if (!summary_.first_metric) summary_.first_metric = snapshot.metric;
  summary_.last_metric = snapshot.metric;
  summary_.last_percent = snapshot.metric_percent;
  for (; next_ask_ < ask_percent_at_s_.size() && ask_percent_at_s_[next_ask_] <= snapshot.time_s + 0.5 * dt_s_;
       ++next_ask_)
    summary_.percent_at.emplace_back(ask_percent_at_s_[next_ask_], snapshot.metric_percent);
}

FlightSummary SummaryBuilder::finish(const AuditTotals& audit,
                                     std::vector<std::pair<std::string, double>> worst_revisit_s,
                                     const std::optional<GoalTally>& goals) const {
  FlightSummary summary = summary_;
  summary.audit = audit;
  summary.faults = faults_.alarms();
  summary.detections = faults_.detections();
  summary.false_alarms = faults_.false_alarms();
  summary.goals = goals;
  summary.worst_revisit_s = std::move(worst_revisit_s);
  summary.duration_s = static_cast<double>(summary.ticks) * dt_s_;
  const double end_s = from_s_ + summary.duration_s;
  const bool asks_for_the_end =
      next_ask_ < ask_percent_at_s_.size() && ask_percent_at_s_[next_ask_] <= end_s + 0.5 * dt_s_;
  if (summary.first_metric && asks_for_the_end)  // the last tick's velocities lead there
    summary.percent_at.emplace_back(ask_percent_at_s_[next_ask_], summary.last_percent);
  summary.complete = end_s >= asked_duration_s_ - 0.5 * dt_s_;
  const LatenessFigures tick_times = tick_times_.figures();
  summary.tick_us_p50 = tick_times.p50_us;
  summary.tick_us_p99 = tick_times.p99_us;
  summary.tick_us_max = tick_times.max_us;
  return summary;
}

namespace {

void add_goals(nlohmann::ordered_json& json, const FlightSummary& summary) {
  const GoalTally& goals = *summary.goals;
  json["goals_reached"] = goals.reached;
  json["goals_per_drone_minute"] =
      summary.duration_s > 0.0 ? goals_per_drone_minute(goals.reached, summary.drones, summary.duration_s) : 0.0;
  json["goals_all_there_s"] =
      goals.all_there_s ? nlohmann::ordered_json(*goals.all_there_s) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json to_json(const Detection& found) {
  using Json = nlohmann::ordered_json;
  Json json = {{"at_s", found.at_s}, {"befell", found.befell}, {"drone", found.drone}};
  if (!found.station.empty()) json["station"] = found.station;
  json["noticed_as"] = found.noticed_s ? Json(found.noticed_as) : Json(nullptr);
  json["noticed_s"] = found.noticed_s ? Json(*found.noticed_s) : Json(nullptr);
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const FlightSummary& summary) {
  using Json = nlohmann::ordered_json;
  Json percent_at = Json::object();
  for (const auto& [at_s, percent] : summary.percent_at) percent_at[fmt::format("{}", at_s)] = percent;
  Json revisit = Json::object();
  for (const auto& [area, worst_s] : summary.worst_revisit_s) revisit[area] = worst_s;
  Json faults = Json::object();
  for (const auto& [word, count] : summary.faults) faults[word] = count;
  Json detections = Json::array();
  for (const Detection& found : summary.detections) detections.push_back(to_json(found));
  Json active = Json::array();
  for (const auto& [at_s, count] : summary.active) active.push_back({at_s, count});
  const Json metric{{"first", summary.first_metric ? Json(*summary.first_metric) : Json(nullptr)},
                    {"last", summary.first_metric ? Json(summary.last_metric) : Json(nullptr)},
                    {"percent_last", summary.first_metric ? Json(summary.last_percent) : Json(nullptr)},
                    {"percent_at", percent_at}};
  Json json{{"mission", summary.mission},
            {"seed", summary.seed},
            {"duration_s", summary.duration_s},
            {"complete", summary.complete},
            {"ticks", summary.ticks},
            {"drones", summary.drones},
            {"metric", metric},
            {"min_separation_m",
             {{"airborne", finite_or_null(summary.audit.least.airborne_pair_m)},
              {"active", finite_or_null(summary.audit.least.active_pair_m)}}},
            {"min_wall_distance_m", finite_or_null(summary.audit.least.wall_m)},
            {"min_no_fly_distance_m", finite_or_null(summary.audit.least.no_fly_m)},
            {"max_speed_m_s", summary.audit.max_speed_m_s},
            {"separation_violations", summary.audit.separation_violations},
            {"wall_violations", summary.audit.wall_violations},
            {"no_fly_violations", summary.audit.no_fly_violations},
            {"speed_violations", summary.audit.speed_violations},
            {"fallback_ticks", summary.fallback_ticks},
            {"worst_revisit_s", revisit},
            {"faults", faults},
            {"detections", detections},
            {"false_alarms", summary.false_alarms},
            {"active", active},
            {"tick_us", {{"p50", summary.tick_us_p50}, {"p99", summary.tick_us_p99}, {"max", summary.tick_us_max}}},
            {"accounting", summary.accounting},
            {"controller", summary.controller},
            {"barrier", summary.barrier}};
  if (summary.energy) json["energy"] = summary.energy->to_json(summary.audit);
  if (summary.goals) add_goals(json, summary);
  return json;
}

}  // namespace vigil::runtime
