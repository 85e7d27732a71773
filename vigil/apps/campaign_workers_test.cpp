#include "vigil/apps/campaign_workers.hpp"

#include <algorithm>
#include <latch>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vigil::apps {
namespace {

/// Long enough for any machine; nothing waits so long unless it hangs.
constexpr std::chrono::minutes kPatience{2};

std::vector<std::uint64_t> runs(std::size_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
  return numbers;
}

std::vector<std::string> all_lines(CampaignWorkers& workers) {
  std::vector<std::string> lines;
  while (!workers.is_over())
    if (auto line = workers.next_line(kPatience)) lines.push_back(*line);
  return lines;
}

TEST(CampaignWorkers, Every_run_is_flown_once_however_many_threads_there_are) {
  for (const unsigned threads : {1U, 2U, 7U}) {
    CampaignWorkers workers(runs(500), threads, [](std::uint64_t run) { return std::to_string(1000 + run); });
    std::vector<std::string> lines = all_lines(workers);
    std::ranges::sort(lines);
    ASSERT_EQ(lines.size(), 500U);
    for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i], std::to_string(1000 + i));
  }
}

TEST(CampaignWorkers, After_a_stop_the_runs_under_way_are_finished_and_no_other_begins) {
  std::latch has_begun(2);
  std::latch may_end(1);
  CampaignWorkers workers(runs(500), 2, [&](std::uint64_t run) {
    has_begun.count_down();
    may_end.wait();
    return std::to_string(run);
  });
  has_begun.wait();
  workers.stop();
  may_end.count_down();
  EXPECT_EQ(all_lines(workers).size(), 2U);
}

TEST(CampaignWorkers, What_a_run_throws_reaches_the_reader_after_the_lines_before_it) {
  CampaignWorkers workers(runs(10), 1, [](std::uint64_t run) {
    if (run == 3) throw std::runtime_error("the fourth fails");
    return std::to_string(run);
  });
  for (int i = 0; i < 3; ++i) EXPECT_EQ(workers.next_line(kPatience), std::to_string(i));
  EXPECT_THROW(static_cast<void>(workers.next_line(kPatience)), std::runtime_error);
}

TEST(CampaignWorkers, Can_be_left_while_lines_wait) {
  CampaignWorkers workers(runs(500), 2, [](std::uint64_t run) { return std::to_string(run); });
  EXPECT_TRUE(workers.next_line(kPatience));
}

}  // namespace
}  // namespace vigil::apps
