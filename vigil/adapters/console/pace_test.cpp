#include "vigil/adapters/console/pace.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/outbound.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Latest = ClientLine::Latest;
using Time = Pace::Time;

/// A way to a client that carries so many bytes a second and buffers whatever comes; what it reads it confirms, which
/// arrives after the way back. Its time is turned by the test.
class SlowWay {
 public:
  SlowWay(double bytes_a_second, Time way_back) : bytes_a_second_(bytes_a_second), way_back_(way_back) {}

  void send(const Outbound::Message& message, Time now) {
    const auto takes = std::chrono::duration<double>(static_cast<double>(message.bytes->size()) / bytes_a_second_);
    free_at_ = std::max(now, free_at_) + std::chrono::duration_cast<Time>(takes);
    coming_.push_back({free_at_, message.bytes});
  }
  /// What is read by now, with the moments.
  std::vector<std::pair<Time, SharedBytes>> read(Time now) {
    std::vector<std::pair<Time, SharedBytes>> found;
    for (; !coming_.empty() && coming_.front().first <= now; coming_.pop_front()) {
      found.push_back(coming_.front());
      confirmations_.push_back({std::max(coming_.front().first, reads_from_) + way_back_, ++read_});
    }
    return found;
  }
  void confirm(Outbound& outbound, Time now) {
    for (; !confirmations_.empty() && confirmations_.front().first <= now; confirmations_.pop_front())
      ASSERT_TRUE(outbound.confirm(confirmations_.front().second, now));
  }
  /// The client is busy with something else until then.
  void sleep_until(Time when) { reads_from_ = when; }
  [[nodiscard]] bool is_asleep(Time now) const { return now < reads_from_; }

 private:
  double bytes_a_second_;
  Time way_back_;
  Time free_at_{0};
  Time reads_from_{0};
  std::uint64_t read_ = 0;
  std::deque<std::pair<Time, SharedBytes>> coming_;
  std::deque<std::pair<Time, std::uint64_t>> confirmations_;
};

/// A flight of so many snapshot bytes 20 times a second, with coverage and a large age map, shown over a slow way.
struct Show {
  explicit Show(SlowWay way_there, std::size_t snapshot_bytes = 400) : way(way_there), snapshot_size(snapshot_bytes) {
    outbound.pace();
  }

