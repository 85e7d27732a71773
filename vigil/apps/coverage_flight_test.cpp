// What the program promises of coverage, flown whole and judged by ground truth.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/apps/flight_for_tests.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::apps {
namespace {

runtime::Mission mission_of(const std::string& name, const std::vector<runtime::Override>& overrides) {
  return runtime::load_mission(std::string(VIGIL_MISSIONS_DIR "/") + name, overrides);
}

void expect_safe(const runtime::FlightSummary& summary) {
  EXPECT_EQ(summary.audit.separation_violations, 0U);
  EXPECT_EQ(summary.audit.wall_violations, 0U);
  EXPECT_EQ(summary.audit.no_fly_violations, 0U);
}

TEST(Coverage, The_laboratory_ends_below_half_a_percent_with_the_program_s_own_choices) {
  std::vector<double> percents;
  for (int seed = 1; seed <= 20; ++seed) {
    const runtime::FlightSummary summary = fly(mission_of("lab.yaml", {{"simulation.seed", std::to_string(seed)}}));
    SCOPED_TRACE("seed " + std::to_string(seed));
    ASSERT_EQ(summary.controller, "look_ahead");
    expect_safe(summary);
    percents.push_back(summary.last_percent);
  }
  std::ranges::sort(percents);
  const double median = 0.5 * (percents[9] + percents[10]);
  std::printf("median %.3f %%, worst %.3f %% of the first metric\n", median, percents.back());
  EXPECT_LT(median, 0.5);
}

/// The paper's field, targets and starts without its failure, with ideal vehicles and the program's own barrier.
double percent_without_faults(const std::string& controller) {
  runtime::Mission mission = mission_of("paper.yaml", {{"control.controller", controller}, {"control.fade", "0.1"}});
  mission.simulation.events.clear();
  mission.safety.barrier = safety::BarrierKind::kLagAware;
  mission.safety.pair_gain.reset();
  mission.safety.wall_gain.reset();
  mission.safety.sensing_range_m.reset();
  mission.safety.wall_range_m.reset();
  const runtime::FlightSummary summary = fly(mission);
  expect_safe(summary);
  return summary.last_percent;
}

TEST(Coverage, Without_faults_looking_ahead_leaves_a_tenth_of_what_the_gradient_leaves) {
  const double gradient = percent_without_faults("gradient");
  const double look_ahead = percent_without_faults("look_ahead");
  std::printf("gradient %.4f %%, look_ahead %.4f %%\n", gradient, look_ahead);
  EXPECT_LT(10.0 * look_ahead, gradient);
}

/// The share of attention, and of (fading) flight time by ground truth, within two standard deviations of a cluster.
class ShareOfCluster {
 public:
  ShareOfCluster(const runtime::Mission& mission, const runtime::ClusterEntry& added)
      : kept_(std::exp(-runtime::tick_s(mission) / runtime::memory_s(mission).value())), dt_s_(tick_s(mission)) {
    runtime::Mission after = mission;
    after.targets.clusters.push_back(added);
    const field::Importance map = runtime::importance(after);
    gaussian_ = field::fit(map.clusters.back(), map.sigma_min_m);
    const field::DensityGrid density = field::rasterise(runtime::monitored_field(mission), map, {256, 256}).value();
    for (Eigen::Index x = 0; x < 256; ++x) {
      for (Eigen::Index y = 0; y < 256; ++y) {
        const double mass = density.values(x, y) * density.weights_x[x] * density.weights_y[y];
        if (is_there(density.midpoint(x, y))) wanted_ += mass;
      }
    }
  }

  void see(std::span<const runtime::TruthSample> truth) {
    there_s_ *= kept_;
    all_s_ *= kept_;
    for (const runtime::TruthSample& drone : truth) {
      all_s_ += dt_s_;
      if (is_there(drone.position)) there_s_ += dt_s_;
    }
  }

  [[nodiscard]] double wanted() const { return wanted_; }
  [[nodiscard]] double flown() const { return there_s_ / all_s_; }

 private:
  [[nodiscard]] bool is_there(const Vec2& p) const {
    const Eigen::Matrix2d& s = gaussian_.covariance;
    const Vec2 d = p - gaussian_.mean;
    const double determinant = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    return s(1, 1) * d.x() * d.x() - 2.0 * s(0, 1) * d.x() * d.y() + s(0, 0) * d.y() * d.y() < 4.0 * determinant;
  }

  double kept_;
  double dt_s_;
  field::Gaussian gaussian_;
  double wanted_ = 0.0;
  double there_s_ = 0.0;
  double all_s_ = 0.0;
};

/// How long after its appearance at 600 s the cluster has nine tenths of its share, by ground truth. Seconds.
double time_to_cover(const runtime::ClusterEntry& added, int seed) {
  runtime::Mission mission =
      mission_of("lab.yaml", {{"simulation.seed", std::to_string(seed)}, {"simulation.duration_s", "780"}});
  mission.simulation.events.clear();
  for (const Vec2& point : added.points_m) {
    runtime::EventEntry event;
    event.at_s = 600.0;
    event.what = runtime::EventKind::kAddTarget;
    event.cluster = added.name;
    event.point_m = point;
    mission.simulation.events.push_back(event);
  }
  const auto fleet = simulated_fleet(mission);
  runtime::VirtualFlight flight(mission, *fleet, nullptr, no_clock);
  ShareOfCluster share(mission, added);
  while (!flight.is_over()) {
    flight.step();
    share.see(fleet->truth());
    const double since_s = static_cast<double>(flight.ticks_flown()) * runtime::tick_s(mission) - 600.0;
    if (since_s > 0.0 && share.flown() >= 0.9 * share.wanted()) return since_s;
  }
  ADD_FAILURE() << "after three minutes " << share.flown() << " of " << share.wanted();
  return 180.0;
}

/// A cluster that is added in so many flights, with the seeds 1, 2, ...
struct Addition {
  runtime::ClusterEntry cluster;
  int flights = 0;
};

class NewTarget : public testing::TestWithParam<Addition> {};

TEST_P(NewTarget, After_ten_minutes_it_is_covered_to_its_share_within_a_minute_in_every_flight) {
  std::vector<double> took_s;
  for (int seed = 1; seed <= GetParam().flights; ++seed) {
    took_s.push_back(time_to_cover(GetParam().cluster, seed));
    EXPECT_LE(took_s.back(), 60.0) << "seed " << seed;
  }
  std::ranges::sort(took_s);
  std::printf("%s: median %.1f s, worst %.1f s\n", GetParam().cluster.name.c_str(), took_s[took_s.size() / 2],
              took_s.back());
}

runtime::ClusterEntry added_cluster(const std::string& name, std::vector<Vec2> points) {
  runtime::ClusterEntry cluster;
  cluster.name = name;
  cluster.points_m = std::move(points);
  return cluster;
}

// A lone point is where slow flights were seen, one in 40 to 200 with plans by the metric's own weights.
INSTANTIATE_TEST_SUITE_P(
    Clusters, NewTarget,
    testing::Values(
        Addition{added_cluster("one_point", {{0.9, -0.9}}), 60}, Addition{added_cluster("far_corner", {{1.1, 1.1}}), 9},
        Addition{added_cluster("quarter_of_all", {{0.7, -0.9}, {0.9, -0.8}, {0.8, -1.0}, {1.0, -0.9}, {0.85, -0.85}}),
                 9}),
    [](const auto& addition) { return addition.param.cluster.name; });

}  // namespace
}  // namespace vigil::apps
