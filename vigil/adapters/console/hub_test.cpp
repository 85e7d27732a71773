#include "vigil/adapters/console/hub.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/outbound.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Latest = ClientLine::Latest;
using Visitor = ConsoleForTests::Visitor;

Json hold(std::uint64_t id, const Json& drones) { return {{"type", "hold"}, {"id", id}, {"drones", drones}}; }

Json weigh_east(std::uint64_t id, std::uint64_t based_on, double weight) {
  const Json edit{{"op", "set_weight"}, {"kind", "cluster"}, {"name", "east"}, {"weight", weight}};
  return {{"type", "edit"}, {"id", id}, {"based_on", based_on}, {"edits", {edit}}};
}

double weight_of_east(const Json& targets) { return targets.at("clusters").at(0).at("weight"); }

TEST(HubTest, Who_says_hello_is_told_everything_in_the_protocols_order) {
  ConsoleForTests console;
  console.fly();
  console.pass(500ms);
  const Visitor ana = console.join({{"name", "Ana"}});
  std::vector<std::string> types;
  for (const Json& message : ana.line->said) types.push_back(message.at("type"));
  EXPECT_EQ(types, (std::vector<std::string>{"hello", "mission", "targets", "events", "status", "presence"}));
  const Json hello = ana.line->of("hello").front();
  EXPECT_EQ(hello.at("name"), "Ana");
  EXPECT_EQ(hello.at("role"), "safety_pilot");
  EXPECT_EQ(hello.at("login"), false);
  console.pass(50ms);
  for (const Latest kind :
       {Latest::kSnapshot, Latest::kDensity, Latest::kCoverage, Latest::kAge, Latest::kTrails, Latest::kHistory})
    EXPECT_TRUE(ana.line->shown[kind]) << static_cast<int>(kind);
  EXPECT_FALSE(ana.line->shown[Latest::kPreview]);
}

TEST(HubTest, Before_anything_is_flown_a_client_is_greeted_and_commands_wait_for_a_mission) {
  ConsoleForTests console;
  const Visitor ana = console.join();
  EXPECT_EQ(ana.line->of("hello").size(), 1U);
  EXPECT_EQ(console.ask(ana, hold(1, "all")).at("code"), "not_now");
  EXPECT_EQ(console.ask(ana, {{"type", "ping"}, {"id", 2}}).at("type"), "pong");
  console.fly();
  EXPECT_EQ(ana.line->of("mission").size(), 1U);
  EXPECT_EQ(ana.line->of("targets").size(), 1U);
}

TEST(HubTest, A_command_takes_effect_at_the_next_tick_and_is_answered_with_it) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.pass(200ms);
  const std::uint64_t next = console.newest().snapshot.tick + 1;
  const Json answer = console.ask(ana, hold(7, {"b"}));
  EXPECT_EQ(answer.at("tick"), next);
  EXPECT_EQ(answer.at("pending"), false);
  const Json event = ana.line->event("held", "b");
  EXPECT_EQ(event.at("tick"), next);
  EXPECT_EQ(event.at("was"), "active");
}

TEST(HubTest, Answers_come_once_each_and_in_the_order_of_the_commands) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  std::vector<std::uint64_t> ids;
  for (std::uint64_t id = 100; id > 60; --id) {
    console.say(ana, id % 2 == 0 ? hold(id, {"a"}) : Json{{"type", "resume"}, {"id", id}, {"drones", {"a"}}});
    ids.push_back(id);
  }
  console.pass(2s);
  EXPECT_EQ(ana.line->answered(), ids);
}

TEST(HubTest, Drones_that_are_not_there_and_places_outside_are_refused_and_nothing_is_done) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  EXPECT_EQ(console.ask(ana, hold(1, {"a", "nobody"})).at("code"), "unknown_drone");
  const Json away{{"type", "go_to"}, {"id", 2}, {"drones", {"a"}}, {"place_m", {0.0, 0.0}}};
  EXPECT_EQ(console.ask(ana, away).at("code"), "invalid");
  EXPECT_TRUE(ana.line->event("held").is_null());
  EXPECT_EQ(console.hub.state().at("active"), 3);
}

TEST(HubTest, Who_of_several_drones_cannot_follow_is_named_and_the_others_follow) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Json land{{"type", "land"}, {"id", 1}, {"drones", {"a"}}};
  EXPECT_EQ(console.ask(ana, land).at("type"), "ack");
  const Json both = console.ask(ana, hold(2, {"a", "b"}));
  EXPECT_EQ(both.at("type"), "ack");
  ASSERT_EQ(both.at("refused_drones").size(), 1U);
  EXPECT_EQ(both.at("refused_drones").at(0).at("drone"), "a");
  EXPECT_NE(std::string(both.at("refused_drones").at(0).at("reason")).find("on the ground"), std::string::npos);
  EXPECT_EQ(console.ask(ana, hold(3, {"a"})).at("code"), "not_now");
  const Json all = console.ask(ana, hold(4, "all"));
  EXPECT_EQ(all.at("type"), "ack");
  EXPECT_EQ(all.at("refused_count"), 1);
  EXPECT_EQ(all.at("refused_drones").at(0).at("drone"), "a");
}

