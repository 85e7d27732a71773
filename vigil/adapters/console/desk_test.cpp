#include "vigil/adapters/console/desk.hpp"

#include <filesystem>
#include <future>

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/desk_thread.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

runtime::TargetEdit weigh(const std::string& name, double weight) {
  return runtime::SetWeight{{runtime::TargetKind::kCluster, name}, weight};
}

/// A desk whose news the test keeps, and a flight whose ticks it turns.
class DeskTest : public ::testing::Test {
 protected:
  ~DeskTest() override { std::filesystem::remove_all(folder); }

  void fly(const std::string& more = "") { desk().begin(runtime::small_mission(more), nullptr); }
  Desk& desk() {
    if (!desk_)
      desk_.emplace(
          [this](const runtime::Mission& mission, std::uint32_t epoch, const runtime::SavedFlight* saved) {
            return flight = flight_by_hand(mission, epoch, saved, now);
          },
          [this](DeskNews one) {
            if (on_news) on_news();
            news.push_back(std::move(one));
          },
          store);
    return *desk_;
  }
  void tick(int times = 1) {
    for (; times > 0; --times, now += 20ms) flight->loop().turn(now);
  }
  /// All news of one kind, oldest first.
  template <typename News>
  std::vector<News> told() const {
    std::vector<News> found;
    for (const DeskNews& one : news)
      if (const auto* it = std::get_if<News>(&one)) found.push_back(*it);
    return found;
  }

  std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "vigil_desk_test";
  std::shared_ptr<runtime::FlightStore> store;
  std::shared_ptr<runtime::LiveMission> flight;
  std::vector<DeskNews> news;
  std::function<void()> on_news;  ///< called before they are kept
  std::chrono::nanoseconds now{1000s};

 private:
  std::optional<Desk> desk_;
};

TEST_F(DeskTest, A_flight_begins_with_its_targets_in_its_first_tick) {
  fly();
  ASSERT_EQ(news.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<FlightNews>(news[0]));
  const auto& targets = std::get<TargetsNews>(news[1]);
  EXPECT_EQ(targets.revision, 1U);
  EXPECT_TRUE(targets.what.empty());  // no change, so nothing for the log
  tick();
  EXPECT_EQ(newest_frame(*flight).revision, 1U);
  EXPECT_TRUE(newest_frame(*flight).snapshot.has_metric);
}

TEST_F(DeskTest, A_change_is_accepted_then_told_and_in_the_next_tick) {
  fly();
  tick();
  news.clear();
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(std::get<DeskAcceptance>(news[0]).ticket, 5U);
  const auto& targets = std::get<TargetsNews>(news[1]);
  EXPECT_EQ(targets.by, "Ana");
  EXPECT_EQ(targets.what, "east: weight 3");
  EXPECT_EQ(targets.mission.targets.clusters.front().weight, 3.0);
  tick();
  EXPECT_EQ(newest_frame(*flight).revision, 2U);
}

TEST_F(DeskTest, A_change_that_is_refused_tells_why_and_changes_nothing) {
  fly();
  news.clear();
  desk().edit(5, {weigh("nobody", 3.0)}, 1, "Ana");
  desk().edit(6, {weigh("east", -1.0)}, 1, "Ana");
  desk().undo(7, 1, "Ana");
  const auto refusals = told<DeskRefusal>();
  ASSERT_EQ(refusals.size(), news.size());
  ASSERT_EQ(refusals.size(), 3U);
  EXPECT_EQ(refusals[0].code, "invalid");
  EXPECT_EQ(refusals[1].code, "invalid");
  EXPECT_EQ(refusals[2].code, "not_now");
}

TEST_F(DeskTest, A_preview_changes_nothing_and_only_the_newest_is_drawn) {
  fly();
  news.clear();
  const std::atomic<std::uint64_t> newest = 6;
  desk().preview(5, newest, 70, {weigh("east", 3.0)}, 1);
  desk().preview(6, newest, 71, {weigh("east", 3.0)}, 1);
  const std::atomic<std::uint64_t> other = 7;
  desk().preview(7, other, 72, {weigh("nobody", 3.0)}, 1);
  ASSERT_EQ(news.size(), 3U);
  EXPECT_EQ(std::get<DeskRefusal>(news[0]).code, "superseded");
  EXPECT_TRUE(std::get<DeskAnswer>(news[1]).preview);
  EXPECT_EQ(std::get<DeskAnswer>(news[1]).revision, 1U);
  EXPECT_EQ(std::get<DeskRefusal>(news[2]).code, "invalid");
}

