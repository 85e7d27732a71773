#include "vigil/swarm/basis_sums.hpp"

#include <random>

#include <gtest/gtest.h>

namespace vigil::swarm {
namespace {

TEST(BasisSums, Any_number_of_threads_gives_the_bits_of_one_kernel_alone) {
  const ergodic::Basis basis({30.0, 20.0}, 10, 1.5);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(0.0, 20.0);
  for (const std::size_t drones : {0u, 1u, 128u, 129u, 5'000u, 20'000u}) {
    std::vector<Vec2> positions(drones);
    for (Vec2& p : positions) p = Vec2(coordinate(random), coordinate(random));
    const ergodic::Coefficients before = ergodic::Coefficients::Random(11, 11);
    ergodic::Coefficients alone = before;
    ergodic::Kernel(basis).add_basis(positions, std::vector<double>(drones, 0.02), alone);
    for (const std::size_t threads : {1u, 2u, 3u}) {
      parallel::Workers workers(threads);
      std::vector<ergodic::Kernel> kernels(threads, ergodic::Kernel(basis));
      ergodic::Coefficients shared = before;
      BasisSums(basis, drones).add(kernels, positions, 0.02, shared, &workers);
      EXPECT_EQ(shared, alone) << drones << " drones, " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace vigil::swarm
