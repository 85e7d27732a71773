#include "vigil/core/parallel/workers.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/testing/allocation_guard.hpp"

namespace vigil::parallel {
namespace {

class WorkersTest : public ::testing::TestWithParam<std::size_t> {
 protected:
  Workers workers_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, WorkersTest, ::testing::Values(1, 2, 3, kMostThreads));

TEST_P(WorkersTest, Every_chunk_is_done_exactly_once_in_run_after_run) {
  std::vector<int> done(1000);
  for (std::size_t round = 0; round < 300; ++round) {
    const std::size_t chunks = (round * 37) % done.size();
    const auto count = [&](std::size_t chunk, std::size_t) { ++done[chunk]; };
    std::fill(done.begin(), done.end(), 0);
    workers_.run(chunks, Task(count));
    for (std::size_t chunk = 0; chunk < done.size(); ++chunk) ASSERT_EQ(done[chunk], chunk < chunks ? 1 : 0);
  }
}

TEST_P(WorkersTest, What_chunks_compute_does_not_depend_on_who_computes_it) {
  std::vector<double> shared(200);
  const auto compute = [&](std::size_t chunk, std::size_t) {
    double value = static_cast<double>(chunk);
    for (int i = 0; i < 100; ++i) value = std::sin(value) + 1.0;
    shared[chunk] = value;
  };
  std::vector<double> alone(shared.size());
  workers_.run(shared.size(), Task(compute));
  std::swap(alone, shared);
  for (std::size_t chunk = 0; chunk < alone.size(); ++chunk) compute(chunk, 0);
  EXPECT_EQ(alone, shared);
}

TEST_P(WorkersTest, No_two_chunks_of_one_thread_overlap) {
  std::array<std::atomic<int>, kMostThreads> busy{};
  std::atomic<int> overlaps{0};
  std::atomic<int> strangers{0};
  const auto check = [&](std::size_t, std::size_t thread) {
    if (thread >= workers_.threads()) return void(++strangers);
    if (busy[thread].fetch_add(1) != 0) ++overlaps;
    for (int i = 0; i < 50; ++i) std::atomic_signal_fence(std::memory_order_seq_cst);
    busy[thread].fetch_sub(1);
  };
  for (int round = 0; round < 100; ++round) workers_.run(64, Task(check));
  EXPECT_EQ(overlaps, 0);
  EXPECT_EQ(strangers, 0);
}

TEST_P(WorkersTest, A_run_allocates_nothing) {
  std::uint64_t sum = 0;
  std::array<std::uint64_t, 64> parts{};
  const auto square = [&](std::size_t chunk, std::size_t) { parts[chunk] = chunk * chunk; };
  testing::AllocationGuard guard;
  for (int round = 0; round < 100; ++round) {
    workers_.run(parts.size(), Task(square));
    for (const std::uint64_t part : parts) sum += part;
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(sum, 100U * (63U * 64U * 127U / 6U));
}

TEST_P(WorkersTest, The_parts_of_a_range_cover_it_without_gaps) {
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<int> covered(count);
    for_each_part(&workers_, count, 7, [&](std::size_t first, std::size_t last, std::size_t) {
      for (std::size_t i = first; i < last; ++i) ++covered[i];
    });
    EXPECT_EQ(covered, std::vector<int>(count, 1));
  }
}

TEST(Workers, Several_threads_share_a_run) {
  Workers workers(2);
  std::atomic<int> arrived{0};
  const auto meet = [&](std::size_t, std::size_t) {  // ends only where two threads are in it at once
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  };
  workers.run(2, Task(meet));
  EXPECT_EQ(arrived, 2);
}

TEST(Workers, They_end_cleanly_whether_or_not_they_ever_worked) {
  const auto nothing = [](std::size_t, std::size_t) {};
  for (int round = 0; round < 50; ++round) {
    Workers workers(1 + static_cast<std::size_t>(round) % 4);
    if (round % 2 == 0) workers.run(3, Task(nothing));
  }
}

TEST(Workers, Without_workers_the_parts_are_done_in_order) {
  std::vector<std::size_t> firsts;
  for_each_part(nullptr, 10, 4, [&](std::size_t first, std::size_t, std::size_t) { firsts.push_back(first); });
  EXPECT_EQ(firsts, (std::vector<std::size_t>{0, 4, 8}));
}

}  // namespace
}  // namespace vigil::parallel
