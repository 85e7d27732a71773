#include "vigil/adapters/console/why_answer.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Visitor = ConsoleForTests::Visitor;

Json question(std::uint64_t id, const std::string& drone) { return {{"type", "why"}, {"id", id}, {"drone", drone}}; }

/// The answer, once it is there.
Json answer(ConsoleForTests& console, const Visitor& visitor, std::uint64_t id) {
  console.pass_until([&] { return !visitor.line->answer(id).is_null(); });
  return visitor.line->answer(id);
}

TEST(WhyTest, What_is_answered_is_what_the_flights_state_gives) {
  ConsoleForTests console;
  console.fly();
  console.pass(2s);
  const Visitor ana = console.join();
  const Visitor ben = console.join();
  console.say(ana, question(7, "b"));
  const Json told = answer(console, ana, 7);
  EXPECT_TRUE(ben.line->of("why").empty());
  ConsoleForTests other;  // the same flight once more, up to the tick that was told of
  other.fly();
  while (other.newest().snapshot.tick < told.at("tick")) other.pass(5ms);
  const swarm::DroneSnapshot decided = other.newest().snapshot.drones[1];
  const field::WorldFrame world = runtime::world_frame(runtime::small_mission());
  const Vec2 wanted = world.vector_to_world(decided.u_nom);
  const Vec2 allowed = world.vector_to_world(decided.order.velocity);
  EXPECT_EQ(told.at("u_nom_m_s"), Json({wanted.x(), wanted.y()}));
  EXPECT_EQ(told.at("u_m_s"), Json({allowed.x(), allowed.y()}));
  EXPECT_EQ(told.at("drone"), "b");
  EXPECT_EQ(told.at("epoch"), 1);
}

TEST(WhyTest, A_newer_question_of_a_client_takes_the_place_of_its_older_one_and_of_no_other) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Visitor ben = console.join();
  const auto flight = std::exchange(console.flight, nullptr);  // no turn of its loop: no state is given
  console.say(ben, question(1, "a"));
  console.say(ana, question(2, "a"));
  console.say(ana, question(3, "c"));
  console.pass(5ms);
  console.flight = flight;
  EXPECT_EQ(answer(console, ana, 3).at("drone"), "c");
  EXPECT_EQ(answer(console, ana, 2).at("code"), "superseded");
  EXPECT_EQ(answer(console, ben, 1).at("drone"), "a");
}

TEST(WhyTest, A_question_is_no_look_ahead_and_takes_none_its_place) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.say(ana, {{"type", "preview"}, {"id", 4}, {"seconds", 2}});
  console.say(ana, question(5, "a"));
  EXPECT_EQ(answer(console, ana, 5).at("type"), "why");
  EXPECT_EQ(answer(console, ana, 4).at("type"), "preview");
}

TEST(WhyTest, A_drone_that_is_not_there_is_refused_and_so_is_one_of_a_mission_that_ended) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  EXPECT_EQ(console.ask(ana, question(1, "x")).at("code"), "unknown_drone");
  runtime::Mission lone = runtime::small_mission();
  lone.drones.resize(1);
  console.tasks.emplace_back([&lone](Desk& desk) { desk.begin(lone, nullptr); });  // before it comes to the question
  console.say(ana, question(2, "c"));
  EXPECT_EQ(answer(console, ana, 2).at("code"), "not_now");
}

}  // namespace
}  // namespace vigil::console
