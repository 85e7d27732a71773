#include "vigil/adapters/sim/simulated_wind.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vigil::sim {
namespace {

constexpr double kDt = 0.02;
const dynamics::Wind kBreeze{.mean_m_s = Vec3(4.0, 1.0, 0.0), .gusts = {1.5, 3.0}};

TEST(SimulatedWind, It_pushes_a_flying_vehicle_as_in_core) {
  dynamics::RandomStream random(2, 7, 3);
  const auto draw = [&] {
    const Vec2 normals = random.normal(1.0);
    return Vec3(normals.x(), normals.y(), 0.0);
  };
  SimulatedWind wind(kBreeze, true, dynamics::RandomStream(2, 7, 3));
  dynamics::WindState state = dynamics::settled_wind(kBreeze, draw());
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(wind.advance(true, kDt), dynamics::push_of(kBreeze, state).head<2>());
    state = dynamics::advance(kBreeze, state, draw(), kDt);
  }
}

TEST(SimulatedWind, Only_who_takes_off_feels_the_mean_wind_and_only_until_it_leans_against_it) {
  dynamics::Wind steady = kBreeze;
  steady.gusts.sigma = 0.0;
  SimulatedWind flying(steady, true, dynamics::RandomStream(2, 7, 3));
  EXPECT_LT(flying.advance(true, kDt).norm(), 1e-12);
  SimulatedWind standing(steady, false, dynamics::RandomStream(2, 7, 3));
  for (int i = 0; i < 100; ++i) static_cast<void>(standing.advance(false, kDt));
  EXPECT_LT((standing.advance(true, kDt) - steady.drag_per_s * Vec2(4.0, 1.0)).norm(), 1e-9);
  for (int i = 1; i < std::lround(steady.rejection_time_s / kDt); ++i) static_cast<void>(standing.advance(true, kDt));
  EXPECT_LT((standing.advance(true, kDt) - std::exp(-1.0) * steady.drag_per_s * Vec2(4.0, 1.0)).norm(), 1e-9);
}

TEST(SimulatedWind, In_a_calm_nothing_is_drawn_and_nothing_pushes) {
  SimulatedWind calm({}, true, dynamics::RandomStream(2, 7, 3));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(calm.advance(true, kDt), Vec2::Zero());
}

}  // namespace
}  // namespace vigil::sim
