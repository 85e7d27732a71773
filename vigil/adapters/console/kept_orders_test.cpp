// What a restart of the program goes on with, as the hub and the desk keep it together.
#include <filesystem>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Visitor = ConsoleForTests::Visitor;

TEST(Restart, After_a_restart_it_waits_for_somebody_to_resume) {
  ConsoleForTests console;
  const runtime::Mission mission = runtime::small_mission();
  runtime::SavedFlight saved;
  saved.revision = 9;
  ConsoleForTests before;
  before.fly();
  saved.past = before.newest().past;
  console.desk.begin(mission, &saved);
  const Visitor ana = console.join();
  console.pass(600ms);
  EXPECT_EQ(ana.line->of("targets").front().at("by"), "restored");
  std::string effects;
  for (const Json& message : ana.line->of("events"))
    for (const Json& event : message.at("events")) effects += std::string(event.at("effect")) + "\n";
  EXPECT_NE(effects.find("the clock runs at 1x, whether it was paused"), std::string::npos) << effects;
  EXPECT_EQ(console.hub.state().at("waits_for_resume"), true);
  EXPECT_EQ(console.hub.state().at("active"), 0);
  EXPECT_EQ(console.ask(ana, {{"type", "resume"}, {"id", 1}, {"drones", "all"}}, 200ms).at("type"), "ack");
  EXPECT_EQ(console.hub.state().at("waits_for_resume"), false);
  EXPECT_EQ(console.hub.state().at("active"), 3);
}

TEST(Restart, An_order_for_another_flight_is_refused_but_landing_or_stopping_all_is_not) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  EXPECT_EQ(ana.line->of("hello").front().at("run"), "this run");
  std::uint64_t id = 0;
  const auto answer = [&](Json command) {
    command["id"] = ++id;
    const Json answered = console.ask(ana, command);
    return answered.contains("code") ? answered.at("code") : answered.at("type");
  };
  const Json hold{{"type", "hold"}, {"drones", {"a"}}};
  const auto of = [](Json command, const char* run, int epoch) {
    command["run"] = run;
    command["epoch"] = epoch;
    return command;
  };
  EXPECT_EQ(answer(of(hold, "this run", 2)), "stale");
  EXPECT_EQ(answer(of(hold, "another run", 1)), "stale");
  EXPECT_EQ(console.newest().snapshot.drones[0].activity, swarm::Activity::kActive);
  EXPECT_EQ(answer(of(hold, "this run", 1)), "ack");
  EXPECT_EQ(answer(hold), "ack");  // says of no flight that it was seen
  EXPECT_EQ(answer(of({{"type", "emergency_stop"}, {"drones", {"b"}}}, "another run", 7)), "stale");
  EXPECT_EQ(answer({{"type", "land_all"}}), "ack");
  EXPECT_EQ(answer(of({{"type", "emergency_stop"}, {"drones", "all"}}, "another run", 7)), "ack");

  Json floor{{"type", "edit"}, {"based_on", 1}};
  floor["edits"] = Json::array({{{"op", "set_uniform_floor"}, {"uniform_floor", 0.5}}});
  EXPECT_EQ(answer(of(floor, "this run", 2)), "stale");
  EXPECT_EQ(answer(of(floor, "another run", 1)), "stale");
  EXPECT_EQ(answer(of(floor, "this run", 1)), "ack");
  const Json undo{{"type", "undo"}, {"based_on", 2}};
  EXPECT_EQ(answer(of(undo, "another run", 1)), "stale");
  EXPECT_EQ(answer(of(undo, "this run", 1)), "ack");
}

class KeptFlightTest : public ::testing::Test {
 protected:
  KeptFlightTest() {
    std::filesystem::remove_all(folder);
    store = std::make_shared<runtime::FlightStore>(folder);
  }
  ~KeptFlightTest() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] std::vector<swarm::Intent> saved_orders() const {
    std::vector<swarm::Intent> orders;
    const auto saved = store->load();
    for (const runtime::SavedFlight::Drone& drone : saved->drones) orders.push_back(drone.order);
    return orders;
  }

  std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "vigil_kept_flight_test";
  std::shared_ptr<runtime::FlightStore> store;
};