TEST_F(DeskTest, A_target_that_finds_the_control_loops_queue_full_gets_there_later) {
  fly();
  tick();
  runtime::LiveCommand hold;
  hold.swarm.kind = swarm::CommandKind::kHold;
  hold.swarm.drone = swarm::DroneId(0);
  while (flight->loop().submit({hold})) {
  }
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  tick(20);
  EXPECT_EQ(newest_frame(*flight).revision, 1U);
  desk().look();
  tick();
  EXPECT_EQ(newest_frame(*flight).revision, 2U);
}

TEST_F(DeskTest, A_look_tells_of_the_ground_and_of_a_deadline_that_was_missed_once) {
  fly();
  runtime::LiveCommand land;
  land.swarm.kind = swarm::CommandKind::kLand;
  tick();
  desk().look();
  ASSERT_EQ(told<GroundNews>().size(), 1U);
  desk().look();  // nothing new: no tick between
  EXPECT_EQ(told<GroundNews>().size(), 1U);
  ASSERT_TRUE(flight->loop().submit({land}));
  for (int n = 0; n < 125; ++n) {
    tick(10);
    desk().look();
  }
  std::vector<std::string> overdue;
  for (const GroundNews& ground : told<GroundNews>())
    for (const runtime::DeadlineChange& change : ground.deadlines)
      if (change.is_overdue) overdue.push_back(change.what.name);
  EXPECT_EQ(overdue, std::vector<std::string>{"east"});  // within 25 s; its deadline is 20 s
}

TEST_F(DeskTest, It_looks_ahead_by_itself_and_says_who_will_be_late) {
  fly();
  const runtime::TargetEdit hurry = runtime::SetRevisit{{runtime::TargetKind::kCluster, "east"}, 1.0};
  desk().edit(5, {hurry}, 1, "Ana");
  const auto has_said = [&] {
    const auto grounds = told<GroundNews>();
    return !grounds.empty() && grounds.back().foresight.has_value();
  };
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (!has_said() && std::chrono::steady_clock::now() < until) {
    news.clear();
    tick(5);
    desk().look();
  }
  ASSERT_TRUE(has_said());
  const GroundNews ground = told<GroundNews>().back();
  EXPECT_TRUE(ground.foresight->text.starts_with("with 3 of 3 drones: east unseen for up to "));
  EXPECT_GT(ground.areas.front().foreseen_s.value_or(0.0), 1.2);
}

TEST_F(DeskTest, An_event_of_the_mission_file_changes_targets_if_it_still_fits_and_is_of_this_flight) {
  fly("simulation:\n  duration_s: 5\n  events:\n    - {at_s: 1, do: set_weight, cluster: east, weight: 4}\n");
  desk().play(2, 0);  // of a flight that is not there
  EXPECT_EQ(told<TargetsNews>().size(), 1U);
  desk().play(1, 0);
  EXPECT_EQ(told<TargetsNews>().back().by, "mission");
  EXPECT_EQ(told<TargetsNews>().back().mission.targets.clusters.front().weight, 4.0);
  desk().edit(5, {runtime::RemoveEntry{{runtime::TargetKind::kCluster, "east"}}}, 2, "Ana");
  desk().play(1, 0);
  ASSERT_EQ(told<DeskTrouble>().size(), 1U);
  EXPECT_NE(told<DeskTrouble>().front().text.find("no longer fits"), std::string::npos);
}

TEST_F(DeskTest, Another_mission_is_flown_where_it_is_one_and_else_the_old_one_goes_on) {
  fly();
  const auto first = flight;
  desk().load_mission(5, "format: 2");
  EXPECT_EQ(told<DeskRefusal>().front().code, "invalid");
  EXPECT_EQ(flight, first);
  tick();
  desk().look();
  EXPECT_EQ(told<GroundNews>().size(), 1U);
  desk().load_mission(6, runtime::kSmallMission);
  EXPECT_EQ(told<DeskAnswer>().front().ticket, 6U);
  EXPECT_NE(flight, first);
  EXPECT_EQ(flight->epoch(), 2U);
}

