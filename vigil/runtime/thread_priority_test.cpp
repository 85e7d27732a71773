#include "vigil/runtime/thread_priority.hpp"

#include <sched.h>
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

}  // namespace
}  // namespace vigil::runtime
