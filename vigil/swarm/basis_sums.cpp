#include "vigil/swarm/basis_sums.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace vigil::swarm {
namespace {

constexpr std::size_t kPortion = ergodic::Kernel::kPortion;
constexpr std::size_t kMostPortions = 64;
/// Portions that one thread sums up before it asks for more.
constexpr std::size_t kAtOnce = 4;

std::size_t portions_of(std::size_t drones) { return (drones + kPortion - 1) / kPortion; }

}  // namespace

BasisSums::BasisSums(const ergodic::Basis& basis, std::size_t drones)
    : portions_(std::min(portions_of(drones), kMostPortions),
                ergodic::Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())) {}

void BasisSums::add(std::span<ergodic::Kernel> kernels, std::span<const Vec2> positions, double weight,
                    ergodic::Coefficients& sum_k, parallel::Workers* workers) noexcept {
  std::array<double, kPortion> weights{};
  weights.fill(weight);
  while (!positions.empty()) {
    const std::size_t now = std::min(positions.size(), portions_.size() * kPortion);
    const std::size_t portions = portions_of(now);
    parallel::for_each_part(workers, portions, kAtOnce, [&](std::size_t first, std::size_t last, std::size_t thread) {
      for (std::size_t i = first; i < last; ++i) {
        const auto portion = positions.subspan(i * kPortion, std::min(kPortion, now - i * kPortion));
        portions_[i].setZero();
        kernels[thread].add_basis(portion, std::span(weights).first(portion.size()), portions_[i]);
      }
    });
    for (std::size_t i = 0; i < portions; ++i) sum_k += portions_[i];
    positions = positions.subspan(now);
  }
}

}  // namespace vigil::swarm
