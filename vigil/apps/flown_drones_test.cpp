#include "vigil/apps/flown_drones.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/live_world_for_tests.hpp"

namespace vigil::apps {
namespace {

using swarm::VehicleMode;

/// A flight whose drones do what a test says.
class Flight final : public runtime::ShownFlight {
 public:
  Flight() { set(VehicleMode::kGrounded); }

  [[nodiscard]] const runtime::Mission& mission() const noexcept override { return mission_; }
  [[nodiscard]] std::uint32_t epoch() const noexcept override { return 1; }
  [[nodiscard]] bool is_recording() const noexcept override { return false; }
  [[nodiscard]] bool submit(std::vector<runtime::LiveCommand> commands) override {
    submitted.insert(submitted.end(), commands.begin(), commands.end());
    return true;
  }
  bool read(runtime::LiveFrame& into, std::size_t& /*version*/) const override {
    into = frame;
    return true;
  }
  bool read(runtime::ClockState& /*into*/, std::size_t& /*version*/) const override { return false; }
  [[nodiscard]] const std::vector<runtime::LiveEvent>& take_events() override { return events_; }
  [[nodiscard]] std::size_t lost_events() const override { return 0; }
  [[nodiscard]] runtime::QueuedRecorder* recorder() noexcept override { return nullptr; }
  [[nodiscard]] const runtime::QueuedRecorder* recorder() const noexcept override { return nullptr; }

  void set(VehicleMode mode) {
    for (swarm::DroneSnapshot& drone : frame.snapshot.drones) {
      drone.mode = mode;
      drone.activity = swarm::Activity::kActive;
    }
  }

  std::vector<runtime::LiveCommand> submitted;
  runtime::LiveFrame frame{3};

 private:
  runtime::Mission mission_ = runtime::small_mission();
  std::vector<runtime::LiveEvent> events_;
};

class FlownDronesTest : public ::testing::Test {
 protected:
  FlownDronesTest() { flown_.watch(flight_); }
  bool are_down() {
    return flown_.are_down([this] { ++told_; });
  }

  std::shared_ptr<Flight> flight_ = std::make_shared<Flight>();
  FlownDrones flown_;
  int told_ = 0;
};

TEST_F(FlownDronesTest, With_all_on_the_ground_the_program_may_end_at_once) {
  EXPECT_TRUE(are_down());
  EXPECT_EQ(told_, 0);
  EXPECT_TRUE(flight_->submitted.empty());
}

TEST_F(FlownDronesTest, Whoever_climbs_flies_or_lands_is_waited_for_and_told_to_land) {
  for (const VehicleMode mode : {VehicleMode::kTakingOff, VehicleMode::kFlying, VehicleMode::kLanding}) {
    flight_->set(VehicleMode::kGrounded);
    flight_->frame.snapshot.drones[1].mode = mode;
    EXPECT_FALSE(are_down());
  }
  ASSERT_EQ(flight_->submitted.size(), 1U);
  EXPECT_EQ(flight_->submitted[0].swarm.kind, swarm::CommandKind::kLand);
  EXPECT_FALSE(flight_->submitted[0].swarm.drone.has_value());
  flight_->set(VehicleMode::kGrounded);
  EXPECT_TRUE(are_down());
  EXPECT_EQ(told_, 1);
}

TEST_F(FlownDronesTest, A_landing_is_ordered_again_once_in_ten_asks) {
  flight_->set(VehicleMode::kFlying);
  for (int i = 0; i < 25; ++i) EXPECT_FALSE(are_down());
  EXPECT_EQ(flight_->submitted.size(), 3U);
  EXPECT_EQ(told_, 1);
}

TEST_F(FlownDronesTest, A_pilots_drone_is_in_the_air_and_is_not_waited_for) {
  flight_->set(VehicleMode::kManual);
  EXPECT_TRUE(flown_.are_in_the_air());
  EXPECT_TRUE(are_down());
}

TEST_F(FlownDronesTest, Nothing_flies_of_a_mission_that_is_over) {
  flight_->set(VehicleMode::kFlying);
  EXPECT_TRUE(flown_.are_in_the_air());
  flight_.reset();
  EXPECT_FALSE(flown_.are_in_the_air());
  EXPECT_TRUE(are_down());
}

}  // namespace
}  // namespace vigil::apps
