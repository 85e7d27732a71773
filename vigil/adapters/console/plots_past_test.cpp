// What plots showed before a client came.
#include <cstring>

#include <gtest/gtest.h>

#include "vigil/adapters/console/console_for_tests.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;
using Latest = ClientLine::Latest;

/// The times of a history frame's rows.
std::vector<double> times_in(const std::string& frame) {
  constexpr std::size_t kCountAt = 12;
  constexpr std::size_t kTimesAt = 32;
  std::uint32_t rows = 0;
  std::memcpy(&rows, frame.data() + kCountAt, sizeof(rows));
  std::vector<double> times(rows);
  std::memcpy(times.data(), frame.data() + kTimesAt, rows * sizeof(double));
  return times;
}

TEST(PlotsPastTest, Who_comes_later_is_shown_what_plots_showed_from_the_flights_beginning_on) {
  ConsoleForTests console;
  console.fly();
  console.pass(30s);
  const auto ana = console.join();
  const std::vector<double> times = times_in(*ana.line->shown.at(Latest::kHistory));
  EXPECT_NEAR(times.front(), 0.0, 0.1);
  EXPECT_NEAR(times.back(), 30.0, 0.15);
  EXPECT_NEAR(static_cast<double>(times.size()), 300.0, 60.0);
  console.pass(5s);
  EXPECT_EQ(ana.line->shows.at(Latest::kHistory), 1);  // what comes then is in the snapshots
}

TEST(PlotsPastTest, Another_mission_has_a_past_of_its_own) {
  ConsoleForTests console;
  console.fly();
  console.pass(10s);
  console.desk.begin(runtime::small_mission(), nullptr);
  console.pass(1s);
  const auto ana = console.join();
  EXPECT_LE(times_in(*ana.line->shown.at(Latest::kHistory)).back(), 1.0);
}

}  // namespace
}  // namespace vigil::console
