#include "vigil/core/ergodic/coverage_statistics.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vigil/core/ergodic/literal_kernel.hpp"

namespace vigil::ergodic {
namespace {

constexpr field::Field kField{.length_x = 3.0, .length_y = 2.0};
constexpr int kIndices = 6;

const Basis& basis() {
  static const Basis instance(kField, kIndices - 1, 1.5);
  return instance;
}

Coefficients average(const CoverageStatistics& statistics) {
  Coefficients c_k(kIndices, kIndices);
  statistics.average(c_k);
  return c_k;
}

double largest(const Coefficients& difference) { return difference.cwiseAbs().maxCoeff(); }

// c_0 h_0: how much mass the averages claim.
double mass(const CoverageStatistics& statistics) { return average(statistics)(0, 0) * basis().norm()(0, 0); }

// One sample of a swarm whose active set changes from time to time.
struct Sample {
  std::vector<Vec2> positions;
  std::size_t active_set;
  double dt_s;
};

std::vector<Sample> any_mission() {
  std::vector<Sample> mission(*rc::gen::inRange<std::size_t>(1, 40));
  std::size_t drones = 3;
  for (Sample& sample : mission) {
    if (*rc::gen::inRange(0, 4) == 0) drones = *rc::gen::inRange<std::size_t>(0, 12);
    for (std::size_t i = 0; i < drones; ++i) {
      sample.positions.emplace_back(*rc::gen::inRange(0, 3001) * 1e-3, *rc::gen::inRange(0, 2001) * 1e-3);
    }
    sample.active_set = drones;
    sample.dt_s = *rc::gen::element(0.01, 0.02, 0.05);
  }
  return mission;
}

Coefficients sum_of_basis(const std::vector<Vec2>& positions) {
  Coefficients sum = Coefficients::Zero(kIndices, kIndices);
  add_basis_literally(basis(), positions, std::vector<double>(positions.size(), 1.0), sum);
  return sum;
}

void play(const std::vector<Sample>& mission, CoverageStatistics& statistics) {
  Kernel kernel(basis());
  for (const Sample& sample : mission) statistics.add(kernel, sample.positions, sample.active_set, sample.dt_s);
}

TEST(CoverageStatisticsTest, Before_the_first_sample_all_is_zero) {
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14}) {
    CoverageStatistics statistics(basis(), accounting, std::nullopt);
    EXPECT_FALSE(statistics.has_samples());
    EXPECT_EQ(largest(average(statistics)), 0.0);
    play({{.positions = {}, .active_set = 1, .dt_s = 0.02}}, statistics);
    EXPECT_FALSE(statistics.has_samples());
    EXPECT_EQ(largest(average(statistics)), 0.0);
  }
}

TEST(CoverageStatisticsTest, Afresh_means_as_if_nothing_had_been) {
  const std::vector<Sample> first{{{{1.0, 1.0}}, 1, 0.02}, {{{2.0, 1.0}, {1.0, 0.3}}, 2, 0.02}};
  const std::vector<Sample> second{{{{0.5, 0.7}}, 1, 0.02}};
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14}) {
    CoverageStatistics used(basis(), accounting, 10.0);
    CoverageStatistics fresh(basis(), accounting, 10.0);
    play(first, used);
    used.reset();
    EXPECT_FALSE(used.has_samples());
    play(second, used);
    play(second, fresh);
    EXPECT_EQ(average(used), average(fresh));
  }
}

RC_GTEST_PROP(CoverageStatisticsTest, Drone_time_is_the_mean_over_drone_seconds, ()) {
  const std::vector<Sample> mission = any_mission();
  CoverageStatistics statistics(basis(), Accounting::kDroneTime, std::nullopt);
  play(mission, statistics);
  Coefficients sum = Coefficients::Zero(kIndices, kIndices);
  double drone_seconds = 0.0;
  for (const Sample& sample : mission) {
    sum += sample.dt_s * sum_of_basis(sample.positions);
    drone_seconds += sample.dt_s * static_cast<double>(sample.positions.size());
  }
  RC_ASSERT(statistics.has_samples() == (drone_seconds > 0.0));
  if (drone_seconds > 0.0) RC_ASSERT(largest(average(statistics) - sum / drone_seconds) < 1e-12);
}

RC_GTEST_PROP(CoverageStatisticsTest, Elapsed_time_is_the_mean_over_seconds_of_the_mean_over_drones, ()) {
  const std::vector<Sample> mission = any_mission();
  CoverageStatistics statistics(basis(), Accounting::kElapsedTime, std::nullopt);
  play(mission, statistics);
  Coefficients sum = Coefficients::Zero(kIndices, kIndices);
  double seconds = 0.0;
  for (const Sample& sample : mission) {
    if (sample.positions.empty()) continue;
    sum += sample.dt_s * sum_of_basis(sample.positions) / static_cast<double>(sample.positions.size());
    seconds += sample.dt_s;
  }
  if (seconds > 0.0) RC_ASSERT(largest(average(statistics) - sum / seconds) < 1e-12);
}

