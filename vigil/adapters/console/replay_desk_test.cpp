#include "vigil/adapters/console/replay_desk.hpp"

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/runtime/memory_recording_for_tests.hpp"
#include "vigil/runtime/velocity_reasons.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Kind = runtime::LiveCommand::Kind;

constexpr std::uint64_t kTicks = 3000;

/// A recording of a minute of the small mission, at 50 Hz, whose desk only the test turns.
class ReplayDeskTest : public ::testing::Test {
 protected:
  ReplayDeskTest() { desk_.begin(); }

  [[nodiscard]] static std::unique_ptr<runtime::FlightRecording> open() {
    static const runtime::KeptFlight kKept = runtime::kept_flight(kTicks);
    return std::make_unique<runtime::KeptRecording>(kKept);
  }
  [[nodiscard]] static std::unique_ptr<runtime::FlightRecording> open_thinned() {
    runtime::KeptFlight kept = runtime::kept_flight(20);
    kept.head.keep_every = 2;
    return std::make_unique<runtime::KeptRecording>(std::move(kept));
  }

  void order(Kind kind, double value = 0.0) {
    runtime::LiveCommand command;
    command.kind = kind;
    command.seek_s = value;
    command.speed = value;
    command.steps = static_cast<std::int64_t>(value);
    ASSERT_TRUE(recording_->submit({command}));
  }
  void turn() {
    desk_.turn(now_);
    now_ += 10ms;
  }
  /// To where it was sent, and until that was told of.
  void arrive() {
    do turn();
    while (recording_->is_seeking());
  }
  /// What was told of one kind, oldest first; it is forgotten.
  template <typename News>
  [[nodiscard]] std::vector<News> told() {
    std::vector<News> found;
    for (DeskNews& news : std::exchange(news_, {}))
      if (auto* one = std::get_if<News>(&news)) found.push_back(std::move(*one));
    return found;
  }

  std::chrono::nanoseconds now_{1000s};
  std::vector<DeskNews> news_;
  runtime::Mission mission_ = runtime::small_mission("simulation: {events: [{at_s: 2, do: land, drone: b}]}\n");
  std::shared_ptr<runtime::ReplayLoop> recording_ = std::make_shared<runtime::ReplayLoop>(mission_, open, 5U);
  ReplayDesk desk_{recording_, [this](DeskNews news) { news_.push_back(std::move(news)); }};
};

TEST_F(ReplayDeskTest, It_begins_with_the_recording_its_targets_its_ground_and_what_led_to_its_first_tick) {
  ASSERT_EQ(news_.size(), 4U);
  EXPECT_EQ(std::get<RecordingNews>(news_[0]).recording, recording_);
  EXPECT_EQ(Json::parse(*std::get<RecordingNews>(news_[0]).mission).at("recording").at("ticks"), kTicks);
  EXPECT_EQ(std::get<TargetsNews>(news_[1]).revision, 1U);
  EXPECT_EQ(std::get<GroundNews>(news_[2]).tick, 0U);
  EXPECT_TRUE(std::get<HistoryNews>(news_[3]).is_afresh);
  EXPECT_EQ(std::get<HistoryNews>(news_[3]).state.number, 1U);
}

TEST_F(ReplayDeskTest, While_nothing_moves_it_tells_nothing) {
  turn();
  news_.clear();
  for (int n = 0; n < 100; ++n) turn();
  EXPECT_TRUE(news_.empty());
}

TEST_F(ReplayDeskTest, On_a_long_way_it_tells_five_times_a_second_how_far_it_has_come_and_at_its_end_everything) {
  turn();
  news_.clear();
  order(Kind::kSeek, 55.0);
  std::size_t turns = 0;
  do {
    turn();
    ++turns;
  } while (recording_->is_seeking());
  const std::vector<HistoryNews> told_of = told<HistoryNews>();
  ASSERT_GT(turns, 1U);
  for (std::size_t i = 0; i + 1 < told_of.size(); ++i) {
    EXPECT_FALSE(told_of[i].is_afresh);
    EXPECT_TRUE(told_of[i].state.is_seeking);
    EXPECT_LT(told_of[i].state.progress, 1.0);
    if (i > 0) {
      EXPECT_GT(told_of[i].state.progress, told_of[i - 1].state.progress);
    }
  }
  EXPECT_TRUE(told_of.back().is_afresh);
  EXPECT_FALSE(told_of.back().state.is_seeking);
  EXPECT_EQ(told_of.back().state.progress, 1.0);
  EXPECT_EQ(told_of.back().state.number, 2751U);
  EXPECT_TRUE(told_of.back().state.is_recomputed);
  EXPECT_TRUE(told_of.back().state.difference.empty());
}

