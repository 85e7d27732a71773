// The controller's two kernels beside their slow literal twins: the ergodic sums and slopes, and the planar solver.

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "vigil/core/ergodic/kernel.hpp"
#include "vigil/core/ergodic/literal_kernel.hpp"
#include "vigil/core/safety/planar_qp.hpp"
#include "vigil/core/safety/planar_qp_batch.hpp"
#include "vigil/testing/random_planar_qp.hpp"

namespace vigil {
namespace {

/// Drones anywhere on the paper's field, and coefficients to climb.
struct Swarm {
  explicit Swarm(const benchmark::State& state)
      : basis({3.0, 3.0}, static_cast<int>(state.range(1)), 1.5),
        positions(static_cast<std::size_t>(state.range(0))),
        slopes(positions.size()),
        a_k(ergodic::Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(0.0, 3.0);
    for (Vec2& p : positions) p = Vec2(coordinate(random), coordinate(random));
    for (double& a : a_k.reshaped()) a = coordinate(random) - 1.5;
    a_k.array() *= basis.weight().array();
  }
  ergodic::Basis basis;
  std::vector<Vec2> positions;
  std::vector<Vec2> slopes;
  ergodic::Coefficients a_k;
};

void SlopesFast(benchmark::State& state) {
  Swarm swarm(state);
  ergodic::Kernel kernel(swarm.basis);
  std::vector<Vec2> literal(swarm.slopes.size());
  kernel.gradient(swarm.positions, swarm.a_k, swarm.slopes);
  ergodic::gradient_literally(swarm.basis, swarm.positions, swarm.a_k, literal);
  for (std::size_t i = 0; i < literal.size(); ++i)
    if ((swarm.slopes[i] - literal[i]).norm() > 1e-11) return state.SkipWithError("not the literal kernel's slopes");
  for (auto _ : state) {
    kernel.gradient(swarm.positions, swarm.a_k, swarm.slopes);
    benchmark::ClobberMemory();
  }
}

void SlopesLiteral(benchmark::State& state) {
  Swarm swarm(state);
  for (auto _ : state) {
    ergodic::gradient_literally(swarm.basis, swarm.positions, swarm.a_k, swarm.slopes);
    benchmark::ClobberMemory();
  }
}

#define VIGIL_SIZES \
  ->ArgNames({"drones", "K"})->Args({3, 10})->Args({100, 10})->Args({1000, 20})->Unit(benchmark::kMicrosecond)
BENCHMARK(SlopesFast) VIGIL_SIZES;
BENCHMARK(SlopesLiteral) VIGIL_SIZES;
#undef VIGIL_SIZES

/// Rows as barriers make them: unit normals, offsets that u = 0 satisfies.
std::vector<safety::PlanarProblem> barrier_problems(std::size_t rows) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<safety::PlanarProblem> problems(1024);
  for (safety::PlanarProblem& problem : problems) {
    problem.radius = 0.3;
    problem.u_nom = 0.3 * Vec2(unit(random), unit(random));
    for (std::size_t i = 0; i < rows; ++i) {
      const double angle = 3.14159 * unit(random);
      problem.rows.push_back({Vec2(std::cos(angle), std::sin(angle)), -0.2 * std::abs(unit(random)), {}});
    }
  }
  return problems;
}

void SolverFast(benchmark::State& state) {
  const auto problems = barrier_problems(static_cast<std::size_t>(state.range(0)));
  // The slow solver tries every triple of rows: a few problems suffice where there are many.
  const std::size_t checked = state.range(0) > 8 ? 4 : 256;
  for (const safety::PlanarProblem& problem : std::span(problems).first(checked))
    if (compare(problem, safety::solve(problem.u_nom, problem.rows, problem.radius)) == safety::Agreement::kDifferent)
      return state.SkipWithError("not the slow solver's answer");
  std::size_t next = 0;
  for (auto _ : state) {
    const safety::PlanarProblem& problem = problems[next++ % problems.size()];
    benchmark::DoNotOptimize(safety::solve(problem.u_nom, problem.rows, problem.radius));
  }
}
BENCHMARK(SolverFast)->ArgName("rows")->Arg(2)->Arg(8)->Arg(32);

using Batch = safety::PlanarQpBatch;

void put(std::span<const safety::PlanarProblem> problems, Batch& batch) {
  for (std::size_t lane = 0; lane < Batch::kLanes; ++lane) {
    batch.begin(lane, problems[lane].u_nom);
    for (const safety::HalfPlane& row : problems[lane].rows) batch.add(lane, row);
  }
}

/// The problems of SolverFast, eight at a time, with and without the time that it takes to put them side by side. All
/// have one radius.
void SolverBatch(benchmark::State& state) {
  const auto problems = barrier_problems(static_cast<std::size_t>(state.range(0)));
  std::vector<Batch> batches(problems.size() / Batch::kLanes);
  std::size_t solved = 0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    const auto mine = std::span(problems).subspan(i * Batch::kLanes, Batch::kLanes);
    put(mine, batches[i]);
    batches[i].solve(mine[0].radius);
    for (std::size_t lane = 0; lane < Batch::kLanes; ++lane) {
      if (!batches[i].is_solved(lane)) continue;
      ++solved;
      if (batches[i].solution(lane).u != safety::solve(mine[lane].u_nom, mine[lane].rows, mine[lane].radius).u)
        return state.SkipWithError("not the answer of one after the other");
      if (i < 32 && compare(mine[lane], batches[i].solution(lane)) == safety::Agreement::kDifferent)
        return state.SkipWithError("not the slow solver's answer");
    }
  }
  const bool is_put = state.range(1) != 0;
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t i = next++ % batches.size();
    if (is_put) put(std::span(problems).subspan(i * Batch::kLanes, Batch::kLanes), batches[i]);
    batches[i].solve(problems[0].radius);
    benchmark::ClobberMemory();
  }
  using benchmark::Counter;
  state.counters["s_per_problem"] =
      Counter(static_cast<double>(Batch::kLanes), Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["solved"] = static_cast<double>(solved) / static_cast<double>(problems.size());
}
BENCHMARK(SolverBatch)->ArgNames({"rows", "putting"})->ArgsProduct({{2, 8, 24}, {0, 1}});

void SolverSlow(benchmark::State& state) {
  const auto problems = barrier_problems(static_cast<std::size_t>(state.range(0)));
  std::size_t next = 0;
  for (auto _ : state) {
    const safety::PlanarProblem& problem = problems[next++ % problems.size()];
    benchmark::DoNotOptimize(safety::slow::Solver(problem.u_nom, problem.rows, problem.radius).answer());
  }
}
BENCHMARK(SolverSlow)->ArgName("rows")->Arg(2)->Arg(8);

}  // namespace
}  // namespace vigil
