#include "vigil/runtime/hand_over.hpp"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

TEST(InboxTest, Things_arrive_in_order_all_of_a_push_or_none) {
  Inbox<int> inbox(3);
  EXPECT_TRUE(inbox.push({1, 2}));
  EXPECT_FALSE(inbox.push({3, 4}));
  EXPECT_TRUE(inbox.push({5}));
  EXPECT_EQ(inbox.take(), (std::vector<int>{1, 2, 5}));
  EXPECT_TRUE(inbox.take().empty());
  EXPECT_TRUE(inbox.push({6, 7, 8}));
}

TEST(OutboxTest, What_finds_no_room_is_counted) {
  Outbox<int> outbox(2);
  for (int n = 0; n < 3; ++n) outbox.note(n);
  outbox.send();
  outbox.note(3);
  outbox.send();
  EXPECT_EQ(outbox.take(), (std::vector<int>{0, 1}));
  EXPECT_EQ(outbox.lost(), 2U);
}

TEST(LatestTest, A_reader_gets_the_newest_once) {
  Latest<int> latest(0);
  int seen = -1;
  std::size_t version = 0;
  EXPECT_FALSE(latest.read(seen, version));
  latest.mine() = 1;
  EXPECT_TRUE(latest.publish());
  latest.mine() = 2;
  EXPECT_TRUE(latest.publish());
  EXPECT_TRUE(latest.read(seen, version));
  EXPECT_EQ(seen, 2);
  EXPECT_FALSE(latest.read(seen, version));
}

// The control thread never waits; whatever it says arrives whole, in order, and at last, however often others look.
TEST(HandOverTest, Two_threads_lose_and_mix_nothing) {
  constexpr int kCount = 5'000;
  Inbox<int> inbox(64);
  Outbox<int> outbox(100'000);
  Latest<std::pair<int, int>> latest(0, 0);
  std::atomic<bool> has_all = false;
  std::thread control([&] {
    int received = 0;
    while (!has_all) {
      for (const int item : inbox.take()) {
        EXPECT_EQ(item, received++);
        outbox.note(item);
        latest.mine() = {item, -item};
        latest.publish();
      }
      outbox.send();
    }
  });
  int next_back = 0;
  std::pair<int, int> seen;
  std::size_t version = 0;
  for (int sent = 0; next_back < kCount;) {
    if (sent < kCount && inbox.push({sent})) ++sent;
    for (const int item : outbox.take()) EXPECT_EQ(item, next_back++);
    if (latest.read(seen, version)) {
      EXPECT_EQ(seen.first, -seen.second);
    }
  }
  has_all = true;
  control.join();
  EXPECT_EQ(next_back, kCount);
}

TEST(OnRequestTest, Nothing_is_copied_for_nobody) {
  OnRequest<int> on_request(0);
  on_request.give(1);
  EXPECT_FALSE(on_request.take());
}

TEST(OnRequestTest, Who_asks_gets_the_value_as_it_is_then_and_not_later) {
  OnRequest<int> on_request(0);
  on_request.ask();
  EXPECT_FALSE(on_request.take());
  on_request.give(1);
  on_request.give(2);
  EXPECT_EQ(on_request.take(), 1);
  on_request.ask();
  EXPECT_FALSE(on_request.take());
  on_request.give(3);
  EXPECT_EQ(on_request.take(), 3);
}

}  // namespace
}  // namespace vigil::runtime