TEST(HubTest, To_hold_or_resume_all_leaves_a_drone_marked_failed) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.ask(ana, {{"type", "mark_failed"}, {"id", 1}, {"drones", {"b"}}});
  EXPECT_EQ(console.ask(ana, hold(2, "all")).at("refused_count"), 1);
  EXPECT_EQ(console.ask(ana, {{"type", "resume"}, {"id", 3}, {"drones", "all"}}).at("type"), "ack");
  EXPECT_EQ(console.newest().snapshot.drones[1].activity, swarm::Activity::kMarkedFailed);
  EXPECT_EQ(console.newest().snapshot.drones[0].activity, swarm::Activity::kActive);
  EXPECT_EQ(console.ask(ana, {{"type", "resume"}, {"id", 4}, {"drones", {"b"}}}).at("type"), "ack");
  EXPECT_NE(console.newest().snapshot.drones[1].activity, swarm::Activity::kMarkedFailed);
}

TEST(HubTest, What_was_ordered_is_told_before_what_came_of_it) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.ask(ana, {{"type", "land_all"}, {"id", 1}}, 200ms);
  const Json ordered = ana.line->event("land_all");
  const Json landing = ana.line->event("landing", "a");
  ASSERT_FALSE(ordered.is_null() || landing.is_null());
  EXPECT_LT(ordered.at("number"), landing.at("number"));
}

TEST(HubTest, An_event_counts_the_drones_that_cover_after_it) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.ask(ana, hold(1, {"a"}));
  EXPECT_EQ(ana.line->event("held", "a").at("effect"), "2 of 3 drones cover; they take over its share");
  console.ask(ana, {{"type", "land_all"}, {"id", 2}}, 200ms);
  EXPECT_EQ(ana.line->event("landing", "b").at("effect"), "no drone covers");
  console.ask(ana, {{"type", "take_off"}, {"id", 3}, {"drones", {"c"}}}, 200ms);
  EXPECT_EQ(ana.line->event("grounded", "a").at("effect"), "no drone covers");
}

TEST(HubTest, Two_clients_see_each_others_edits_and_a_stale_one_is_refused_with_the_name) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join({{"name", "Ana"}});
  const Visitor ben = console.join({{"name", "Ben"}});
  EXPECT_EQ(console.ask(ana, weigh_east(1, 1, 3.0)).at("revision"), 2);
  const Json seen = ben.line->of("targets").back();
  EXPECT_EQ(seen.at("by"), "Ana");
  EXPECT_EQ(seen.at("what"), "east: weight 3");
  EXPECT_EQ(weight_of_east(seen), 3.0);
  EXPECT_EQ(ben.line->event("edit").at("by"), "Ana");
  const Json stale = console.ask(ben, weigh_east(1, 1, 5.0));
  EXPECT_EQ(stale.at("code"), "stale");
  EXPECT_NE(std::string(stale.at("reason")).find("Ana"), std::string::npos);
  EXPECT_EQ(console.ask(ben, weigh_east(2, 2, 5.0)).at("type"), "ack");
  EXPECT_EQ(weight_of_east(ana.line->of("targets").back()), 5.0);
}

TEST(HubTest, An_edit_is_answered_when_the_tick_uses_it) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.pass(100ms);
  const Json answer = console.ask(ana, weigh_east(1, 1, 3.0));
  EXPECT_EQ(console.newest().revision, 2U);
  EXPECT_GE(console.newest().snapshot.tick, answer.at("tick").get<std::uint64_t>());
}

TEST(HubTest, Undo_and_redo_are_one_history_for_everybody) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Visitor ben = console.join();
  console.ask(ana, weigh_east(1, 1, 3.0));
  EXPECT_EQ(console.ask(ben, {{"type", "undo"}, {"id", 1}, {"based_on", 2}}).at("revision"), 3);
  EXPECT_EQ(weight_of_east(ana.line->of("targets").back()), 1.0);
  EXPECT_EQ(console.ask(ana, {{"type", "undo"}, {"id", 9}, {"based_on", 2}}).at("code"), "stale");
  EXPECT_EQ(console.ask(ana, {{"type", "redo"}, {"id", 2}, {"based_on", 3}}).at("revision"), 4);
  EXPECT_EQ(weight_of_east(ben.line->of("targets").back()), 3.0);
  EXPECT_EQ(console.ask(ana, {{"type", "redo"}, {"id", 3}, {"based_on", 4}}).at("code"), "not_now");
}

