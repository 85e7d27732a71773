// The whole tick for a thousand to a million drones on a square grid, shuffled ids, pairs sensed to about 0.61 m, the
// gradient controller and the lag-aware barrier. With 0.3 m from one drone to the next, but where neighbours are what
// is looked at.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <unistd.h>
#include <vector>

#include <benchmark/benchmark.h>

#include "vigil/core/safety/barrier.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::swarm {
namespace {

constexpr int kSpacingMm = 300;
constexpr double kTick = 0.02;
constexpr std::uint64_t kSeed = 11;

SwarmParameters parameters_of(std::size_t drones, int basis_max_index, double spacing_m) {
  SwarmParameters parameters;
  const double side = spacing_m * std::ceil(std::sqrt(static_cast<double>(drones))) + 2.0 * spacing_m;
  parameters.field = {side, side};
  parameters.drones = drones;
  parameters.dt_s = kTick;
  parameters.basis_max_index = basis_max_index;
  parameters.controller = ergodic::ControllerKind::kGradient;
  parameters.first_intent = Intent::kCover;
  safety::BarrierParameters& barrier = parameters.barrier;
  barrier.separation_m = 0.2;
  barrier.contact_distance_m = 0.1;
  barrier.wall_distance_m = 0.17;
  barrier.u_max_m_s = 0.3;
  barrier.dt_s = kTick;
  barrier.pair_gain = 1.225;
  barrier.lag_s = 0.1;
  return parameters;
}

/// Two places to cover, and everything else a little.
std::shared_ptr<CoverageTarget> two_places(const SwarmParameters& parameters) {
  const ergodic::Basis basis(parameters.field, parameters.basis_max_index, parameters.basis_smoothness);
  ergodic::Kernel kernel(basis);
  auto target = std::make_shared<CoverageTarget>();
  target->has_targets = true;
  target->phi_k = ergodic::Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis());
  const Vec2 size(parameters.field.length_x, parameters.field.length_y);
  const std::vector<Vec2> places{0.3 * size, Vec2(0.7 * size.x(), 0.6 * size.y())};
  kernel.add_basis(places, std::vector<double>(2, 0.5), target->phi_k);
  return target;
}

/// Drones that follow v' = (u - v)/lag exactly, seen as they are.
class LaggingWorld {
 public:
  LaggingWorld(std::size_t drones, int basis_max_index, double spacing_m)
      : state(parameters_of(drones, basis_max_index, spacing_m)), snapshot(drones), observations(drones) {
    const SwarmParameters& parameters = state.parameters();
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))));
    std::vector<std::size_t> places(drones);
    for (std::size_t i = 0; i < drones; ++i) places[i] = i;
    std::mt19937_64 random(kSeed);
    std::shuffle(places.begin(), places.end(), random);
    for (std::size_t i = 0; i < drones; ++i) {
      const Vec2 place(static_cast<double>(places[i] % columns), static_cast<double>(places[i] / columns));
      observations[i].position = spacing_m * (place + Vec2(1.5, 1.5));
      observations[i].height_m = 1.0;
      observations[i].age_s = 0.0;
      observations[i].link_age_s = 0.0;
      observations[i].mode = VehicleMode::kFlying;
    }
    const std::vector<Command> first{{.kind = CommandKind::kSetTarget, .drone = {}, .target = two_places(parameters)}};
    tick(state, observations, first, snapshot);
    move();
  }

  void move() {
    const double lag = state.parameters().barrier.lag_s;
    const double kept = std::exp(-kTick / lag);
    for (std::size_t i = 0; i < observations.size(); ++i) {
      DroneObservation& drone = observations[i];
      const Vec2& u = snapshot.drones[i].order.velocity;
      drone.position += kTick * u + lag * (1.0 - kept) * (drone.velocity - u);
      drone.velocity = u + kept * (drone.velocity - u);
    }
  }

  SwarmState state;
  Snapshot snapshot;
  std::vector<DroneObservation> observations;
};

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Of all threads of this process: what a tick costs, also on a machine that is busy with other things.
double processor_ms() {
  timespec spent{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &spent);
  return 1e3 * static_cast<double>(spent.tv_sec) + 1e-6 * static_cast<double>(spent.tv_nsec);
}

double percentile(std::vector<double>& samples, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(at), samples.end());
  return samples[at];
}

/// The median processor time of a part of the tick by itself, of so many tries.
template <typename Part>
double median_ms(int tries, const Part& part) {
  std::vector<double> samples;
  for (int i = 0; i < tries; ++i) {
    const double begin = processor_ms();
    part();
    samples.push_back(processor_ms() - begin);
  }
  return percentile(samples, 0.5);
}

/// What this process keeps in memory.
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// The world's drones as the filter sees them.
std::vector<safety::Body> bodies_of(const LaggingWorld& world) {
  std::vector<safety::Body> bodies(world.observations.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].position = world.observations[i].position;
    bodies[i].velocity = world.observations[i].velocity;
  }
  return bodies;
}

