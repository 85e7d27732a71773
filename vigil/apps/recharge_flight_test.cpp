// What the program promises of drones that charge at stations, flown whole and judged by ground truth.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vigil/apps/flight_for_tests.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {
namespace {

using Overrides = std::vector<runtime::Override>;

runtime::FlightSummary fly_the_day(const Overrides& overrides) {
  return fly(runtime::load_mission(VIGIL_MISSIONS_DIR "/wildfire_day.yaml", overrides));
}

void expect_safe(const runtime::FlightSummary& summary) {
  EXPECT_TRUE(summary.complete);
  EXPECT_EQ(summary.audit.separation_violations, 0U);
  EXPECT_EQ(summary.audit.wall_violations, 0U);
  EXPECT_EQ(summary.audit.no_fly_violations, 0U);
  EXPECT_EQ(summary.audit.speed_violations, 0U);
  EXPECT_EQ(summary.audit.ran_empty, 0U);
}

std::size_t least_active(const runtime::FlightSummary& summary) {
  return std::ranges::min_element(summary.active, {}, &std::pair<double, std::size_t>::second)->second;
}

double worst_revisit_s(const runtime::FlightSummary& summary) {
  double worst = 0.0;
  for (const auto& [area, worst_s] : summary.worst_revisit_s) worst = std::max(worst, worst_s);
  return worst;
}

TEST(RechargeFlight, A_day_and_a_night_with_two_stations_is_nearly_as_good_as_with_endless_batteries) {
  const runtime::FlightSummary endless = fly_the_day({{"stations", "[]"}, {"simulation.battery", "none"}});
  const runtime::FlightSummary charging = fly_the_day({});
  expect_safe(endless);
  expect_safe(charging);
  ASSERT_TRUE(charging.energy.has_value());
  const nlohmann::ordered_json energy = charging.energy->to_json(charging.audit);
  const double ratio = worst_revisit_s(charging) / worst_revisit_s(endless);
  std::printf("%d charges, away %.2f on average and %d at most, longest unseen %.0f s, %.2f times that of endless\n",
              energy["charges"].get<int>(), energy["mean_away"].get<double>(), energy["most_away"].get<int>(),
              worst_revisit_s(charging), ratio);
  EXPECT_LE(ratio, 1.5);
  EXPECT_LE(energy["most_away"].get<double>(), std::ceil(energy["mean_away"].get<double>()) + 1.0);
  EXPECT_GE(least_active(charging), 3U);
  EXPECT_TRUE(charging.faults.empty());
  EXPECT_EQ(charging.false_alarms, 0U);
}

TEST(RechargeFlight, Nobody_runs_empty_in_wind_with_old_batteries_and_a_station_that_fails) {
  for (int seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const runtime::FlightSummary summary =
        fly_the_day({{"simulation.duration_s", "14400"},
                     {"simulation.seed", std::to_string(seed)},
                     {"simulation.battery.health", seed % 2 == 0 ? "0.7" : "0.85"},
                     {"simulation.wind.mean_m_s", seed % 3 == 0 ? "[-4, 3]" : "[0, 5]"},
                     {"simulation.events", "[{at_s: " + std::to_string(1500 * seed) +
                                               ", do: fail_station, station: " + (seed < 4 ? "west" : "east") + "}]"}});
    expect_safe(summary);
    const nlohmann::ordered_json energy = summary.energy->to_json(summary.audit);
    EXPECT_EQ(energy["stations_failed"].get<int>(), 1);
    EXPECT_GT(energy["least_charge"].get<double>(), 0.05);
    EXPECT_GE(least_active(summary), 1U);
  }
}

}  // namespace
}  // namespace vigil::apps