TEST(HubTest, Who_edits_what_is_shown_until_they_leave) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join({{"name", "Ana"}});
  const Visitor ben = console.join({{"name", "Ben"}});
  const Json east{{"kind", "cluster"}, {"name", "east"}};
  console.ask(ana, {{"type", "editing"}, {"id", 1}, {"what", {east}}});
  const Json both = ben.line->of("presence").back().at("operators");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both.at(0).at("editing").at(0), east);
  console.hub.disconnect(ana.id);
  const Json alone = ben.line->of("presence").back().at("operators");
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone.at(0).at("name"), "Ben");
}

TEST(HubTest, A_preview_goes_to_who_asked_and_an_older_one_gives_way) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Visitor ben = console.join();
  Json preview = weigh_east(1, 1, 3.0);
  preview["type"] = "preview_density";
  console.is_desk_at_work = false;
  console.say(ana, preview);
  preview["id"] = 2;
  console.say(ana, preview);
  console.work();
  EXPECT_EQ(ana.line->answer(1).at("code"), "superseded");
  EXPECT_EQ(ana.line->answer(2).at("type"), "ack");
  EXPECT_EQ(ana.line->shows[Latest::kPreview], 1);
  EXPECT_EQ(ben.line->shows[Latest::kPreview], 0);
  EXPECT_EQ(ana.line->of("targets").size(), 1U);  // nothing was changed
}

TEST(HubTest, A_look_ahead_is_answered_with_a_preview_to_who_asked_and_the_flight_goes_on) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Visitor ben = console.join();
  console.say(ana, {{"type", "preview"}, {"id", 5}, {"seconds", 2}, {"without", {"a"}}});
  console.pass_until([&] { return !ana.line->answer(5).is_null(); });
  EXPECT_EQ(ana.line->answer(5).at("what_if").at("active"), 2);
  EXPECT_TRUE(ben.line->of("preview").empty());
  EXPECT_EQ(console.hub.state().at("active"), 3);
}

TEST(HubTest, A_flood_is_slowed_down_and_a_stubborn_one_ended) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Json ping{{"type", "ping"}, {"id", 1}};
  for (int n = 0; n < 199; ++n) console.say(ana, ping);  // hello was the first of 200
  EXPECT_EQ(ana.line->of("pong").size(), 199U);
  console.say(ana, ping);
  EXPECT_EQ(ana.line->of("refused").back().at("code"), "too_fast");
  console.pass(1s);
  for (int n = 0; n < 51; ++n) console.say(ana, ping);
  EXPECT_EQ(ana.line->of("pong").size(), 249U);
  for (int n = 0; n < 2000; ++n) console.say(ana, ping);
  EXPECT_EQ(ana.line->said.back().at("code"), "too_fast");
  EXPECT_TRUE(ana.line->is_closed);
}

TEST(HubTest, Nonsense_is_refused_with_a_reason_and_the_client_stays) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.hub.receive(ana.id, "{");
  console.hub.receive(ana.id, R"({"type":"fly","id":3})");
  console.hub.refuse_message(ana.id, "malformed", "messages are JSON text, not bytes");
  const std::vector<Json> refused = ana.line->of("refused");
  ASSERT_EQ(refused.size(), 3U);
  EXPECT_TRUE(refused[0].at("id").is_null());
  EXPECT_EQ(refused[1].at("code"), "unknown_type");
  EXPECT_EQ(refused[1].at("id"), 3);
  for (const Json& one : refused) EXPECT_FALSE(std::string(one.at("reason")).empty());
  EXPECT_EQ(console.ask(ana, {{"type", "ping"}, {"id", 4}}).at("type"), "pong");
}