TEST_F(DeskTest, What_it_saves_is_what_the_next_run_goes_on_with) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  tick(100);
  desk().end();
  const auto saved = store->load();
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->revision, 2U);
  EXPECT_EQ(saved->past.ticks, 100U);
  EXPECT_EQ(saved->drones.size(), 3U);

  const std::vector<double> seen_s = saved->seen_s;
  const runtime::Mission mission = runtime::parse_mission(saved->targets_text, "the saved state");
  DeskTest::news.clear();
  desk().begin(mission, &*saved);
  EXPECT_TRUE(told<FlightNews>().front().is_restored);
  EXPECT_EQ(told<TargetsNews>().front().by, "restored");
  EXPECT_EQ(told<TargetsNews>().front().revision, 2U);
  EXPECT_TRUE(told<DeskTrouble>().empty());
  tick();
  EXPECT_EQ(newest_frame(*flight).snapshot.tick, 100U);
  desk().end();
  EXPECT_GE(store->load()->seen_s.size(), seen_s.size());
}

TEST_F(DeskTest, A_change_is_saved_before_anybody_hears_of_it_or_a_tick_uses_it_also_before_the_first_tick) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  std::uint64_t revision = 1;
  on_news = [&] {
    ASSERT_TRUE(store->load());
    EXPECT_EQ(store->load()->revision, revision);
    tick();
    EXPECT_EQ(newest_frame(*flight).revision, revision - 1);
  };
  revision = 2;
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  tick();
  revision = 3;
  desk().undo(6, 2, "Ana");
  tick();
  revision = 4;
  desk().redo(7, 3, "Ana");
  EXPECT_EQ(told<DeskAcceptance>().size(), 3U);
}

TEST_F(DeskTest, What_is_saved_before_the_first_tick_is_a_flight_that_can_go_on) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  const auto first = store->load();
  ASSERT_TRUE(first);
  ASSERT_EQ(first->drones.size(), 3U);
  EXPECT_EQ(first->drones[1].place_m, Vec2(1.5, 1.0));
  EXPECT_FALSE(first->drones[1].is_down);

  runtime::SavedFlight later = *first;
  later.past.ticks = 100;
  later.drones[1] = {{0.7, 0.8}, true};
  desk().begin(runtime::parse_mission(later.targets_text, "the saved state"), &later);
  desk().edit(6, {weigh("east", 4.0)}, 2, "Ana");
  const auto again = store->load();
  EXPECT_EQ(again->revision, 3U);
  EXPECT_EQ(again->past.ticks, 100U);
  EXPECT_EQ(again->drones[1].place_m, Vec2(0.7, 0.8));
  EXPECT_TRUE(again->drones[1].is_down);
}

TEST_F(DeskTest, Orders_are_saved_before_that_is_told_whether_a_tick_has_taken_them_or_not) {
  using swarm::Intent;
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  tick();
  const auto give = [&](std::uint64_t ticket, swarm::CommandKind kind, std::size_t drone) {
    runtime::LiveCommand command;
    command.swarm.kind = kind;
    command.swarm.drone = swarm::DroneId(drone);
    command.ticket = ticket;
    ASSERT_TRUE(flight->loop().submit({command}));
    desk().keep(flight->epoch(), {{ticket, {command.swarm}}});
  };
  const auto saved = [&] {
    std::vector<Intent> orders;
    const auto now_saved = store->load();
    for (const runtime::SavedFlight::Drone& drone : now_saved->drones) orders.push_back(drone.order);
    return orders;
  };
  std::vector<Intent> expected{Intent::kCover, Intent::kLand, Intent::kCover};
  on_news = [&] { EXPECT_EQ(saved(), expected); };
  give(1, swarm::CommandKind::kLand, 1);
  expected[2] = Intent::kMarkedFailed;
  give(2, swarm::CommandKind::kMarkFailed, 2);
  tick(2);
  expected[1] = Intent::kStayDown;  // it came down
  expected[0] = Intent::kHold;
  give(3, swarm::CommandKind::kHold, 0);
  EXPECT_EQ(told<OrdersKept>().size(), 3U);
  desk().keep(flight->epoch() + 1, {{4, {{.kind = swarm::CommandKind::kEmergencyStop, .drone = {}, .target = {}}}}});
  EXPECT_EQ(saved(), expected);  // of a flight that is over
}

