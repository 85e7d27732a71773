// A fiftieth of docs/fault-matrix.md: every fault on every vehicle at two random moments, against ground truth.
#include <string>

#include <gtest/gtest.h>

#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/fault_trial.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {
namespace {

using runtime::FaultTrial;
using runtime::Misfortune;

std::unique_ptr<runtime::VirtualFleet> fleet_of(const runtime::Mission& mission) { return simulated_fleet(mission); }

runtime::Mission vehicle_mission(const std::string& vehicle, const std::vector<runtime::Override>& overrides = {}) {
  return runtime::load_mission(VIGIL_MISSIONS_DIR "/vehicles/" + vehicle + ".yaml", overrides);
}

class FaultMatrix : public testing::TestWithParam<std::string> {};

TEST_P(FaultMatrix, Every_fault_that_shows_is_noticed_in_its_time_and_nobody_else_is_accused) {
  constexpr std::uint64_t kMoments = 2;
  const runtime::Mission mission = vehicle_mission(GetParam());
  int shown = 0;
  int rightly = 0;
  for (std::size_t fault = 0; fault < runtime::kMisfortuneWords.size(); ++fault) {
    for (std::uint64_t seed = 1; seed <= kMoments; ++seed) {
      SCOPED_TRACE(std::string(runtime::kMisfortuneWords.at(fault)) + ", seed " + std::to_string(seed));
      const FaultTrial trial = runtime::fly_trial(mission, fleet_of, static_cast<Misfortune>(fault), seed);
      EXPECT_EQ(trial.false_alarms, 0U);
      if (static_cast<Misfortune>(fault) != Misfortune::kFliesAway) {  // nobody can evade who is faster
        EXPECT_EQ(trial.others_violation_ticks, 0U);
      }
      if (!trial.has_shown) continue;
      EXPECT_TRUE(trial.is_in_time) << trial.delay_s << " s, stated "
                                    << runtime::stated_time_s(mission, static_cast<Misfortune>(fault));
      ++shown;
      rightly += trial.is_named_rightly ? 1 : 0;
    }
  }
  EXPECT_GE(shown, 20);
  EXPECT_GE(rightly, (95 * shown) / 100);
}

TEST_P(FaultMatrix, There_is_no_false_alarm_in_ten_minutes_without_a_fault) {
  const runtime::Mission mission =
      vehicle_mission(GetParam(), {{"simulation.link.loss", "0.05"}, {"simulation.link.burst_packets", "1"}});
  EXPECT_EQ(runtime::false_alarms(mission, fleet_of, 1, 600.0), 0U);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, FaultMatrix,
                         testing::Values("ideal", "first_order_lag", "crazyflie", "arducopter", "px4"),
                         [](const auto& vehicle) { return vehicle.param; });

}  // namespace
}  // namespace vigil::apps