TEST_F(KeptFlightTest, An_order_takes_effect_at_once_and_is_acknowledged_when_it_is_saved) {
  ConsoleForTests console({}, store);
  console.fly();
  const Visitor ana = console.join();
  console.is_desk_at_work = false;
  console.say(ana, {{"type", "land_all"}, {"id", 1}});
  console.say(ana, {{"type", "mark_failed"}, {"id", 2}, {"drones", {"b"}}});
  console.pass(300ms);
  EXPECT_EQ(console.newest().snapshot.drones[0].activity, swarm::Activity::kGrounded);
  EXPECT_TRUE(ana.line->answered().empty());
  console.is_desk_at_work = true;
  console.pass(20ms);
  EXPECT_EQ(ana.line->answer(1).at("type"), "ack");
  EXPECT_EQ(ana.line->answer(2).at("type"), "ack");
  EXPECT_EQ(saved_orders()[1], swarm::Intent::kMarkedFailed);
}

TEST_F(KeptFlightTest, An_order_under_a_paused_clock_is_saved_before_it_is_acknowledged_as_pending) {
  ConsoleForTests console({}, store);
  console.fly();
  const Visitor ana = console.join();
  console.ask(ana, {{"type", "pause"}, {"id", 1}});
  EXPECT_EQ(console.ask(ana, {{"type", "land"}, {"id", 2}, {"drones", {"b"}}}, 300ms).at("pending"), true);
  EXPECT_EQ(saved_orders()[1], swarm::Intent::kLand);
}

TEST(PausedClock, Everybody_is_told_which_orders_wait_for_it_and_whose_they_are) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join({{"name", "Ana"}});
  console.ask(ana, {{"type", "pause"}, {"id", 1}});
  EXPECT_EQ(console.ask(ana, {{"type", "land_all"}, {"id", 2}}, 300ms).at("pending"), true);
  for (int id = 3; id < 12; ++id) console.say(ana, {{"type", "hold"}, {"id", id}, {"drones", {"b"}}});
  console.pass(700ms);
  const Json state = console.hub.state();
  ASSERT_EQ(state.at("waiting").size(), kMostWaitingShown);
  EXPECT_EQ(state.at("waiting").at(0), (Json{{"text", "land all"}, {"from", "Ana"}}));
  EXPECT_EQ(state.at("waiting").at(1), (Json{{"text", "hold b"}, {"from", "Ana"}}));
  EXPECT_EQ(state.at("waiting_more"), 2);
  console.ask(ana, {{"type", "resume_clock"}, {"id", 12}}, 300ms);
  EXPECT_TRUE(console.hub.state().at("waiting").empty());
  EXPECT_EQ(console.hub.state().at("waiting_more"), 0);
}

TEST_F(KeptFlightTest, A_restart_goes_on_with_the_orders_that_stood_and_nothing_takes_off) {
  using swarm::Activity;
  {  // a run of the program that just ends
    ConsoleForTests console({}, store);
    console.fly();
    const Visitor ana = console.join();
    console.ask(ana, {{"type", "mark_failed"}, {"id", 1}, {"drones", {"a"}}});
    console.ask(ana, {{"type", "emergency_stop"}, {"id", 2}, {"drones", {"b"}}});
    console.ask(ana, {{"type", "pause"}, {"id", 3}});
    console.ask(ana, {{"type", "land"}, {"id", 4}, {"drones", {"c"}}}, 300ms);
  }
  const auto saved = store->load();
  ConsoleForTests console({}, store);
  console.desk.begin(runtime::parse_mission(saved->targets_text, "the saved state"), &*saved);
  std::vector<Activity> seen;
  console.pass(100ms);
  for (const swarm::DroneSnapshot& drone : console.newest().snapshot.drones) seen.push_back(drone.activity);
  EXPECT_EQ(seen, (std::vector<Activity>{Activity::kMarkedFailed, Activity::kEmergencyStop, Activity::kGrounded}));
}

}  // namespace
}  // namespace vigil::console
