#include "vigil/adapters/report/findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace vigil::report {
namespace {

constexpr double kRounding = 1e-9;  // of positions and velocities: no violation
constexpr double kNearlyZeroPercent = 5.0;
constexpr double kLeastOverlap = 0.75;
constexpr double kLeastAttention = 0.7;  // of what a target, or all of them, asked for
constexpr double kLeastActivity = 0.5;   // of the mean speed before a loss

Verdict holds_if(bool condition) { return condition ? Verdict::kHolds : Verdict::kDiffers; }

/// The least of a distance over the flight, and when.
struct Least {
  double distance_m = std::numeric_limits<double>::infinity();
  double time_s = 0.0;
};

Least least_of(const FlightData& data, double runtime::Clearances::* distance) {
  Least least;
  for (std::size_t tick = 0; tick < data.ticks(); ++tick) {
    const double d = data.flight.ticks.clearances[tick].*distance;
    if (d < least.distance_m) least = {d, data.time_s(tick)};
  }
  return least;
}

/// NaN where there was never a metric.
double last_percent(const FlightData& data) {
  const std::vector<double>& percent = data.flight.ticks.metric_percent;
  const auto known = std::find_if(percent.rbegin(), percent.rend(), [](double p) { return std::isfinite(p); });
  return known == percent.rend() ? std::numeric_limits<double>::quiet_NaN() : *known;
}

Finding nearly_zero(const FlightData& data) {
  Finding finding{"As the drones keep monitoring, the metric goes close to zero.", "", Verdict::kNotTested};
  const double percent = last_percent(data);
  if (!std::isfinite(percent)) {
    finding.measured = "No drone covered anything: there is no metric.";
    return finding;
  }
  finding.measured =
      fmt::format("After {:.7g} s it is at {:.3g} % of its first value (at most {:.0f} % counts as close to zero).",
                  data.end_s(), percent, kNearlyZeroPercent);
  finding.verdict = holds_if(percent <= kNearlyZeroPercent);
  return finding;
}

Finding low_after_loss(const FlightData& data) {
  Finding finding{"Losing a drone leaves satisfying coverage: the survivors keep the metric close to zero.", "",
                  Verdict::kNotTested};
  const ActiveChange* loss = data.first_loss();
  if (loss == nullptr) {
    finding.measured = "No drone was lost in this flight.";
    return finding;
  }
  const double before = data.flight.ticks.metric_percent[loss->tick - 1];
  const double after = last_percent(data);
  finding.measured = fmt::format("{} at {:.7g} s: {:.3g} % just before, {:.3g} % at the end.", data.describe(*loss),
                                 data.time_s(loss->tick), before, after);
  finding.verdict = holds_if(after < before || after <= kNearlyZeroPercent);
  return finding;
}

/// Mean |u| of active drones from one kept tick up to another.
double mean_speed(const FlightData& data, std::size_t from, std::size_t to) {
  double sum = 0.0;
  double time = 0.0;
  for (std::size_t tick = from; tick < to; ++tick) {
    for (std::size_t i = 0; i < data.drones(); ++i) {
      const Vec2& u = data.commands[data.flight.row(tick, i)];
      if (!data.flight.is_active(tick, i) || !u.allFinite()) continue;
      sum += data.steps_s[tick] * u.norm();
      time += data.steps_s[tick];
    }
  }
  return time > 0.0 ? sum / time : 0.0;
}

Finding within_speed_limit(const FlightData& data) {
  const double limit = data.mission.control.speed_limit_m_s;
  double most = 0.0;
  std::size_t where = 0;
  for (std::size_t row = 0; row < data.commands.size(); ++row) {
    const double speed = data.commands[row].norm();
    if (speed > most) {
      most = speed;
      where = row;
    }
  }
  return {"Control inputs stay within the velocity limit.",
          fmt::format("The fastest was {:.4f} m/s ({}, {:.7g} s) with a limit of {:.4g} m/s.", most,
                      data.flight.drones[where % data.drones()], data.time_s(where / data.drones()), limit),
          holds_if(most <= limit + kRounding)};
}

Finding goes_on_after_loss(const FlightData& data) {
  Finding finding{"After a drone has failed the others go on monitoring.", "No drone was lost in this flight.",
                  Verdict::kNotTested};
  const ActiveChange* loss = data.first_loss();
  if (loss == nullptr) return finding;
  const double before = mean_speed(data, 0, loss->tick);
  const double after = mean_speed(data, loss->tick, data.ticks());
  finding.measured =
      fmt::format("Active drones were asked for {:.3f} m/s on average before {:.7g} s and for {:.3f} m/s from then on.",
                  before, data.time_s(loss->tick), after);
  finding.verdict = holds_if(after >= kLeastActivity * before && after > 0.0);
  return finding;
}

Finding drawn_to_targets(const FlightData& data, const CoverageMap& map) {
  Finding finding{"The swarm is drawn to the areas where the targets are dense.", "There were no targets at the end.",
                  Verdict::kNotTested};
  if (!map.has_targets()) return finding;
  const AttentionShare& elsewhere = map.shares.back();
  const double inside = 1.0 - elsewhere.achieved;
  const double area = 1.0 - elsewhere.area;
  const double asked = 1.0 - elsewhere.asked;
  finding.measured = fmt::format(
      "{:.0f} % of the active drones' time was spent around targets, on {:.0f} % of the field; the map asks for {:.0f} "
      "% (at least {:.0f} % of that counts).",
      100.0 * inside, 100.0 * area, 100.0 * asked, 100.0 * kLeastAttention);
  finding.verdict = data.mission.targets.uniform_floor >= 1.0
                        ? Verdict::kNotTested
                        : holds_if(inside > area && inside >= kLeastAttention * asked);
  return finding;
}

Finding keeps_from(const std::string& what, const Least& least, double bound_m, Source source) {
  if (!std::isfinite(least.distance_m)) return {};
  return {fmt::format("The drones keep away from {}.", what),
          fmt::format("The nearest was {:.4f} m at {:.7g} s; at least {:.4g} m are asked for.", least.distance_m,
                      least.time_s, bound_m),
          holds_if(least.distance_m >= bound_m - kRounding), source};
}

Finding active_keep_distance(const FlightData& data) {
  const double bound = data.mission.safety.separation_m;
  const Least least = least_of(data, &runtime::Clearances::active_pair_m);
  Finding finding{"Active drones always keep more than the safety distance between them.",
                  "There never were two active drones.", Verdict::kNotTested};
  if (!std::isfinite(least.distance_m)) return finding;
  finding.measured = fmt::format("The smallest distance was {:.4f} m at {:.7g} s, with R_s = {:.4g} m.",
                                 least.distance_m, least.time_s, bound);
  finding.verdict = holds_if(least.distance_m >= bound - kRounding);
  return finding;
}

Finding airborne_keep_distance(const FlightData& data) {
  const double bound = data.mission.safety.separation_m;
  const Least least = least_of(data, &runtime::Clearances::airborne_pair_m);
  Finding finding{"Drones that are in the air keep the safety distance, whether they are active or not.",
                  "There never were two drones in the air.", Verdict::kNotTested, Source::kMission};
  if (!std::isfinite(least.distance_m)) return finding;
  finding.measured = fmt::format("The smallest distance was {:.4f} m at {:.7g} s, with R_s = {:.4g} m.",
                                 least.distance_m, least.time_s, bound);
  finding.verdict = holds_if(least.distance_m >= bound - kRounding);
  return finding;
}

Finding lost_is_passed(const FlightData& data, const ClosestToLost& closest) {
  Finding finding{"Once it has failed and is down, a drone is no obstacle any more: others come closer to it than R_s.",
                  "No active drone was lost and came down in this flight.", Verdict::kNotTested};
  if (!std::isfinite(closest.distance_m)) return finding;
  finding.measured = fmt::format("The closest was {} to {}, {:.4f} m at {:.7g} s.", data.flight.drones[closest.active],
                                 data.flight.drones[closest.lost], closest.distance_m, data.time_s(closest.tick));
  if (closest.distance_m >= data.mission.safety.separation_m) {
    finding.measured += " None had to come closer than R_s in this flight.";
    return finding;
  }
  finding.verdict = Verdict::kHolds;
  return finding;
}

std::size_t phases_of(const FlightData& data) {
  std::size_t phases = 0;
  if (data.flight.ticks.active.front() > 0) ++phases;
  for (const ActiveChange& change : data.changes) {
    if (data.flight.ticks.active[change.tick] > 0) ++phases;
  }
  return phases;
}

std::string jump_note(const FlightData& data) {
  const ActiveChange* loss = data.first_loss();
  if (loss == nullptr) return "No drone was lost in this flight, so that it made no difference.";
  const std::vector<double>& percent = data.flight.ticks.metric_percent;
  const std::size_t second_later = data.tick_at(data.time_s(loss->tick) + 1.0);
  const auto peak = std::max_element(percent.begin() + static_cast<std::ptrdiff_t>(loss->tick),
                                     percent.begin() + static_cast<std::ptrdiff_t>(second_later) + 1);
  return fmt::format(
      "Here the active drones changed at {:.7g} s ({}): the metric jumped from {:.3g} % to as much as {:.3g} % of its "
      "first "
      "value within a second, and ended at {:.3g} %. {} phases were added up by the end: total mass {}.",
      data.time_s(loss->tick), data.describe(*loss), percent[loss->tick - 1], *peak, last_percent(data),
      phases_of(data), phases_of(data));
}

std::string uniform_note(const FlightData& data, const CoverageMap& map) {
  const ActiveChange* loss = data.first_loss();
  if (loss == nullptr || !map.has_targets()) return "";
  const Eigen::ArrayXXd after = flown_between(data, map, loss->tick, data.ticks());
  return fmt::format(
      "The survivors' own time after that coincides with the map to {:.0f} % and with plain uniform coverage to {:.0f} "
      "%.",
      100.0 * map.overlap(after, map.wanted_smoothed), 100.0 * map.overlap(after, map.uniform()));
}

}  // namespace

