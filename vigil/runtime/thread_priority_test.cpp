#include "vigil/runtime/thread_priority.hpp"

#include <sched.h>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

TEST(ThreadPriorityTest, A_thread_has_real_time_priority_exactly_where_it_is_told_so) {
  const int before = sched_getscheduler(0);
  bool is_told_so = false;
  int policy = -1;
  std::thread([&] {
    is_told_so = take_real_time_priority();
    policy = sched_getscheduler(0);
  }).join();
  EXPECT_EQ(policy, is_told_so ? SCHED_FIFO : before);
  EXPECT_EQ(sched_getscheduler(0), before);  // who asks asks for itself alone
}

TEST(ThreadPriorityTest, Threads_that_are_started_with_real_time_priority_have_it_where_it_is_given) {
  const int before = sched_getscheduler(0);
  int policy_of_starter = -1;
  int policy_of_started = -1;
  start_with_real_time_priority([&] {
    policy_of_starter = sched_getscheduler(0);
    std::thread([&] { policy_of_started = sched_getscheduler(0); }).join();
  });
  EXPECT_EQ(policy_of_started, policy_of_starter);
  EXPECT_EQ(sched_getscheduler(0), before);
}

TEST(ThreadPriorityTest, What_keeps_a_thread_from_starting_is_thrown_to_who_asked_for_it) {
  EXPECT_THROW(start_with_real_time_priority([] { throw std::runtime_error("no thread"); }), std::runtime_error);
}

}  // namespace
}  // namespace vigil::runtime
