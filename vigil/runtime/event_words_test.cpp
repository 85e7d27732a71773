#include "vigil/runtime/event_words.hpp"

#include <set>

#include <gtest/gtest.h>

#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

using swarm::Activity;
using swarm::CommandKind;
using swarm::VehicleMode;

constexpr Activity kLast = Activity::kOutside;

std::vector<Activity> all_activities() {
  std::vector<Activity> all;
  for (int n = 0; n <= static_cast<int>(kLast); ++n) all.push_back(static_cast<Activity>(n));
  return all;
}

swarm::DroneSnapshot in_mode(VehicleMode mode, Activity activity = Activity::kActive) {
  swarm::DroneSnapshot drone;
  drone.mode = mode;
  drone.activity = activity;
  return drone;
}

TEST(EventWordsTest, Every_activity_has_words_of_its_own_that_name_the_drone) {
  std::set<std::string> texts;
  for (const Activity activity : all_activities()) {
    const EventWords words = words_for("cf2", activity, {}, 2, 3);
    EXPECT_NE(words.text.find("cf2"), std::string::npos) << swarm::name_of(activity);
    EXPECT_FALSE(words.effect.empty()) << swarm::name_of(activity);
    texts.insert(words.text);
  }
  EXPECT_EQ(texts.size(), all_activities().size());
}

TEST(EventWordsTest, What_is_worse_than_a_wish_of_an_operator_warns_and_says_what_to_do_next) {
  for (const Activity activity : all_activities()) {
    const EventWords words = words_for("cf2", activity, {}, 2, 3);
    EXPECT_TRUE(words.severity == Severity::kInfo || !words.next.empty()) << swarm::name_of(activity);
  }
  for (const Activity lost : {Activity::kEmergencyStop, Activity::kMarkedFailed, Activity::kVehicleFailed,
                              Activity::kTrackingLost, Activity::kLinkLost})
    EXPECT_EQ(words_for("cf2", lost, {}, 2, 3).severity, Severity::kAlarm) << swarm::name_of(lost);
  for (const Activity wished : {Activity::kActive, Activity::kGrounded, Activity::kHeld, Activity::kTravelling})
    EXPECT_EQ(words_for("cf2", wished, {}, 2, 3).severity, Severity::kInfo) << swarm::name_of(wished);
}

TEST(EventWordsTest, Where_a_drone_drops_out_it_says_how_many_go_on) {
  EXPECT_NE(words_for("cf2", Activity::kLanding, {}, 2, 3).effect.find("2 of 3 drones cover"), std::string::npos);
  EXPECT_NE(words_for("cf2", Activity::kLanding, {}, 0, 3).effect.find("no drone covers"), std::string::npos);
  EXPECT_EQ(words_for("cf2", Activity::kLanding, {}, 0, 3).effect.find("take over"), std::string::npos);
}

TEST(EventWordsTest, A_low_battery_is_told_in_percent) {
  swarm::DroneSnapshot drone;
  drone.battery = 0.174;
  EXPECT_EQ(words_for("cf2", Activity::kBatteryLow, drone, 2, 3).text, "cf2: battery at 17 %");
}

