#include "vigil/core/safety/planar_qp_batch.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "vigil/testing/random_planar_qp.hpp"

namespace vigil::safety {
namespace {

using InstructionSet = PlanarQpBatch::InstructionSet;

/// Those that this processor has.
std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::kPortable};
  const InstructionSet best = PairRows::best_instruction_set();
  if (best != InstructionSet::kPortable) sets.push_back(InstructionSet::kAvx2);
  if (best == InstructionSet::kAvx512) sets.push_back(InstructionSet::kAvx512);
  return sets;
}

PlanarProblem small_problem(PlanarProblems& problems) {
  PlanarProblem problem = problems.next();
  while (problem.rows.size() > PlanarQpBatch::kMostRows) problem = problems.next();
  return problem;
}

void put(const PlanarProblem& problem, std::size_t lane, PlanarQpBatch& batch) {
  batch.begin(lane, problem.u_nom);
  for (const HalfPlane& row : problem.rows) batch.add(lane, row);
}

void expect_same(const PlanarQpSolution& lane, const PlanarQpSolution& alone, const PlanarProblem& problem) {
  ASSERT_EQ(lane.u, alone.u) << to_string(problem);
  ASSERT_EQ(lane.active, alone.active) << to_string(problem);
  ASSERT_EQ(lane.on_disk, alone.on_disk) << to_string(problem);
  ASSERT_TRUE(alone.feasible) << to_string(problem);
}

TEST(PlanarQpBatch, What_a_batch_solves_has_the_bits_of_one_after_the_other_on_every_instruction_set) {
  for (const InstructionSet set : instruction_sets()) {
    PlanarProblems problems(21);
    PlanarQpBatch batch(set);
    std::size_t solved = 0;
    std::size_t left = 0;
    for (int round = 0; round < 20'000; ++round) {
      std::array<PlanarProblem, PlanarQpBatch::kLanes> lanes;
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        lanes[lane] = small_problem(problems);
        lanes[lane].radius = lanes[0].radius;
        put(lanes[lane], lane, batch);
      }
      batch.solve(lanes[0].radius);
      for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
        const PlanarQpSolution alone = solve(lanes[lane].u_nom, lanes[lane].rows, lanes[lane].radius);
        if (batch.is_solved(lane)) {
          expect_same(batch.solution(lane), alone, lanes[lane]);
          ++solved;
        } else if (alone.feasible) {
          ++left;
        }
      }
    }
    EXPECT_GT(solved, 60'000U);
    EXPECT_LT(20 * left, solved);  // with zero normals, or as good as contradictory
  }
}

TEST(PlanarQpBatch, What_is_not_plain_is_left_to_the_solver_that_takes_its_time) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const InstructionSet set : instruction_sets()) {
    PlanarQpBatch batch(set);
    for (std::size_t lane = 0; lane < PlanarQpBatch::kLanes; ++lane) batch.begin(lane, {0.1, 0.2});
    batch.begin(1, {nan, 0.0});
    batch.begin(2, {1e40, 0.0});
    batch.add(3, {Vec2::Zero(), -1.0, Priority::kDoubt});
    batch.add(4, {Vec2(1.0, nan), 0.0, Priority::kDoubt});
    batch.add(5, {Vec2(1.0, 0.0), 2.0, Priority::kDoubt});  // out of reach
    batch.add(6, {Vec2(1.0, 0.0), 0.2, Priority::kDoubt});
    batch.solve(0.3);
    for (const std::size_t lane : {1U, 2U, 3U, 4U, 5U}) EXPECT_FALSE(batch.is_solved(lane)) << lane;
    for (const std::size_t lane : {0U, 6U, 7U}) EXPECT_TRUE(batch.is_solved(lane)) << lane;
    EXPECT_EQ(batch.solution(7).u, Vec2(0.1, 0.2));
    EXPECT_EQ(batch.solution(6).u, Vec2(0.2, 0.2));
    batch.solve(0.0);
    EXPECT_FALSE(batch.is_solved(0));
  }
}

}  // namespace
}  // namespace vigil::safety
