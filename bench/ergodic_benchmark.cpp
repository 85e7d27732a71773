// The ergodic step (sums and slopes of all drones) with every instruction set of this machine, beside the floor of its
// floating-point work: 6 (K+1)^2 + 16 (K+1) operations a drone at the rate of Eigen's matrix product with the same
// instructions, measured in turns with it. And a new target map's way to coefficients. Time of the thread, not of the
// clock; medians and 99th percentiles of what one iteration takes.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "bench/matrix_product.hpp"
#include "vigil/core/ergodic/kernel.hpp"
#include "vigil/core/ergodic/literal_kernel.hpp"
#include "vigil/core/field/density.hpp"

namespace vigil {
namespace {

using ergodic::Basis;
using ergodic::Coefficients;
using ergodic::InstructionSet;

double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double mean_time_s(int times, Work work) {
  const double before = thread_time_s();
  for (int i = 0; i < times; ++i) work();
  benchmark::ClobberMemory();
  return (thread_time_s() - before) / times;
}

double quantile(std::vector<double> samples, double share) {
  std::ranges::sort(samples);
  return samples[static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1))];
}

void report(benchmark::State& state, const std::vector<double>& samples_s) {
  state.counters["median_us"] = 1e6 * quantile(samples_s, 0.5);
  state.counters["p99_us"] = 1e6 * quantile(samples_s, 0.99);
}

struct Step {
  Step(std::size_t drones, int max_index)
      : basis({3.0, 3.0}, max_index, 1.5), positions(drones), weights(drones, 0.02), slopes(drones) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(0.0, 3.0);
    for (Vec2& p : positions) p = Vec2(coordinate(random), coordinate(random));
    a_k = Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis());
    sum = a_k;
    for (double& a : a_k.reshaped()) a = coordinate(random) - 1.5;
    a_k.array() *= basis.weight().array();
  }
  void run(ergodic::Kernel& kernel) {
    kernel.add_basis(positions, weights, sum);
    kernel.gradient(positions, a_k, slopes);
  }
  // Of the first step.
  [[nodiscard]] bool is_right() const {
    Coefficients literal_sum = Coefficients::Zero(sum.rows(), sum.cols());
    add_basis_literally(basis, positions, weights, literal_sum);
    std::vector<Vec2> literal(slopes.size());
    gradient_literally(basis, positions, a_k, literal);
    for (std::size_t i = 0; i < literal.size(); ++i)
      if ((slopes[i] - literal[i]).norm() > 1e-11) return false;
    return (sum - literal_sum).cwiseAbs().maxCoeff() <= 1e-12 * literal_sum.cwiseAbs().maxCoeff();
  }
  [[nodiscard]] double flop() const {
    const double n = basis.indices_per_axis();
    return static_cast<double>(positions.size()) * (6.0 * n * n + 16.0 * n);
  }

  Basis basis;
  std::vector<Vec2> positions;
  std::vector<double> weights;
  std::vector<Vec2> slopes;
  Coefficients a_k;
  Coefficients sum;
};

void ErgodicStep(benchmark::State& state, InstructionSet set) {
  Step step(static_cast<std::size_t>(state.range(0)), static_cast<int>(state.range(1)));
  ergodic::Kernel kernel(step.basis, set);
  step.run(kernel);
  if (!step.is_right()) return state.SkipWithError("not the literal kernel's sums and slopes");

  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(bench::kProductSide, bench::kProductSide);
  Eigen::MatrixXd product = a;
  const int steps = static_cast<int>(std::max(1.0, 1e6 / step.flop()));
  std::vector<double> step_s;
  std::vector<double> product_s;
  for (auto _ : state) {
    step_s.push_back(mean_time_s(steps, [&] { step.run(kernel); }));
    product_s.push_back(mean_time_s(1, [&] { bench::multiply(set, a.data(), a.data(), product.data()); }));
  }
  if (!product.isApprox(a * a)) return state.SkipWithError("not the matrix product");
  report(state, step_s);
  const double floor_s = step.flop() * quantile(product_s, 0.5) / bench::kProductFlop;
  state.counters["floor_us"] = 1e6 * floor_s;
  state.counters["x_floor"] = quantile(step_s, 0.5) / floor_s;
}

struct Map {
  Map() : basis({3.0, 3.0}, 20, 1.5) {
    for (const Vec2& mean : {Vec2(0.6, 0.7), Vec2(2.2, 1.0), Vec2(1.4, 2.5)}) {
      mixture.push_back({.mean = mean, .covariance = Eigen::Matrix2d::Identity() * 0.04});
      mixture.back().covariance(0, 1) = mixture.back().covariance(1, 0) = 0.015;
    }
  }
  [[nodiscard]] field::DensityGrid rasterised() const {
    const std::vector<double> weights(mixture.size(), 1.0);
    return field::rasterise(basis.field(), mixture, weights, {256, 256}).value();
  }
  Basis basis;
  std::vector<field::Gaussian> mixture;
};

// The same by the C library's cosines and Eigen's products.
Coefficients plain_coefficients(const Basis& basis, const field::DensityGrid& grid) {
  const auto cosines = [&](const Eigen::VectorXd& weights) {
    Eigen::MatrixXd table(basis.indices_per_axis(), weights.size());
    for (Eigen::Index j = 0; j < weights.size(); ++j)
      for (Eigen::Index k = 0; k < table.rows(); ++k)
        table(k, j) = weights[j] * std::cos(static_cast<double>(k) * 3.14159265358979324 *
                                            (static_cast<double>(j) + 0.5) / static_cast<double>(weights.size()));
    return table;
  };
  const Eigen::MatrixXd integrals =
      cosines(grid.weights_x) * grid.values.matrix() * cosines(grid.weights_y).transpose();
  return integrals.cwiseQuotient(basis.norm());
}

void GridToCoefficients(benchmark::State& state, InstructionSet set) {
  const Map map;
  const field::DensityGrid grid = map.rasterised();
  Coefficients phi_k = target_coefficients(map.basis, grid, set);
  if ((phi_k - plain_coefficients(map.basis, grid)).cwiseAbs().maxCoeff() > 1e-13)
    return state.SkipWithError("not the plain products' coefficients");
  std::vector<double> samples_s;
  for (auto _ : state) samples_s.push_back(mean_time_s(1, [&] { phi_k = target_coefficients(map.basis, grid, set); }));
  report(state, samples_s);
}

void MixtureToCoefficients(benchmark::State& state, InstructionSet set) {
  const Map map;
  Coefficients phi_k;
  std::vector<double> samples_s;
  for (auto _ : state)
    samples_s.push_back(mean_time_s(1, [&] { phi_k = target_coefficients(map.basis, map.rasterised(), set); }));
  report(state, samples_s);
}

void register_for(InstructionSet set) {
  const std::string suffix = "/" + std::string(name_of(set));
  benchmark::RegisterBenchmark(("ErgodicStep" + suffix).c_str(), ErgodicStep, set)
      ->ArgNames({"drones", "K"})
      ->Args({3, 10})
      ->Args({100, 10})
      ->Args({1000, 20})
      ->Args({10000, 20})
      ->Iterations(300)
      ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark(("GridToCoefficients/256x256/K:20" + suffix).c_str(), GridToCoefficients, set)
      ->Iterations(300)
      ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark(("MixtureToCoefficients/256x256/K:20" + suffix).c_str(), MixtureToCoefficients, set)
      ->Iterations(300)
      ->Unit(benchmark::kMicrosecond);
}

const bool kRegistered = [] {
  for (const InstructionSet set : ergodic::instruction_sets()) register_for(set);
  return true;
}();

}  // namespace
}  // namespace vigil