std::vector<Finding> metric_findings(const FlightData& data) { return {nearly_zero(data), low_after_loss(data)}; }

std::vector<Finding> density_findings(const CoverageMap& map) {
  if (!map.has_targets()) {
    return {{"The swarm's distribution resembles the map.", "There were no targets at the end.", Verdict::kNotTested}};
  }
  const double overlap = map.overlap(map.flown, map.wanted_smoothed);
  std::vector<Finding> findings{
      {"The swarm's distribution resembles the map; with a metric of zero it would be a copy.",
       fmt::format("The two coincide to {:.0f} % (smoothed alike; {:.0f} % count as alike).", 100.0 * overlap,
                   100.0 * kLeastOverlap),
       holds_if(overlap >= kLeastOverlap)}};
  const AttentionShare* worst = nullptr;
  const auto met = [](const AttentionShare& share) { return share.achieved / share.asked; };
  for (std::size_t i = 0; i + 1 < map.shares.size(); ++i) {
    if (map.shares[i].asked > 0.0 && (worst == nullptr || met(map.shares[i]) < met(*worst))) worst = &map.shares[i];
  }
  if (worst != nullptr) {
    findings.push_back(
        {"Every target gets its attention.",
         fmt::format("Least served is '{}': {:.1f} % of the time where {:.1f} % were asked for (at least {:.0f} % "
                     "of that counts).",
                     worst->name, 100.0 * worst->achieved, 100.0 * worst->asked, 100.0 * kLeastAttention),
         holds_if(met(*worst) >= kLeastAttention), Source::kMission});
  }
  return findings;
}

