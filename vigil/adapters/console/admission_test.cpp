#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/hub.hpp"
#include "vigil/adapters/console/seats.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Visitor = ConsoleForTests::Visitor;

Tokens three_doors() {
  return Tokens::parse("viewer viewer-0123456789\noperator operator-0123456789\nsafety_pilot pilot-0123456789\n", "");
}

TEST(AdmissionTest, Who_says_anything_else_first_is_shown_the_door) {
  ConsoleForTests console;
  console.fly();
  for (const std::string text : {R"({"type":"ping","id":1})", R"({"type":"land_all","id":1})", "{", ""}) {
    const Visitor stranger = console.connect();
    console.hub.receive(stranger.id, text);
    ASSERT_EQ(stranger.line->said.size(), 1U) << text;
    EXPECT_EQ(stranger.line->said.front().at("code"), "no_hello");
    EXPECT_TRUE(stranger.line->is_closed);
  }
  EXPECT_EQ(console.hub.clients(), 0U);
}

TEST(AdmissionTest, Who_says_nothing_is_told_nothing_and_leaves_after_ten_seconds) {
  ConsoleForTests console;
  console.fly();
  const Visitor silent = console.connect();
  console.pass(10s);
  EXPECT_TRUE(silent.line->said.empty());
  EXPECT_TRUE(silent.line->shown.empty());
  console.pass(10ms);
  EXPECT_EQ(silent.line->said.front().at("code"), "no_hello");
  EXPECT_TRUE(silent.line->is_closed);
}

TEST(AdmissionTest, A_token_opens_its_role_and_a_wrong_one_the_way_out) {
  ConsoleForTests console(three_doors());
  console.fly();
  EXPECT_EQ(console.join({{"token", "operator-0123456789"}}).line->of("hello").front().at("role"), "operator");
  EXPECT_EQ(console.join({{"token", "pilot-0123456789"}}).line->of("hello").front().at("role"), "safety_pilot");
  for (const Json& hello : {Json::object(), Json{{"token", ""}}, Json{{"token", "operator-012345678"}}}) {
    const Visitor stranger = console.join(hello);
    EXPECT_EQ(stranger.line->said.front().at("code"), "bad_token") << hello;
    EXPECT_TRUE(stranger.line->is_closed);
  }
}

TEST(AdmissionTest, A_page_that_connects_anew_takes_the_place_of_its_lost_connection_and_of_nobody_elses) {
  ConsoleForTests console;
  console.fly();
  const Json marked{{"page", "00112233445566778899aabbccddeeff"}};
  const Visitor before = console.join(marked);
  const Visitor other = console.join({{"page", "ffeeddccbbaa99887766554433221100"}});
  const Visitor nobodys = console.join();
  const Visitor unmarked = console.join();
  const Visitor anew = console.join(marked);
  EXPECT_EQ(before.line->of("bye").front().at("code"), "replaced");
  EXPECT_TRUE(before.line->is_closed);
  for (const Visitor& visitor : {other, nobodys, unmarked, anew}) EXPECT_FALSE(visitor.line->is_closed);
  EXPECT_EQ(anew.line->of("presence").back().at("operators").size(), 4U);
}

TEST(AdmissionTest, A_page_is_not_replaced_by_who_has_no_token) {
  ConsoleForTests console(three_doors());
  console.fly();
  const char* page = "00112233445566778899aabbccddeeff";
  const Visitor pilot = console.join({{"token", "pilot-0123456789"}, {"page", page}});
  EXPECT_TRUE(console.join({{"token", "guessed"}, {"page", page}}).line->is_closed);
  EXPECT_FALSE(pilot.line->is_closed);
}

TEST(AdmissionTest, One_may_be_less_than_one_may_be_and_never_more) {
  ConsoleForTests console(three_doors());
  console.fly();
  const auto role = [&](const char* token, const char* wished) {
    return console.join({{"token", token}, {"role", wished}}).line->of("hello").front().at("role");
  };
  EXPECT_EQ(role("pilot-0123456789", "viewer"), "viewer");
  EXPECT_EQ(role("viewer-0123456789", "safety_pilot"), "viewer");
}

TEST(AdmissionTest, However_many_come_with_one_roles_token_those_above_it_find_a_place) {
  ConsoleForTests console(three_doors());
  const auto let_in = [&](const char* token) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < kMostConnections; ++n)
      if (!console.join({{"token", token}}).line->is_closed) ++count;
    return count;
  };
  EXPECT_EQ(let_in("viewer-0123456789"), 192U);
  EXPECT_EQ(let_in("operator-0123456789"), 16U);
  EXPECT_EQ(let_in("pilot-0123456789"), 16U);
  console.hub.disconnect(1);
  EXPECT_EQ(let_in("viewer-0123456789"), 0U);  // fewer than 192 must be there
  EXPECT_EQ(let_in("pilot-0123456789"), 1U);
  EXPECT_EQ(console.join({{"token", "viewer-0123456789"}}).line->of("bye").front().at("code"), "too_many");
}

/// Every command, and the least role that protocol/README.md gives it to.
struct Permission {
  Json command;
  Role least;
};
std::vector<Permission> permissions() {
  const Json edit{{"op", "set_uniform_floor"}, {"uniform_floor", 0.1}};
  std::vector<Permission> all{{{{"type", "ping"}}, Role::kViewer},
                              {{{"type", "preview_density"}, {"based_on", 1}, {"edits", {edit}}}, Role::kViewer},
                              {{{"type", "preview"}, {"without", {"nobody"}}}, Role::kViewer},
                              {{{"type", "why"}, {"drone", "nobody"}}, Role::kViewer},
                              {{{"type", "editing"}, {"what", Json::array()}}, Role::kOperator},
                              {{{"type", "go_to"}, {"drones", "all"}, {"place_m", {0.0, 11.0}}}, Role::kOperator},
                              {{{"type", "land_all"}}, Role::kOperator},
                              {{{"type", "emergency_stop"}, {"drones", "all"}}, Role::kSafetyPilot},
                              {{{"type", "edit"}, {"based_on", 1}, {"edits", {edit}}}, Role::kOperator},
                              {{{"type", "undo"}, {"based_on", 1}}, Role::kOperator},
                              {{{"type", "redo"}, {"based_on", 1}}, Role::kOperator},
                              {{{"type", "start_afresh"}}, Role::kOperator},
                              {{{"type", "set_speed"}, {"factor", 2}}, Role::kOperator},
                              {{{"type", "pause"}}, Role::kOperator},
                              {{{"type", "resume_clock"}}, Role::kOperator},
                              {{{"type", "load_mission"}, {"yaml", "format: 2"}}, Role::kOperator}};
  for (const char* wish : {"take_off", "land", "hold", "resume", "mark_failed", "give_back", "return"})
    all.push_back({{{"type", wish}, {"drones", "all"}}, Role::kOperator});
  return all;
}

TEST(AdmissionTest, Every_command_is_open_to_its_role_and_those_above_and_to_no_other) {
  for (const Permission& permission : permissions()) {
    for (const Role role : {Role::kViewer, Role::kOperator, Role::kSafetyPilot}) {
      ConsoleForTests console;
      console.fly();
      const Visitor visitor = console.join({{"role", name_of(role)}});
      Json command = permission.command;
      command["id"] = 5;
      const Json answer = console.ask(visitor, command, 200ms);
      ASSERT_FALSE(answer.is_null()) << command;
      EXPECT_EQ(answer.value("code", "") == "not_allowed", role < permission.least) << command << name_of(role);
    }
  }
}

}  // namespace
}  // namespace vigil::console
