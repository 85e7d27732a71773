#include "vigil/core/safety/planar_qp.hpp"

#include <fstream>
#include <limits>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "vigil/testing/random_planar_qp.hpp"

namespace vigil::safety {
namespace {

HalfPlane row(double x, double y, double offset, Priority priority = Priority::kSeparation) {
  return {Vec2(x, y), offset, priority};
}

/// How far u is from satisfying the row, metres per second.
double violation(const HalfPlane& r, const Vec2& u) {
  const double length = r.normal.norm();
  return length > 0.0 ? (r.offset - r.normal.dot(u)) / length : r.offset;
}

double worst(std::span<const HalfPlane> rows, const Vec2& u) {
  double result = 0.0;
  for (const HalfPlane& r : rows) result = std::max(result, violation(r, u));
  return result;
}

TEST(PlanarQp, Without_rows_u_is_the_nominal_velocity_or_its_projection_on_the_disk) {
  EXPECT_EQ(solve(Vec2(0.1, 0.2), {}, 0.3).u, Vec2(0.1, 0.2));
  const PlanarQpSolution fast = solve(Vec2(3.0, 4.0), {}, 0.3);
  EXPECT_LT((fast.u - Vec2(0.18, 0.24)).norm(), 1e-15);
  EXPECT_TRUE(fast.on_disk);
  EXPECT_TRUE(fast.feasible);
}

TEST(PlanarQp, The_reference_problems_have_the_reference_solutions) {
  std::ifstream file(VIGIL_REFERENCE_DIR "/qp_problems.jsonl");
  int count = 0;
  for (std::string line; std::getline(file, line); ++count) {
    const auto problem = nlohmann::json::parse(line);
    std::vector<HalfPlane> rows;
    for (std::size_t i = 0; i < problem["A"].size(); ++i) {
      rows.push_back(row(problem["A"][i][0], problem["A"][i][1], problem["b"][i]));
    }
    const double radius = problem["R"];
    const PlanarQpSolution solution = solve(Vec2(problem["u_nom"][0], problem["u_nom"][1]), rows, radius);
    const std::string name = "problem " + problem["id"].dump() + " " + problem["tag"].dump();
    if (!problem["borderline"]) {
      EXPECT_EQ(solution.feasible, problem["feasible"].get<bool>()) << name;
    }
    const double scale = std::max(1.0, problem["viol"].get<double>());
    EXPECT_NEAR(solution.violation[static_cast<std::size_t>(Priority::kSeparation)], problem["viol"], 1e-9 * scale)
        << name;
    EXPECT_LE(worst(rows, solution.u), problem["viol"].get<double>() + 1e-9 * scale) << name;
    EXPECT_LE(solution.u.norm(), radius * (1.0 + 1e-15)) << name;
    if (problem["judge"] == "solution") {
      EXPECT_LE((solution.u - Vec2(problem["u"][0], problem["u"][1])).norm(), problem["tol_u"]) << name;
    }
  }
  EXPECT_EQ(count, 200);
}

/// u - u_nom is a non-negative combination of the normals of rows that are tight and of -u where the disk is: the
/// conditions of Karush, Kuhn and Tucker, with two of them at most. Returns the part of u - u_nom that is not.
double kkt_residual(const PlanarProblem& problem, const PlanarQpSolution& solution) {
  const double rounding = 1e-12 * std::max(1.0, problem.radius);
  std::vector<Vec2> holding;
  for (const HalfPlane& r : problem.rows) {
    if (r.normal.norm() > 0.0 && violation(r, solution.u) > -rounding) holding.push_back(r.normal.normalized());
  }
  if (solution.u.norm() > problem.radius - rounding) holding.push_back(-solution.u.normalized());
  const Vec2 push = solution.u - problem.u_nom;
  double residual = push.norm();
  for (const Vec2& a : holding) residual = std::min(residual, (push - std::max(0.0, a.dot(push)) * a).norm());
  for (std::size_t i = 1; i < holding.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Matrix2d both;
      both << holding[i], holding[j];
      const Vec2 multipliers = both.inverse() * push;
      if (!multipliers.allFinite() || multipliers.minCoeff() < -1e-9) continue;
      residual = std::min(residual, (both * multipliers.cwiseMax(0.0) - push).norm());
    }
  }
  return residual;
}

/// A row that only one point of the disk satisfies: optimal points need no multipliers there.
bool touches_disk(const PlanarProblem& problem) {
  return std::any_of(problem.rows.begin(), problem.rows.end(),
                     [&](const HalfPlane& r) { return r.offset > r.normal.norm() * problem.radius * (1.0 - 1e-9); });
}

TEST(PlanarQp, Where_the_rows_agree_the_conditions_of_optimality_hold) {
  PlanarProblems problems(7);
  int held = 0;
  for (int i = 0; i < 20'000; ++i) {
    const PlanarProblem problem = problems.next();
    const PlanarQpSolution solution = solve(problem.u_nom, problem.rows, problem.radius);
    if (!solution.feasible || problem.radius == 0.0 || touches_disk(problem)) continue;
    held += solution.active[0] >= 0 ? 1 : 0;
    const double scale = std::max(problem.radius, problem.u_nom.norm());
    EXPECT_LE(worst(problem.rows, solution.u), 1e-12 * std::max(1.0, problem.radius)) << to_string(problem);
    EXPECT_LE(kkt_residual(problem, solution), 1e-8 * std::max(1.0, scale)) << to_string(problem);
    for (const int index : solution.active) {
      if (index < 0) continue;
      const double slack = std::abs(violation(problem.rows[static_cast<std::size_t>(index)], solution.u));
      EXPECT_LE(slack, 1e-12 * std::max(1.0, problem.radius)) << to_string(problem);
    }
  }
  EXPECT_GT(held, 2'000);
}

TEST(PlanarQp, Random_problems_have_the_slow_solvers_answer) {
  PlanarProblems problems(1);
  for (int i = 0; i < 20'000; ++i) {
    const PlanarProblem problem = problems.next();
    const PlanarQpSolution solution = solve(problem.u_nom, problem.rows, problem.radius);
    ASSERT_NE(compare(problem, solution), Agreement::kDifferent) << "problem " << i << '\n' << to_string(problem);
  }
}

TEST(PlanarQp, The_later_priority_gives_way_to_the_earlier) {
  for (std::size_t first = 0; first < kPriorities; ++first) {
    for (std::size_t second = first + 1; second < kPriorities; ++second) {
      const std::array rows{row(-1.0, 0.0, 0.05, static_cast<Priority>(second)),
                            row(1.0, 0.0, 0.1, static_cast<Priority>(first))};
      const PlanarQpSolution solution = solve(Vec2(0.0, 0.2), rows, 0.3);
      EXPECT_FALSE(solution.feasible);
      EXPECT_NEAR(solution.violation[first], 0.0, 1e-15);
      EXPECT_NEAR(solution.violation[second], 0.15, 1e-15);
      EXPECT_LT((solution.u - Vec2(0.1, 0.2)).norm(), 1e-12);
      EXPECT_EQ(solution.active[0], 1);
    }
  }
}

TEST(PlanarQp, Rows_of_one_priority_share_the_violation_evenly) {
  const std::array rows{row(1.0, 0.0, 0.1), row(-2.0, 0.0, 0.1)};  // x >= 0.1 and x <= -0.05
  const PlanarQpSolution solution = solve(Vec2(0.3, 0.2), rows, 0.3);
  EXPECT_NEAR(solution.violation[1], 0.075, 1e-15);
  EXPECT_LT((solution.u - Vec2(0.025, 0.2)).norm(), 1e-12);
}

TEST(PlanarQp, A_priority_that_can_be_had_is_not_relaxed_for_one_that_cannot) {
  const std::array rows{row(0.0, 1.0, 0.5, Priority::kPhysicalRadius),  // beyond the disk
                        row(1.0, 0.0, 0.1, Priority::kSeparation),  // impossible once the first is as near as can be
                        row(0.0, -1.0, -0.3, Priority::kMargin)};
  const PlanarQpSolution solution = solve(Vec2::Zero(), rows, 0.3);
  EXPECT_NEAR(solution.violation[0], 0.2, 1e-12);
  EXPECT_NEAR(solution.violation[1], 0.1, 1e-6);  // the first leaves a point, and rounding a little more than that
  EXPECT_NEAR(solution.violation[3], 0.0, 1e-12);
  EXPECT_LT((solution.u - Vec2(0.0, 0.3)).norm(), 1e-6);
}

TEST(PlanarQp, A_row_without_a_normal_is_reported_and_moves_nothing) {
  const std::array rows{row(0.0, 0.0, 0.2), row(1.0, 0.0, 0.1)};
  const PlanarQpSolution solution = solve(Vec2::Zero(), rows, 0.3);
  EXPECT_FALSE(solution.feasible);
  EXPECT_EQ(solution.violation[1], 0.2);
  EXPECT_LT((solution.u - Vec2(0.1, 0.0)).norm(), 1e-15);
  EXPECT_TRUE(solve(Vec2::Zero(), std::array{row(0.0, 0.0, -0.2)}, 0.3).feasible);
}

TEST(PlanarQp, With_a_radius_of_zero_u_is_zero) {
  const std::array rows{row(1.0, 0.0, 0.1), row(0.0, 1.0, -0.1)};
  const PlanarQpSolution solution = solve(Vec2(1.0, 1.0), rows, 0.0);
  EXPECT_EQ(solution.u, Vec2::Zero());
  EXPECT_NEAR(solution.violation[1], 0.1, 1e-15);
  EXPECT_TRUE(solve(Vec2(1.0, 1.0), std::span(rows).last(1), 0.0).feasible);
}

TEST(PlanarQp, The_most_rows_there_may_be_are_solved) {
  std::vector<HalfPlane> rows;
  for (std::size_t i = 0; i < kMaxRows; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kMaxRows);
    rows.push_back(row(std::cos(angle), std::sin(angle), 0.02, static_cast<Priority>(i % kPriorities)));
  }
  const PlanarQpSolution solution = solve(Vec2(0.1, 0.0), rows, 0.3);
  EXPECT_FALSE(solution.feasible);
  EXPECT_NEAR(solution.violation[0], 0.02, 1e-9);
}

TEST(PlanarQp, Whatever_finite_numbers_come_u_is_finite_and_in_the_disk) {
  constexpr double kHuge = std::numeric_limits<double>::max();
  const std::array numbers{0.0, -0.0, 5e-324, 1e-300, 1e-8, 1.0, -1.0, 1e8, -1e150, 1e300, kHuge, -kHuge};
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::size_t> pick(0, numbers.size() - 1);
  const auto draw = [&] { return numbers[pick(random)]; };
  for (int i = 0; i < 20'000; ++i) {
    std::vector<HalfPlane> rows;
    for (int j = 0; j < i % 7; ++j) rows.push_back(row(draw(), draw(), draw(), static_cast<Priority>(j % 4)));
    const double radius = std::abs(draw());
    const PlanarQpSolution solution = solve(Vec2(draw(), draw()), rows, radius);
    ASSERT_TRUE(solution.u.allFinite()) << i;
    ASSERT_LE(solution.u.stableNorm(), radius * (1.0 + 1e-15)) << i;
  }
}

}  // namespace
}  // namespace vigil::safety
