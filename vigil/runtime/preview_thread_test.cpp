#include "vigil/runtime/preview_thread.hpp"

#include <future>
#include <latch>
#include <vector>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

/// A job that runs until it is cancelled, and says when it runs.
PreviewThread::Job endless(std::latch& runs) {
  return [&runs](const std::atomic<bool>& cancelled) {
    runs.count_down();
    while (!cancelled.load()) std::this_thread::yield();
  };
}

/// A job that says whether it was cancelled before it began.
PreviewThread::Job ask(std::promise<bool>& is_cancelled) {
  return [&is_cancelled](const std::atomic<bool>& cancelled) { is_cancelled.set_value(cancelled.load()); };
}

TEST(PreviewThreadTest, A_newer_request_ends_what_runs_and_what_waits_for_the_same_asker) {
  std::latch runs(1);
  std::promise<bool> older;
  std::promise<bool> newest;
  PreviewThread thread;
  ASSERT_TRUE(thread.submit(1, endless(runs)));
  runs.wait();
  ASSERT_TRUE(thread.submit(1, ask(older)));
  ASSERT_TRUE(thread.submit(1, ask(newest)));
  EXPECT_FALSE(newest.get_future().get());
  older.get_future().get();  // called, cancelled or not: that depends on who was faster
}

TEST(PreviewThreadTest, What_waits_is_called_cancelled_once_something_newer_waits) {
  std::latch runs(1);
  std::promise<bool> older;
  std::promise<bool> newest;
  PreviewThread thread;
  ASSERT_TRUE(thread.submit(1, endless(runs)));
  runs.wait();
  ASSERT_TRUE(thread.submit(2, ask(older)));
  ASSERT_TRUE(thread.submit(2, ask(newest)));
  ASSERT_TRUE(thread.submit(1, [](const std::atomic<bool>&) {}));  // only now the first ends
  EXPECT_TRUE(older.get_future().get());
  EXPECT_FALSE(newest.get_future().get());
}

TEST(PreviewThreadTest, Another_asker_cancels_nothing_and_waits_its_turn) {
  std::latch runs(1);
  std::atomic<bool> may_end{false};
  std::promise<bool> first;
  std::promise<bool> second;
  PreviewThread thread;
  ASSERT_TRUE(thread.submit(1, [&](const std::atomic<bool>& cancelled) {
    runs.count_down();
    while (!may_end.load()) std::this_thread::yield();
    first.set_value(cancelled.load());
  }));
  runs.wait();
  ASSERT_TRUE(thread.submit(2, ask(second)));
  may_end = true;
  EXPECT_FALSE(first.get_future().get());
  EXPECT_FALSE(second.get_future().get());
}

TEST(PreviewThreadTest, More_than_it_can_remember_is_refused) {
  std::latch runs(1);
  PreviewThread thread;
  ASSERT_TRUE(thread.submit(0, endless(runs)));
  runs.wait();
  for (std::uint64_t asker = 1; asker <= PreviewThread::kMostJobs; ++asker)
    ASSERT_TRUE(thread.submit(asker, [](const std::atomic<bool>&) {}));
  EXPECT_FALSE(thread.submit(0, [](const std::atomic<bool>&) {}));
}

TEST(PreviewThreadTest, Its_end_cancels_and_calls_everything_that_was_asked_for) {
  std::latch runs(1);
  std::promise<bool> waiting;
  std::future<bool> was_cancelled = waiting.get_future();
  {
    PreviewThread thread;
    ASSERT_TRUE(thread.submit(1, endless(runs)));
    runs.wait();
    ASSERT_TRUE(thread.submit(2, ask(waiting)));
  }
  EXPECT_TRUE(was_cancelled.get());
}

}  // namespace
}  // namespace vigil::runtime
