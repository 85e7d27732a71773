#include <gtest/gtest.h>

#include "vigil/testing/random_planar_qp.hpp"

namespace vigil::safety {
namespace {

TEST(PlanarQpMillion, A_million_random_problems_have_the_slow_solvers_answer) {
  PlanarProblems problems(20240611);
  int sensitive = 0;
  int infeasible = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const PlanarProblem problem = problems.next();
    const PlanarQpSolution solution = solve(problem.u_nom, problem.rows, problem.radius);
    const Agreement agreement = compare(problem, solution);
    ASSERT_NE(agreement, Agreement::kDifferent) << "problem " << i << '\n' << to_string(problem);
    sensitive += agreement == Agreement::kSensitive ? 1 : 0;
    infeasible += solution.feasible ? 0 : 1;
  }
  EXPECT_GT(infeasible, 100'000);
  EXPECT_LT(sensitive, 60'000);
  RecordProperty("sensitive", sensitive);
  RecordProperty("infeasible", infeasible);
}

}  // namespace
}  // namespace vigil::safety