std::vector<Finding> input_findings(const FlightData& data) {
  return {within_speed_limit(data), goes_on_after_loss(data)};
}

std::vector<Finding> snapshot_findings(const FlightData& data, const CoverageMap& map) {
  std::vector<Finding> findings{
      drawn_to_targets(data, map),
      keeps_from("the border of the field", least_of(data, &runtime::Clearances::wall_m),
                 data.mission.safety.wall_distance_m, Source::kPaper),
      keeps_from("no-fly areas", least_of(data, &runtime::Clearances::no_fly_m),
                 data.mission.safety.no_fly_buffer_m.value_or(data.mission.safety.wall_distance_m), Source::kMission)};
  std::erase_if(findings, [](const Finding& finding) { return finding.claim.empty(); });
  return findings;
}

std::vector<Finding> distance_findings(const FlightData& data, const ClosestToLost& closest) {
  return {active_keep_distance(data), lost_is_passed(data, closest), airborne_keep_distance(data)};
}

std::vector<std::string> accounting_notes(const FlightData& data, const CoverageMap& map) {
  switch (data.mission.control.accounting) {
    case ergodic::Accounting::kDroneTime:
      return {
          "`drone_time`: coverage is the share of all active drones' flight time spent at a place, the occupation "
          "measure. "
          "When drones drop out or come back only the set that is summed over changes; the metric stays continuous."};
    case ergodic::Accounting::kElapsedTime:
      return {
          "`elapsed_time`: every second counts alike, shared by the drones that were active in it: (14) of the paper "
          "with "
          "its averages weighted by how long each phase lasted, which is probably what it means."};
    case ergodic::Accounting::kPaperEq14:
      break;
  }
  std::vector<std::string> notes{
      "`paper_eq14`: equation (14) of the paper to the letter. It adds the averages of the time before and after a "
      "failure "
      "without weighting them, so that the swarm's distribution has a total mass of 2 after the first failure (and one "
      "more "
      "with each further change) while the map's stays 1. The metric jumps there, can no longer reach zero, and the "
      "survivors "
      "are driven to make up for mass that was counted twice, towards uniform coverage.",
      jump_note(data)};
  if (std::string uniform = uniform_note(data, map); !uniform.empty()) notes.push_back(std::move(uniform));
  return notes;
}

}  // namespace vigil::report
