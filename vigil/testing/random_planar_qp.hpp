#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "vigil/core/safety/planar_qp.hpp"
#include "vigil/testing/slow_planar_qp.hpp"

namespace vigil::safety {

/// One problem for the solver, for tests.
struct PlanarProblem {
  Vec2 u_nom = Vec2::Zero();
  std::vector<HalfPlane> rows;
  double radius = 0.0;
};

inline std::string to_string(const PlanarProblem& problem) {
  std::ostringstream text;
  text.precision(17);
  text << "u_nom " << problem.u_nom.transpose() << " radius " << problem.radius << '\n';
  for (const HalfPlane& row : problem.rows) {
    text << row.normal.transpose() << " >= " << row.offset << " priority " << static_cast<int>(row.priority) << '\n';
  }
  return text.str();
}

/// Draws problems of every kind that a filter can meet, and worse. The same seed gives the same problems.
class PlanarProblems {
 public:
  explicit PlanarProblems(std::uint64_t seed) : random_(seed) {}

  // One draw a statement or an argument of braces, here and below: their order is then the same in every build.

  PlanarProblem next() {
    PlanarProblem problem;
    problem.radius = radius();
    problem.u_nom = vector(uniform(0.0, 3.0) * problem.radius);
    if (chance(0.02)) problem.u_nom = vector(1e3);
    if (chance(0.02)) problem.u_nom.setZero();
    const bool one_priority = chance(0.5);
    const auto kind = static_cast<int>(uniform(0.0, 6.0));
    shared_angle_ = angle();
    shared_point_ = vector(uniform(0.0, 1.0) * problem.radius);
    const int rows = chance(0.01) ? 20 : static_cast<int>(uniform(0.0, 9.0));
    for (int i = 0; i < rows; ++i) {
      HalfPlane row = draw(kind, problem);
      row.priority = one_priority ? Priority::kSeparation : static_cast<Priority>(static_cast<int>(uniform(0.0, 4.0)));
      problem.rows.push_back(row);
    }
    if (kind == 4 && !problem.rows.empty() && chance(0.3)) {  // u_nom on a line
      const HalfPlane& row = problem.rows.front();
      if (row.normal.norm() > 0.0) problem.u_nom = row.normal * (row.offset / row.normal.squaredNorm());
    }
    return problem;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  double angle() { return uniform(0.0, 2.0 * std::numbers::pi); }
  double magnitude(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  Vec2 vector(double length) { return length * direction(angle()); }
  static Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
  double radius() {
    if (chance(0.01)) return 0.0;
    if (chance(0.02)) return 1e3;
    return chance(0.5) ? 0.3 : uniform(0.1, 3.0);
  }

  HalfPlane draw(int kind, const PlanarProblem& problem) {
    const double r = problem.radius;
    switch (kind) {
      case 0:
        return {vector(magnitude(-1.0, 1.0)), uniform(-1.0, 0.7) * r};
      case 1:
        return {vector(uniform(0.1, 1.0)), chance(0.1) ? 0.0 : -magnitude(-12.0, -1.0)};
      case 2:
        return near_parallel(r);
      case 3:
        return {vector(1.0), uniform(-0.2, 1.2) * r};
      case 4:
        return degenerate(r);
      default: {
        const double scale = magnitude(-8.0, 8.0);
        return {vector(scale), scale * uniform(-1.0, 0.5) * r};
      }
    }
  }

  HalfPlane near_parallel(double r) {
    const double half_turn = chance(0.5) ? 0.0 : std::numbers::pi;
    const double sign = chance(0.5) ? 1.0 : -1.0;
    const double turn = half_turn + sign * magnitude(-13.0, -1.0);
    if (chance(0.2)) return {vector(1.0), uniform(-1.0, 0.3) * r};
    return {direction(shared_angle_ + turn), (chance(0.5) ? uniform(-0.5, 0.3) : magnitude(-12.0, -1.0)) * r};
  }

  /// Lines through one point, repeated and opposite rows, rows that touch the circle, rows without a normal.
  HalfPlane degenerate(double r) {
    if (chance(0.05)) return {Vec2::Zero(), uniform(-1.0, 0.0)};
    const double quarter = 0.5 * std::numbers::pi * std::floor(uniform(0.0, 4.0));
    if (chance(0.2)) return {direction(shared_angle_ + quarter), 0.0};
    if (chance(0.2)) return {Vec2(std::round(std::cos(quarter)), std::round(std::sin(quarter))), 0.1 * r};
    if (chance(0.1)) return {vector(1.0), r};
    const Vec2 normal = direction(chance(0.5) ? angle() : shared_angle_ + quarter);
    return {normal, normal.dot(shared_point_)};
  }

  std::mt19937_64 random_;
  double shared_angle_ = 0.0;
  Vec2 shared_point_ = Vec2::Zero();
};

/// How a solution compares with the slow solver's.
enum class Agreement : std::uint8_t {
  kSame,       ///< u and every violation
  kSensitive,  ///< as good as can be told: the problem itself magnifies rounding a thousand times or more
  kDifferent
};

/// The same problem with every offset moved by `step`, up or down by the pattern's bits.
inline PlanarProblem jittered(PlanarProblem problem, double step, unsigned pattern) {
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    HalfPlane& row = problem.rows[i];
    row.offset += ((pattern >> (i % 4)) & 1u) != 0u ? step * row.normal.norm() : -step * row.normal.norm();
  }
  return problem;
}

/// True where two rows are parallel but for 1e-2 rad, or a row leaves next to nothing of the disk: only then can
/// rounding be magnified a thousand times.
inline bool is_delicate(const PlanarProblem& problem) {
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Vec2 normal = problem.rows[i].normal.normalized();
    if (problem.rows[i].offset > problem.rows[i].normal.norm() * problem.radius * (1.0 - 1e-6)) return true;
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 other = problem.rows[j].normal.normalized();
      if (std::abs(normal.x() * other.y() - normal.y() * other.x()) < 1e-2) return true;
    }
  }
  return false;
}