TEST_F(DeskTest, A_mission_that_was_loaded_is_saved_before_that_is_answered) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  std::string other = runtime::kSmallMission;
  other.replace(other.find("name: small"), 11, "name: other");
  desk().load_mission(6, other);
  ASSERT_EQ(told<DeskAnswer>().size(), 1U);
  EXPECT_NE(store->load()->mission_text.find("name: other"), std::string::npos);
}

TEST_F(DeskTest, It_saves_once_a_second_of_the_mission_and_at_each_look_where_that_is_shorter) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  const auto saved_ticks_after = [&](int ticks_a_look, int looks) {
    for (int n = 0; n < looks; ++n) {
      tick(ticks_a_look);
      desk().look();
    }
    return store->load()->past.ticks;
  };
  EXPECT_EQ(saved_ticks_after(10, 4), 0U);     // at 50 Hz 0.8 s
  EXPECT_EQ(saved_ticks_after(10, 1), 50U);    // the fifth look
  EXPECT_EQ(saved_ticks_after(100, 1), 150U);  // ten times as fast as time
  EXPECT_EQ(saved_ticks_after(200, 1), 350U);
}

TEST_F(DeskTest, A_change_that_cannot_be_saved_is_made_and_said_to_be_in_danger) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  std::filesystem::remove_all(folder);
  desk().edit(5, {weigh("east", 3.0)}, 1, "Ana");
  EXPECT_EQ(told<DeskAcceptance>().size(), 1U);
  EXPECT_EQ(told<DeskTrouble>().size(), 1U);
  tick();
  EXPECT_EQ(newest_frame(*flight).revision, 2U);
}

TEST_F(DeskTest, A_state_that_cannot_be_written_is_told_once_and_the_flight_goes_on) {
  store = std::make_shared<runtime::FlightStore>(folder);
  fly();
  tick();
  desk().look();
  std::filesystem::remove_all(folder);
  for (int n = 0; n < 3; ++n) desk().save();
  EXPECT_EQ(told<DeskTrouble>().size(), 1U);
  std::filesystem::create_directories(folder);
  desk().save();
  EXPECT_TRUE(store->load());
  std::filesystem::remove_all(folder);
  desk().save();
  EXPECT_EQ(told<DeskTrouble>().size(), 2U);
}

TEST_F(DeskTest, Its_thread_does_tasks_in_order_also_after_one_that_throws) {
  fly();
  std::vector<std::string> done;
  std::promise<void> all_done;
  {
    DeskThread thread(desk(), [&done](const std::string& trouble) { done.push_back(trouble); });
    ASSERT_TRUE(thread.post([&done](Desk&) { done.emplace_back("first"); }));
    ASSERT_TRUE(thread.post([](Desk&) { throw std::runtime_error("trouble"); }));
    ASSERT_TRUE(thread.post([&done, &all_done](Desk&) {
      done.emplace_back("last");
      all_done.set_value();
    }));
    all_done.get_future().wait();
  }
  EXPECT_EQ(done, (std::vector<std::string>{"first", "trouble", "last"}));
}

TEST_F(DeskTest, Its_thread_takes_only_so_many_tasks) {
  fly();
  std::promise<void> may_go_on;
  std::promise<void> is_busy;
  DeskThread thread(desk(), [](const std::string&) {});
  ASSERT_TRUE(thread.post([&](Desk&) {
    is_busy.set_value();
    may_go_on.get_future().wait();
  }));
  is_busy.get_future().wait();
  for (std::size_t n = 0; n < DeskThread::kMostTasks; ++n) ASSERT_TRUE(thread.post([](Desk&) {}));
  EXPECT_FALSE(thread.post([](Desk&) {}));
  may_go_on.set_value();
}

}  // namespace
}  // namespace vigil::console