TEST(HubTest, While_the_clock_stands_commands_are_pending_and_are_done_when_it_goes_on) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  EXPECT_EQ(console.ask(ana, {{"type", "pause"}, {"id", 1}}).at("type"), "ack");
  console.say(ana, hold(2, {"a"}));
  console.pass(90ms);
  EXPECT_TRUE(ana.line->answer(2).is_null());
  console.pass(50ms);
  EXPECT_EQ(ana.line->answer(2).at("pending"), true);
  EXPECT_TRUE(ana.line->event("held", "a").is_null());
  console.ask(ana, {{"type", "resume_clock"}, {"id", 3}});
  EXPECT_EQ(ana.line->event("held", "a").at("tick"), ana.line->answer(2).at("tick"));
  EXPECT_EQ(ana.line->answered(), (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST(HubTest, Where_a_queue_is_full_the_answer_is_busy_and_nothing_is_lost_silently) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.is_desk_at_work = false;
  console.most_tasks = 1;
  console.say(ana, weigh_east(1, 1, 3.0));
  console.say(ana, weigh_east(2, 1, 4.0));
  EXPECT_EQ(ana.line->answer(2).at("code"), "busy");
  console.ask(ana, {{"type", "pause"}, {"id", 3}});
  std::uint64_t id = 10;
  while (ana.line->answer(id - 1).is_null() || id == 10) console.say(ana, hold(id++, "all"));
  EXPECT_EQ(ana.line->answer(id - 1).at("code"), "busy");
  console.is_desk_at_work = true;
  console.ask(ana, {{"type", "resume_clock"}, {"id", 4}}, 1s);
  for (std::uint64_t one = 10; one < id - 1; ++one) EXPECT_EQ(ana.line->answer(one).at("type"), "ack") << one;
}

/// A client that never reads: what it is told goes as far as its outbound queue.
class DeafLine final : public ClientLine {
 public:
  void say(SharedBytes text) override { is_given_up = is_given_up || !outbound.say(std::move(text)); }
  void show(Latest kind, SharedBytes bytes) override { outbound.show(kind, std::move(bytes)); }
  void close() override {}
  void pace() override { outbound.pace(); }
  [[nodiscard]] bool confirm(std::uint64_t received) override { return outbound.confirm(received, 0s); }

  Outbound outbound;
  bool is_given_up = false;
};

TEST(HubTest, Who_does_not_read_holds_up_nobody_and_waits_for_one_frame_of_each_kind) {
  ConsoleForTests console;
  console.fly();
  const auto deaf = std::make_shared<DeafLine>();
  console.hub.receive(console.hub.connect(deaf), R"({"type":"hello"})");
  const Visitor ana = console.join();
  console.pass(30s);
  EXPECT_EQ(console.ask(ana, hold(1, {"a"})).at("type"), "ack");
  EXPECT_GE(ana.line->shows[Latest::kSnapshot], 29 * 20);
  EXPECT_FALSE(deaf->is_given_up);
  int frames = 0;
  while (const auto message = deaf->outbound.next(0s)) frames += message->is_text ? 0 : 1;
  EXPECT_LE(frames, static_cast<int>(Latest::kCount));
}

TEST(HubTest, What_was_asked_of_a_flight_that_ends_meanwhile_is_refused) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  console.ask(ana, {{"type", "pause"}, {"id", 1}});
  console.say(ana, hold(2, {"a"}));
  console.say(ana, {{"type", "load_mission"}, {"id", 3}, {"yaml", runtime::kSmallMission}});
  console.work();
  EXPECT_EQ(ana.line->answer(2).at("code"), "not_now");
  EXPECT_EQ(ana.line->answer(3).at("type"), "ack");
  EXPECT_EQ(ana.line->of("mission").back().at("epoch"), 2);
  console.pass(100ms);
  EXPECT_EQ(console.hub.state().at("epoch"), 2);
}

TEST(HubTest, A_client_that_left_is_told_nothing_more) {
  ConsoleForTests console;
  console.fly();
  Visitor ana = console.join();
  console.say(ana, hold(1, {"a"}));
  console.hub.disconnect(ana.id);
  const std::size_t said = ana.line->said.size();
  console.pass(200ms);
  EXPECT_EQ(ana.line->said.size(), said + 1);  // the answer of what it had asked; sockets drop it
  console.hub.receive(ana.id, R"({"type":"ping","id":2})");
  EXPECT_EQ(ana.line->said.size(), said + 1);
  EXPECT_EQ(console.hub.state().at("drones").at(0).at("activity"), "held");
}

TEST(HubTest, The_missions_own_events_change_targets_and_are_told) {
  ConsoleForTests console;
  console.fly(
      "simulation:\n  duration_s: 5\n  events:\n    - {at_s: 0.5, do: land, drone: a}\n"
      "    - {at_s: 0.6, do: set_weight, cluster: east, weight: 4}\n");
  const Visitor ana = console.join();
  console.pass(1s);
  EXPECT_EQ(ana.line->event("land", "a").at("source"), "mission");
  const Json targets = ana.line->of("targets").back();
  EXPECT_EQ(targets.at("by"), "mission");
  EXPECT_EQ(weight_of_east(targets), 4.0);
}

TEST(HubTest, At_the_end_everybody_is_told_goodbye) {
  ConsoleForTests console;
  console.fly();
  const Visitor ana = console.join();
  const Visitor stranger = console.connect();
  console.hub.end();
  EXPECT_EQ(ana.line->said.back().at("code"), "ending");
  EXPECT_EQ(stranger.line->said.back().at("code"), "ending");
  EXPECT_TRUE(ana.line->is_closed && stranger.line->is_closed);
  EXPECT_EQ(console.hub.clients(), 0U);
}

}  // namespace
}  // namespace vigil::console