RC_GTEST_PROP(CoverageStatisticsTest, Paper_eq_14_adds_up_the_averages_of_the_phases, ()) {
  const std::vector<Sample> mission = any_mission();
  CoverageStatistics statistics(basis(), Accounting::kPaperEq14, std::nullopt);
  play(mission, statistics);
  Coefficients expected = Coefficients::Zero(kIndices, kIndices);
  for (std::size_t begin = 0, end = 0; begin < mission.size(); begin = end) {
    Coefficients sum = Coefficients::Zero(kIndices, kIndices);
    double seconds = 0.0;
    for (end = begin; end < mission.size() && mission[end].active_set == mission[begin].active_set; ++end) {
      sum += mission[end].dt_s * sum_of_basis(mission[end].positions);
      seconds += mission[end].dt_s;
    }
    const std::size_t drones = mission[begin].positions.size();
    if (drones > 0) expected += sum / (static_cast<double>(drones) * seconds);
  }
  RC_ASSERT(largest(average(statistics) - expected) < 1e-12);
}

RC_GTEST_PROP(CoverageStatisticsTest, The_total_mass_is_1_whatever_happens, ()) {
  const std::vector<Sample> mission = any_mission();
  const std::optional<double> memory_s = *rc::gen::element<std::optional<double>>(std::nullopt, 0.05, 3.0);
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime}) {
    CoverageStatistics statistics(basis(), accounting, memory_s);
    play(mission, statistics);
    RC_ASSERT(std::abs(mass(statistics) - (statistics.has_samples() ? 1.0 : 0.0)) < 1e-13);
  }
}

RC_GTEST_PROP(CoverageStatisticsTest, A_copy_goes_on_to_the_last_bit_as_the_original, ()) {
  const std::vector<Sample> before = any_mission();
  const std::vector<Sample> after = any_mission();
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14}) {
    CoverageStatistics original(basis(), accounting, 2.0);
    play(before, original);
    CoverageStatistics copy = original;
    play(after, original);
    play(after, copy);
    RC_ASSERT(average(original) == average(copy));
  }
}

// Three drones for 23 s, then two: how far c_k jumps within the first sample after the failure.
double jump_at_a_failure(Accounting accounting, double* mass_after = nullptr) {
  CoverageStatistics statistics(basis(), accounting, std::nullopt);
  Kernel kernel(basis());
  const std::vector<Vec2> three{{0.5, 0.5}, {1.5, 1.2}, {2.5, 0.4}};
  for (int i = 0; i < 1150; ++i) statistics.add(kernel, three, 7, 0.02);
  const Coefficients before = average(statistics);
  const std::vector<Vec2> two{three[0], three[2]};
  statistics.add(kernel, two, 5, 0.02);
  if (mass_after != nullptr) *mass_after = mass(statistics);
  return largest(average(statistics) - before);
}

TEST(CoverageStatisticsTest, A_failure_does_not_make_drone_time_jump) {
  EXPECT_LT(jump_at_a_failure(Accounting::kDroneTime), 1e-3);
  EXPECT_LT(jump_at_a_failure(Accounting::kElapsedTime), 1e-3);
}

TEST(CoverageStatisticsTest, A_failure_makes_paper_eq_14_jump_to_a_total_mass_of_2) {
  double mass_after = 0.0;
  EXPECT_GT(jump_at_a_failure(Accounting::kPaperEq14, &mass_after), 0.4);
  EXPECT_NEAR(mass_after, 2.0, 1e-12);
}

TEST(CoverageStatisticsTest, A_sample_without_drones_ends_a_phase_of_paper_eq_14_only) {
  const std::vector<Sample> mission{{{{1.0, 1.0}}, 1, 0.02}, {{}, 0, 0.02}, {{{1.0, 1.0}}, 1, 0.02}};
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14}) {
    CoverageStatistics statistics(basis(), accounting, std::nullopt);
    play(mission, statistics);
    EXPECT_NEAR(mass(statistics), accounting == Accounting::kPaperEq14 ? 2.0 : 1.0, 1e-14);
  }
}

// The past fades by e within memory_s: after moving, what is left of the old place is exp(-t / memory).
TEST(CoverageStatisticsTest, With_a_memory_a_new_place_replaces_the_old_one_exponentially) {
  constexpr double kMemory = 5.0;
  CoverageStatistics statistics(basis(), Accounting::kDroneTime, kMemory);
  Kernel kernel(basis());
  const std::vector<Vec2> old_place{{0.4, 0.4}};
  const std::vector<Vec2> new_place{{2.4, 1.4}};
  for (int i = 0; i < 10000; ++i) statistics.add(kernel, old_place, 1, 0.02);
  EXPECT_LT(largest(average(statistics) - sum_of_basis(old_place)), 1e-12);
  for (int i = 0; i < 500; ++i) statistics.add(kernel, new_place, 1, 0.02);
  const double left = std::exp(-10.0 / kMemory);
  EXPECT_LT(largest(average(statistics) - left * sum_of_basis(old_place) - (1.0 - left) * sum_of_basis(new_place)),
            1e-12);
}

TEST(CoverageStatisticsTest, The_fading_does_not_depend_on_how_often_is_sampled) {
  CoverageStatistics often(basis(), Accounting::kDroneTime, 1.0);
  CoverageStatistics seldom(basis(), Accounting::kDroneTime, 1.0);
  Kernel kernel(basis());
  for (const double x : {0.5, 2.5}) {
    const std::vector<Vec2> position{{x, 1.3}};
    for (int i = 0; i < 100; ++i) often.add(kernel, position, 1, 0.01);
    seldom.add(kernel, position, 1, 1.0);
  }
  EXPECT_LT(largest(average(often) - average(seldom)), 1e-12);
}

}  // namespace
}  // namespace vigil::ergodic