TEST_F(ReplayDeskTest, After_a_jump_trails_are_told_of_anew_and_while_it_plays_they_are_not) {
  order(Kind::kSeek, 4.0);
  arrive();
  EXPECT_TRUE(told<HistoryNews>().back().trails.has_value());
  order(Kind::kResumeClock);
  for (int n = 0; n < 50; ++n) turn();
  for (const HistoryNews& news : told<HistoryNews>()) EXPECT_FALSE(news.trails.has_value());
}

TEST_F(ReplayDeskTest, What_plots_show_is_told_up_to_the_moment_that_is_shown) {
  for (const double time_s : {30.0, 10.0, 20.0}) {
    order(Kind::kSeek, time_s);
    arrive();
    const std::vector<HistoryNews> told_of = told<HistoryNews>();
    ASSERT_TRUE(told_of.back().plots.has_value());
    const auto rows = told_of.back().plots->rows();
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(10.0 * time_s) + 1);
    EXPECT_EQ(rows.front().begin_s, 0.0);
    EXPECT_NEAR(rows.back().time_s, time_s, 1e-9);
  }
}

TEST_F(ReplayDeskTest, A_question_is_answered_of_the_tick_that_is_shown) {
  order(Kind::kSeek, 1.5);
  arrive();
  news_.clear();
  ASSERT_TRUE(desk_.ask({.ticket = 9, .asker = 1, .drone = 2}));
  turn();
  const std::vector<PreviewNews> answers = told<PreviewNews>();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].ticket, 9U);
  Json wanted{{"type", "why"}, {"id", 0}, {"epoch", 5}};
  wanted.update(runtime::velocity_reasons_json(recording_->scene().flight().state(), swarm::DroneId(2), mission_));
  EXPECT_EQ(answers[0].answer, wanted);
  EXPECT_EQ(wanted.at("time_s"), 1.5);
  turn();
  EXPECT_TRUE(told<PreviewNews>().empty());
}

TEST_F(ReplayDeskTest, Of_an_askers_questions_the_newest_is_answered_and_only_so_many_wait) {
  constexpr std::uint64_t kMost = 64;
  for (std::uint64_t asker = 1; asker <= kMost; ++asker)
    EXPECT_TRUE(desk_.ask({.ticket = asker, .asker = asker, .drone = 0}));
  EXPECT_FALSE(desk_.ask({.ticket = 100, .asker = 100, .drone = 0}));
  news_.clear();
  EXPECT_TRUE(desk_.ask({.ticket = 101, .asker = 3, .drone = 1}));
  const std::vector<DeskRefusal> refused = told<DeskRefusal>();
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].ticket, 3U);
  EXPECT_EQ(refused[0].code, "superseded");
  turn();
  const std::vector<PreviewNews> answers = told<PreviewNews>();
  ASSERT_EQ(answers.size(), kMost);
  EXPECT_EQ(answers[2].ticket, 101U);
  EXPECT_EQ(answers[2].answer.at("drone"), "b");
}

TEST_F(ReplayDeskTest, Where_ticks_were_not_kept_a_question_is_refused_with_the_reason) {
  std::vector<DeskNews> news;
  const auto thinned = std::make_shared<runtime::ReplayLoop>(mission_, open_thinned, 1U);
  ReplayDesk desk(thinned, [&news](DeskNews one) { news.push_back(std::move(one)); });
  desk.begin();
  ASSERT_TRUE(desk.ask({.ticket = 1, .asker = 1, .drone = 0}));
  news.clear();
  desk.turn(now_);
  const auto refusal =
      std::ranges::find_if(news, [](const DeskNews& one) { return one.index() == DeskNews(DeskRefusal{}).index(); });
  ASSERT_NE(refusal, news.end());
  EXPECT_EQ(std::get<DeskRefusal>(*refusal).code, "not_now");
}

}  // namespace
}  // namespace vigil::console