/// u is compared wherever the problem determines it. Where rows are nearly parallel, or touch the circle, offsets that
/// differ by less than rounding have answers that differ by far more than 1e-9, and asking for u would be asking for
/// luck. There the exact answers of some problems show how far rounding reaches: the problem as it is, with every
/// settled priority loosened by 1e-13, with the priorities settled at the violations that the solution states, loosened
/// by 1e-13 and by 1e-12, and with its offsets moved by 1e-13 up and down. Every violation and the distance from u_nom
/// have to lie among theirs, give or take their spread. The excuse is taken only in delicate problems where 1e-13
/// changes something by 1e-10 at least. The rows themselves, with the stated violations, have to hold in every case.
inline Agreement compare(const PlanarProblem& problem, const PlanarQpSolution& solution) {
  const slow::Solver slow(problem.u_nom, problem.rows, problem.radius);
  const auto scale = static_cast<double>(slow.size_of_data());
  const double tolerance = 1e-9 * scale;
  const Vec2& u = solution.u;
  if (!u.allFinite() || u.norm() > problem.radius * (1.0 + 1e-15)) return Agreement::kDifferent;
  for (const HalfPlane& row : problem.rows) {
    const double length = row.normal.norm();
    const double missing = row.offset - row.normal.dot(u);
    const double allowed = solution.violation[static_cast<std::size_t>(row.priority)] + 1e-11 * scale;
    if (missing > allowed * (length > 0.0 ? length : 1.0)) return Agreement::kDifferent;
  }

  const slow::Answer exact = slow.answer();
  const auto from_nominal = [&](const slow::Point& p) {
    return std::hypot(p.x - problem.u_nom.x(), p.y - problem.u_nom.y());
  };
  const auto apart = [](const slow::Point& a, const slow::Point& b) { return std::hypot(a.x - b.x, a.y - b.y); };
  const slow::Point fast{u.x(), u.y()};
  bool same = apart(fast, exact.u) <= tolerance;
  for (std::size_t p = 0; p < kPriorities; ++p)
    same &= std::abs(solution.violation[p] - exact.violation[p]) <= tolerance;
  if (same) return Agreement::kSame;
  if (!is_delicate(problem)) return Agreement::kDifferent;

  std::vector<slow::Answer> answers{exact, slow.answer(1e-13L * scale),
                                    slow.answer_given(solution.violation, 1e-13L * scale),
                                    slow.answer_given(solution.violation, 1e-12L * scale)};
  for (const unsigned pattern : {0b0101u, 0b1010u, 0b0011u, 0b1100u}) {
    const PlanarProblem moved = jittered(problem, 1e-13 * scale, pattern);
    answers.push_back(slow::Solver(moved.u_nom, moved.rows, moved.radius).answer());
  }
  bool sensitive = std::any_of(answers.begin(), answers.end(),
                               [&](const slow::Answer& a) { return apart(a.u, exact.u) > 1e-10L * scale; });
  const auto good = [&](long double value, auto&& of) {
    long double least = of(exact);
    long double most = of(exact);
    for (const slow::Answer& answer : answers) {
      least = std::min(least, static_cast<long double>(of(answer)));
      most = std::max(most, static_cast<long double>(of(answer)));
    }
    sensitive |= most - least > 1e-10L * scale;
    const long double room = most - least + tolerance;
    return most < HUGE_VALL && value >= least - room && value <= most + room;
  };
  bool all_good = good(from_nominal(fast), [](const slow::Answer& a) { return std::sqrt(a.objective); });
  for (std::size_t p = 0; p < kPriorities; ++p) {
    all_good &= good(solution.violation[p], [p](const slow::Answer& a) { return a.violation[p]; });
  }
  return all_good && sensitive ? Agreement::kSensitive : Agreement::kDifferent;
}

}  // namespace vigil::safety
