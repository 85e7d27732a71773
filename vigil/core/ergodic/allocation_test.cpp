// Nothing that runs within a control tick allocates, for few and for many drones, small and large bases.

#include <vector>

#include <gtest/gtest.h>

#include "vigil/core/ergodic/coverage_statistics.hpp"
#include "vigil/core/ergodic/gradient_controller.hpp"
#include "vigil/core/ergodic/look_ahead.hpp"
#include "vigil/testing/allocation_guard.hpp"

namespace vigil::ergodic {
namespace {

class AllocationTest : public ::testing::TestWithParam<int> {};

TEST_P(AllocationTest, The_coverage_law_allocates_nothing) {
  const Basis basis({3.0, 2.0}, GetParam(), 1.5);
  Kernel kernel(basis);
  Coefficients phi_k = Coefficients::Ones(basis.indices_per_axis(), basis.indices_per_axis());
  Coefficients c_k = phi_k;
  Coefficients a_k = phi_k;
  const std::vector<Vec2> positions(300, Vec2(1.0, 0.7));
  std::vector<Vec2> b(positions.size());
  std::vector<CoverageStatistics> all;
  for (const Accounting accounting : {Accounting::kDroneTime, Accounting::kElapsedTime, Accounting::kPaperEq14}) {
    all.emplace_back(basis, accounting, 5.0);
  }
  double sum = 0.0;
  LookAhead look_ahead(basis, {.u_max_m_s = 0.3, .dt_s = 0.02, .horizon_s = 1.0}, positions.size());
  const AllowedRegion region{.field = basis.field(), .wall_distance_m = 0.1, .no_fly_distance_m = 0.0, .no_fly = {}};
  std::vector<Departure> departures;
  for (std::size_t drone = 0; drone < positions.size(); ++drone) departures.push_back({drone, positions[drone]});

  const testing::AllocationGuard guard;
  for (CoverageStatistics& statistics : all) {
    for (const std::size_t drones : {3U, 300U, 0U, 299U}) {
      const auto active = std::span(positions).first(drones);
      statistics.add(kernel, active, drones, 0.02);
      statistics.average(c_k);
      a_k = basis.weight().cwiseProduct(c_k - phi_k);
      kernel.gradient(active, a_k, std::span(b).first(drones));
      sum += faded_direction(b[0], 0.3, gradient_scale(basis, phi_k)).norm() + ergodic_metric(basis, c_k, phi_k);
      look_ahead.steer(kernel, statistics, phi_k, region, std::span(departures).first(drones),
                       std::span(b).first(drones));
      sum += b[0].norm();
    }
    statistics.reset();
    look_ahead.targets_changed();
  }
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_GT(sum, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Bases, AllocationTest, ::testing::Values(1, 10, 64));

}  // namespace
}  // namespace vigil::ergodic