  static SharedBytes stamped(char kind, Time now, std::size_t size) {
    std::string text = kind + std::to_string(now.count()) + ' ';
    text.resize(std::max(size, text.size()), '.');
    return std::make_shared<const std::string>(std::move(text));
  }
  void pass(Time time) {
    for (const Time until = now + time; now < until; now += 5ms) {
      if (now % 50ms == 0ms) outbound.show(Latest::kSnapshot, stamped('s', now, snapshot_size));
      if (now % 200ms == 0ms) outbound.show(Latest::kCoverage, stamped('c', now, 550));
      if (now % 500ms == 0ms) outbound.show(Latest::kAge, stamped('a', now, 33'000));
      way.confirm(outbound, now);
      while (const auto message = outbound.next(now)) way.send(*message, now);
      if (!way.is_asleep(now)) take(way.read(now));
    }
  }
  void take(const std::vector<std::pair<Time, SharedBytes>>& messages) {
    for (const auto& [came_at, bytes] : messages) {
      const char kind = bytes->front() == 'V' ? 'p' : bytes->front();  // a part
      ++count[kind];
      if (kind == 'p') continue;
      oldest[kind] = std::max(oldest[kind], now - Time(std::stoll(bytes->substr(1))));
    }
  }

  Outbound outbound;
  SlowWay way;
  std::size_t snapshot_size;
  Time now{0};
  std::map<char, std::size_t> count;
  std::map<char, Time> oldest;  ///< when it was read, of each kind
};

TEST(PaceTest, Over_a_slow_way_with_endless_buffers_snapshots_arrive_young_and_the_rest_arrives_too) {
  Show show(SlowWay(25'000.0, 20ms));
  show.pass(5s);
  show.oldest.clear();
  show.count.clear();
  show.pass(60s);
  EXPECT_LT(show.oldest['s'], 350ms);
  EXPECT_GT(show.count['s'], 60U * 4U);
  EXPECT_GT(show.count['c'], 60U);
  EXPECT_GT(show.count['p'], 60U);  // the age map, in parts
}

TEST(PaceTest, The_past_of_a_large_swarm_leaves_most_of_a_slow_way_to_its_present) {
  Show show(SlowWay(25'000.0, 20ms), 65'000);
  show.outbound.show(Latest::kTrails, Show::stamped('t', show.now, 3'200'000));
  std::map<int, std::size_t> bytes_of;
  Time longest_gap{0};
  for (Time last{0}; show.now < 60s; show.now += 5ms) {
    if (show.now % 50ms == 0ms) show.outbound.show(Latest::kSnapshot, Show::stamped('s', show.now, 65'000));
    show.way.confirm(show.outbound, show.now);
    while (const auto message = show.outbound.next(show.now)) show.way.send(*message, show.now);
    for (const auto& [came_at, bytes] : show.way.read(show.now)) {
      bytes_of[bytes->at(5)] += bytes->size();
      longest_gap = std::max(longest_gap, show.now - std::exchange(last, show.now));
    }
  }
  const auto snapshots = bytes_of[static_cast<int>(Latest::kSnapshot)];
  const auto trails = bytes_of[static_cast<int>(Latest::kTrails)];
  EXPECT_GT(snapshots, 2 * trails);
  EXPECT_GT(trails, 200'000U);
  EXPECT_LT(longest_gap, 400ms);  // no part is so long that an answer would wait behind it
}

TEST(PaceTest, What_is_said_over_a_slow_way_is_not_stuck_behind_frames) {
  Show show(SlowWay(25'000.0, 20ms));
  show.pass(5s);
  for (int n = 0; n < 100; ++n) {
    ASSERT_TRUE(show.outbound.say(Show::stamped('x', show.now, 90)));
    show.pass(135ms);
  }
  show.pass(1s);
  EXPECT_EQ(show.count['x'], 100U);
  EXPECT_LT(show.oldest['x'], 300ms);
}

TEST(PaceTest, Without_confirmations_the_same_way_makes_snapshots_older_and_older) {
  Outbound outbound;
  SlowWay way(25'000.0, 20ms);
  Time oldest{0};
  for (Time now{0}; now < 20s; now += 5ms) {
    if (now % 50ms == 0ms) outbound.show(Latest::kSnapshot, Show::stamped('s', now, 400));
    if (now % 500ms == 0ms) outbound.show(Latest::kAge, Show::stamped('a', now, 33'000));
    while (const auto message = outbound.next(now)) way.send(*message, now);
    for (const auto& [came_at, bytes] : way.read(now))
      if (bytes->front() == 's') oldest = std::max(oldest, now - Time(std::stoll(bytes->substr(1))));
  }
  EXPECT_GT(oldest, 10s);
}

TEST(PaceTest, A_client_that_is_busy_finds_two_snapshots_and_then_new_ones) {
  Show show(SlowWay(1e7, 1ms));
  show.pass(5s);
  const std::size_t before = show.count['s'];
  show.way.sleep_until(show.now + 2s);
  show.pass(2s);
  EXPECT_EQ(show.count['s'], before);
  show.oldest.clear();
  show.pass(5ms);
  EXPECT_EQ(show.count['s'], before + Pace::kMostSnapshots);
  EXPECT_GT(show.oldest['s'], 1800ms);  // and says so
  show.pass(50ms);
  show.oldest.clear();
  show.pass(1s);
  EXPECT_LT(show.oldest['s'], 60ms);
}

TEST(PaceTest, Over_a_fast_way_every_snapshot_goes_whole_however_large) {
  Show show(SlowWay(1e8, 1ms), 370'000);
  show.pass(5s);
  show.count.clear();
  show.pass(10s);
  EXPECT_EQ(show.count['s'], 200U);
  EXPECT_EQ(show.count['p'], 0U);
}

TEST(PaceTest, A_long_way_is_not_taken_for_a_full_one) {
  Show show(SlowWay(1e6, 250ms));
  show.pass(20s);
  const std::size_t before = show.count['a'] + show.count['p'];
  show.oldest.clear();
  show.pass(10s);
  EXPECT_GE(show.count['a'] + show.count['p'] - before, 20U);  // every map
  EXPECT_LT(show.oldest['s'], 350ms);
}

TEST(PaceTest, Parts_put_together_are_what_was_shown) {
  Show show(SlowWay(25'000.0, 20ms));
  std::string whole;
  for (int n = 0; n < 20'000; ++n) whole += static_cast<char>('a' + n % 26);
  show.outbound.show(Latest::kTrails, std::make_shared<const std::string>(whole));
  std::string together;
  for (; together.size() < whole.size(); show.now += 5ms) {
    show.way.confirm(show.outbound, show.now);
    while (const auto message = show.outbound.next(show.now)) show.way.send(*message, show.now);
    for (const auto& [came_at, bytes] : show.way.read(show.now)) {
      ASSERT_EQ(static_cast<int>(bytes->at(4)), 7);
      ASSERT_EQ(static_cast<int>(bytes->at(5)), static_cast<int>(Latest::kTrails));
      together += bytes->substr(24);
    }
    ASSERT_LT(show.now, 10s);
  }
  EXPECT_EQ(together, whole);
  EXPECT_TRUE(show.outbound.is_empty());
}

TEST(PaceTest, A_confirmation_must_grow_up_to_what_was_sent) {
  Pace pace;
  EXPECT_FALSE(pace.confirm(1, 0s));
  for (int n = 0; n < 3; ++n) pace.sent(100, false, 0s);
  EXPECT_TRUE(pace.confirm(2, 10ms));
  EXPECT_FALSE(pace.confirm(2, 10ms));
  EXPECT_FALSE(pace.confirm(0, 10ms));
  EXPECT_FALSE(pace.confirm(4, 10ms));
  EXPECT_FALSE(pace.confirm(std::numeric_limits<std::uint64_t>::max(), 10ms));
  EXPECT_EQ(pace.bytes_under_way(), 100U);
  EXPECT_TRUE(pace.confirm(3, 10ms));
  EXPECT_EQ(pace.bytes_under_way(), 0U);
}

TEST(PaceTest, Whoever_is_asked_to_confirm_and_never_does_is_given_up) {
  Outbound outbound;
  outbound.pace();
  std::size_t said = 0;
  for (; outbound.say(std::make_shared<const std::string>("x")); ++said) (void)outbound.next(0s);
  EXPECT_EQ(said, Pace::kMostMessages);
  EXPECT_FALSE(Outbound().confirm(1, 0s));
}

Json confirm(std::uint64_t received) { return {{"type", "confirm"}, {"received", received}}; }

TEST(PaceTest, Who_says_so_in_hello_confirms_without_spending_what_one_may_say) {
  ConsoleForTests console;
  console.fly();
  const auto ana = console.join({{"confirms", true}});
  EXPECT_TRUE(ana.line->is_paced);
  for (std::uint64_t n = 1; n <= 1000; ++n) console.say(ana, confirm(n));
  EXPECT_EQ(ana.line->confirmed, 1000U);
  EXPECT_EQ(console.ask(ana, {{"type", "ping"}, {"id", 7}}).at("type"), "pong");
  EXPECT_TRUE(ana.line->of("refused").empty());
}

TEST(PaceTest, A_confirmation_that_cannot_be_is_refused_and_spends_as_any_message) {
  ConsoleForTests console;
  console.fly();
  const auto ana = console.join({{"confirms", true}});
  console.say(ana, confirm(0));
  EXPECT_EQ(ana.line->of("refused").back().at("code"), "invalid");
  for (int n = 0; n < 300; ++n) console.say(ana, confirm(0));
  EXPECT_EQ(ana.line->of("refused").back().at("code"), "too_fast");
  const auto ben = console.join();
  EXPECT_FALSE(ben.line->is_paced);
  console.say(ben, confirm(1));
  EXPECT_EQ(ben.line->of("refused").back().at("code"), "invalid");
  const auto stranger = console.connect();
  console.say(stranger, confirm(1));
  EXPECT_EQ(stranger.line->said.front().at("code"), "no_hello");
}

constexpr std::size_t kSteady = 96;  // in a snapshot's header

double double_at(const SharedBytes& frame, std::size_t offset) {
  double value = 0.0;
  std::memcpy(&value, frame->data() + offset, sizeof value);
  return value;
}

double milliseconds(Time time) { return std::chrono::duration<double, std::milli>(time).count(); }

TEST(PaceTest, Hello_pong_and_snapshots_tell_the_same_steady_clock) {
  ConsoleForTests console;
  console.fly();
  const double joined_ms = milliseconds(console.now);
  const auto ana = console.join();
  EXPECT_EQ(ana.line->of("hello").front().at("steady_ms"), joined_ms);
  console.pass(1s);
  const double asked_ms = milliseconds(console.now);
  EXPECT_EQ(console.ask(ana, {{"type", "ping"}, {"id", 1}}).at("steady_ms"), asked_ms);
  const SharedBytes snapshot = ana.line->shown[Latest::kSnapshot];
  constexpr std::size_t kWall = 32;  // the console's two clocks are one here
  EXPECT_EQ(double_at(snapshot, kSteady), double_at(snapshot, kWall));
  EXPECT_GE(double_at(snapshot, kSteady), milliseconds(console.newest().computed_at - 50ms));
}

TEST(PaceTest, A_picture_of_a_world_that_stands_still_is_as_old_as_its_frame) {
  ConsoleForTests console;
  console.fly();
  const auto ana = console.join();
  console.ask(ana, {{"type", "pause"}, {"id", 1}});
  console.pass(5s);
  EXPECT_GT(double_at(ana.line->shown[Latest::kSnapshot], kSteady), milliseconds(console.now - 60ms));
  EXPECT_LT(milliseconds(console.newest().computed_at), milliseconds(console.now - 4s));
}

}  // namespace
}  // namespace vigil::console