/// The rows of every drone one pair and one formula after the other, and the solver: what the filter computes for these
/// bodies, in the plainest way that is not quadratic.
void filter_plainly(const SwarmParameters& parameters, const safety::NeighbourGrid& grid, double reach_m,
                    std::span<const safety::Body> bodies, std::span<const Vec2> u_nom, std::span<Vec2> u) {
  std::vector<safety::HalfPlane> rows;
  for (std::size_t own = 0; own < bodies.size(); ++own) {
    const Vec2 z = safety::barrier_point(parameters.barrier, bodies[own]);
    rows.clear();
    grid.visit_near(z, reach_m, [&](std::size_t other) {
      if (other == own) return;
      const Vec2 z_ij = z - safety::barrier_point(parameters.barrier, bodies[other]);
      const safety::PairBarrier barrier = safety::separation_barrier(parameters.barrier, bodies[own], bodies[other]);
      if (z_ij.norm() > reach_m) return;
      const auto row =
          safety::pair_row(parameters.barrier, barrier, z_ij, bodies[own].velocity - bodies[other].velocity,
                           static_cast<int>(own), static_cast<int>(other), safety::Priority::kDoubt);
      if (row) rows.push_back(*row);
    });
    for (int wall = 0; wall < 4; ++wall) {
      const auto row =
          safety::wall_row(parameters.barrier, parameters.field, z, wall,
                           safety::wall_reserve(parameters.barrier, bodies[own]), safety::Priority::kDoubt);
      if (row) rows.push_back(*row);
    }
    u[own] = safety::solve(u_nom[own], rows, parameters.barrier.u_max_m_s).u;
  }
}

/// The filter beside its plain reference: they must agree to the last bit before either is timed. Returns times of the
/// filter and of the reference.
std::optional<std::array<double, 2>> time_filters(const LaggingWorld& world, parallel::Workers& workers) {
  const SwarmParameters& parameters = world.state.parameters();
  const std::vector<safety::Body> bodies = bodies_of(world);
  std::vector<Vec2> points;
  std::vector<Vec2> u_nom;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    points.push_back(safety::barrier_point(parameters.barrier, bodies[i]));
    u_nom.push_back(world.snapshot.drones[i].u_nom);
  }
  std::vector<Vec2> u(bodies.size());
  std::vector<Vec2> plain(bodies.size());
  std::vector<safety::FilterReport> reports(bodies.size());
  const double reach_m = safety::derived_sensing_range(parameters.barrier);
  safety::Filter filter(parameters.barrier, parameters.field, bodies.size());
  safety::NeighbourGrid grid(parameters.field, reach_m, bodies.size());
  const double fast = median_ms(9, [&] { filter.run(bodies, {}, u_nom, u, reports, &workers); });
  const double slow = median_ms(3, [&] {
    grid.sort(points);
    filter_plainly(parameters, grid, reach_m, bodies, u_nom, plain);
  });
  for (std::size_t i = 0; i < u.size(); ++i)
    if (!reports[i].margin_used && u[i] != plain[i]) return std::nullopt;
  return std::array{fast, slow};
}

double time_kernel(const LaggingWorld& world) {
  const SwarmParameters& parameters = world.state.parameters();
  ergodic::Kernel kernel(world.state.basis());
  ergodic::Coefficients sum = world.state.target().phi_k;
  std::vector<Vec2> positions;
  for (const DroneObservation& drone : world.observations) positions.push_back(drone.position);
  const std::vector<double> weights(positions.size(), parameters.dt_s);
  std::vector<Vec2> slopes(positions.size());
  return median_ms(5, [&] {
    kernel.add_basis(positions, weights, sum);
    kernel.gradient(positions, world.state.target().phi_k, slopes);
  });
}

/// Medians. Those of parts, and processor_ms of the whole tick, are of processor time, all threads' together.
void Tick(benchmark::State& state) {
  const auto drones = static_cast<std::size_t>(state.range(0));
  const double before = resident_bytes();
  LaggingWorld world(drones, static_cast<int>(state.range(1)), 1e-3 * static_cast<double>(state.range(3)));
  const double each_bytes =
      (resident_bytes() - before) / static_cast<double>(drones) - static_cast<double>(sizeof(DroneObservation));
  parallel::Workers workers(static_cast<std::size_t>(state.range(2)));
  std::vector<double> samples;
  std::vector<double> costs;
  for (auto _ : state) {
    const double spent = processor_ms();
    const Clock::time_point begin = Clock::now();
    tick(world.state, world.observations, {}, world.snapshot, &workers);
    samples.push_back(milliseconds_since(begin));
    costs.push_back(processor_ms() - spent);
    state.SetIterationTime(1e-3 * samples.back());
    world.move();
    if (world.snapshot.fallback) return state.SkipWithError("a drone was left without a way out");
  }
  const auto filters = time_filters(world, workers);
  if (!filters) return state.SkipWithError("the filter's answer is not the plain reference's");
  const double median = percentile(samples, 0.5);
  state.counters["median_ms"] = median;
  state.counters["processor_ms"] = percentile(costs, 0.5);
  state.counters["p99_ms"] = percentile(samples, 0.99);
  state.counters["ns_per_drone"] = 1e6 * median / static_cast<double>(drones);
  state.counters["filter_ms"] = (*filters)[0];
  state.counters["plain_filter_ms"] = (*filters)[1];
  state.counters["kernel_ms"] = time_kernel(world);
  state.counters["bytes_per_drone"] = each_bytes;
}

void sizes(benchmark::internal::Benchmark* tick) {
  tick->ArgNames({"drones", "K", "threads", "spacing_mm"})->UseManualTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t threads : {1, 2})
    for (const std::int64_t drones : {1'000, 10'000, 100'000, 1'000'000}) tick->Args({drones, 10, threads, kSpacingMm});
  for (const std::int64_t max_index : {5, 20, 30}) tick->Args({10'000, max_index, 1, kSpacingMm});
  for (const std::int64_t spacing_mm : {1'000, 600, 450, 250}) tick->Args({10'000, 10, 1, spacing_mm});
}
BENCHMARK(Tick)->Apply(sizes);

}  // namespace
}  // namespace vigil::swarm
