// What was flown is flown again from its recording, bit for bit: the project's missions, and a campaign's runs with
// failures.

#include <filesystem>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/flight_for_tests.hpp"
#include "vigil/runtime/campaign_plan.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/replayed_flight.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

fs::path record(const runtime::Mission& mission) {
  fs::path folder = fs::temp_directory_path() / ("vigil-recorded-missions-" + std::to_string(::getpid()));
  fs::remove_all(folder);
  recording::BagRecorder recorder(folder, runtime::mission_yaml(mission));
  recorder.begin(mission, {runtime::first_intent(mission), {}});
  const auto fleet = simulated_fleet(mission);
  runtime::VirtualFlight flight(mission, *fleet, &recorder, no_clock);
  while (!flight.is_over()) flight.step();
  recorder.finish();
  return folder;
}

/// Flies and records the mission, and expects every tick to come out of the recording as it went in.
void expect_the_same_again(const runtime::Mission& mission) {
  const fs::path folder = record(mission);
  runtime::ReplayedFlight flight(std::make_unique<recording::BagRecording>(folder));
  while (flight.step()) {
    ASSERT_TRUE(flight.is_recomputed());
    const auto difference = flight.difference();
    ASSERT_FALSE(difference.has_value()) << "tick " << difference->tick << ": " << difference->what;
  }
  const double ticks = mission.simulation.duration_s * mission.control.rate_hz;
  EXPECT_EQ(flight.number(), static_cast<std::uint64_t>(ticks + 0.5));
  fs::remove_all(folder);
}

runtime::Mission mission_named(const std::string& name, const char* seconds) {
  return runtime::load_mission(VIGIL_MISSIONS_DIR "/" + name + ".yaml",
                               std::vector<runtime::Override>{{"simulation.duration_s", seconds}});
}

TEST(RecordedMissions, The_papers_experiment_comes_out_again) { expect_the_same_again(mission_named("paper", "120")); }

TEST(RecordedMissions, The_wildfire_comes_out_again) { expect_the_same_again(mission_named("wildfire", "120")); }

TEST(RecordedMissions, A_crowd_on_its_errands_comes_out_again) { expect_the_same_again(mission_named("crowd", "20")); }

TEST(RecordedMissions, Vehicles_over_a_lossy_link_come_out_again) {
  for (const char* vehicle : {"px4", "arducopter", "crazyflie"}) {
    SCOPED_TRACE(vehicle);
    expect_the_same_again(mission_named("vehicles/" + std::string(vehicle), "60"));
  }
}

TEST(RecordedMissions, Drones_that_charge_in_turns_at_a_station_that_fails_come_out_again) {
  expect_the_same_again(runtime::load_mission(
      VIGIL_MISSIONS_DIR "/wildfire_day.yaml",
      std::vector<runtime::Override>{{"simulation.duration_s", "2500"},
                                     {"simulation.events", "[{at_s: 800, do: fail_station, station: west}]"}}));
}

TEST(RecordedMissions, Runs_of_a_campaign_full_of_failures_come_out_again) {
  runtime::CampaignPlan plan;
  plan.mission_yaml = runtime::mission_yaml(mission_named("vehicles/px4", "60"));
  plan.runs = 5;
  for (const char* variation : {"starts", "targets", "faults=8"})
    plan.variations.push_back(runtime::parse_variation(variation));
  for (std::uint64_t number = 0; number < plan.runs; ++number) {
    SCOPED_TRACE(number);
    expect_the_same_again(runtime::draw_run(plan, number).mission);
  }
}

}  // namespace
}  // namespace vigil::apps