TEST(EventWordsTest, A_refusal_says_what_stands_in_the_way) {
  const auto refused = [](CommandKind wish, const swarm::DroneSnapshot& drone) {
    return refusal_words("cf2", wish, drone);
  };
  const auto says = [](const std::string& words, const char* what) {
    return words.find("cf2") != std::string::npos && words.find(what) != std::string::npos;
  };
  const swarm::DroneSnapshot down = in_mode(VehicleMode::kGrounded, Activity::kGrounded);
  const swarm::DroneSnapshot flying = in_mode(VehicleMode::kFlying);
  EXPECT_TRUE(says(refused(CommandKind::kTakeOff, flying), "in the air"));
  EXPECT_TRUE(says(refused(CommandKind::kTakeOff, in_mode(VehicleMode::kGrounded, Activity::kMarkedFailed)), "failed"));
  EXPECT_TRUE(says(refused(CommandKind::kTakeOff, down), "pilot"));
  EXPECT_TRUE(says(refused(CommandKind::kLand, down), "on the ground already"));
  EXPECT_TRUE(says(refused(CommandKind::kHold, down), "on the ground"));
  EXPECT_TRUE(says(refused(CommandKind::kHold, flying), "pilot"));
  EXPECT_TRUE(says(refused(CommandKind::kGoTo, flying), "outside every no-fly polygon and not walled in"));
  EXPECT_TRUE(says(refused(CommandKind::kGoTo, in_mode(VehicleMode::kFlying, Activity::kOverridden)), "pilot"));
  EXPECT_TRUE(says(refused(CommandKind::kGoTo, in_mode(VehicleMode::kFlying, Activity::kMarkedFailed)), "failed"));
  EXPECT_TRUE(says(refused(CommandKind::kGoTo, down), "on the ground"));
  EXPECT_TRUE(says(refused(CommandKind::kResume, flying), "neither held"));
  EXPECT_TRUE(says(refused(CommandKind::kGiveBack, flying), "nobody took"));
  EXPECT_TRUE(says(refused(CommandKind::kEmergencyStop, flying), "cannot"));
  EXPECT_TRUE(says(refused(CommandKind::kLand, in_mode(VehicleMode::kUnknown)), "never heard of"));
  EXPECT_TRUE(says(refused(CommandKind::kLand, in_mode(VehicleMode::kFalling, Activity::kEmergencyStop)), "stopped"));
}

TEST(EventWordsTest, Every_fault_says_what_it_is_what_the_swarm_does_and_what_to_do) {
  std::set<std::string> texts;
  const std::vector<std::pair<swarm::Fault, Activity>> faults{{swarm::Fault::kFrozen, Activity::kTrackingLost},
                                                              {swarm::Fault::kJumped, Activity::kTrackingLost},
                                                              {swarm::Fault::kSwapped, Activity::kTrackingLost},
                                                              {swarm::Fault::kDisagreeing, Activity::kTrackingLost},
                                                              {swarm::Fault::kNotFollowing, Activity::kNotFollowing},
                                                              {swarm::Fault::kOutside, Activity::kOutside},
                                                              {swarm::Fault::kOwnMode, Activity::kLanding}};
  for (const auto& [fault, activity] : faults) {
    swarm::DroneSnapshot drone = in_mode(VehicleMode::kFlying, activity);
    drone.fault = {.kind = fault, .measured = 1.25, .threshold = 0.5};
    const EventWords words = words_for("cf2", activity, drone, 2, 3);
    EXPECT_EQ(words.severity, Severity::kAlarm) << swarm::name_of(fault);
    EXPECT_NE(words.text.find("cf2"), std::string::npos) << swarm::name_of(fault);
    EXPECT_FALSE(words.effect.empty()) << swarm::name_of(fault);
    EXPECT_FALSE(words.next.empty()) << swarm::name_of(fault);
    EXPECT_EQ(words_for_fault("cf2", drone, 2, 3).text, words.text);
    texts.insert(words.text);
  }
  EXPECT_EQ(texts.size(), faults.size());
}

TEST(EventWordsTest, A_fault_is_told_with_its_evidence_and_what_it_is_beyond) {
  swarm::DroneSnapshot drone = in_mode(VehicleMode::kFlying, Activity::kNotFollowing);
  drone.fault = {.kind = swarm::Fault::kNotFollowing, .measured = 1.25, .threshold = 0.5};
  EXPECT_EQ(words_for("cf2", Activity::kNotFollowing, drone, 2, 3).text,
            "cf2 does not fly what it is told: 1.25 m from where its orders lead, at most 0.50 m can be");
}

}  // namespace
}  // namespace vigil::runtime
