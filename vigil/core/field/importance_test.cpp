#include "vigil/core/field/importance.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::field {
namespace {

Vec2 any_point() { return {*rc::gen::inRange(0, 3000) * 1e-3, *rc::gen::inRange(0, 3000) * 1e-3}; }

TEST(FitTest, One_point_is_a_round_Gaussian_of_the_least_width) {
  const Gaussian g = fit({.name = "one", .targets = {{1.0, 2.0}}}, 0.15);
  EXPECT_EQ(g.mean, Vec2(1.0, 2.0));
  EXPECT_EQ(g.covariance, Eigen::Matrix2d(0.15 * 0.15 * Eigen::Matrix2d::Identity()));
}

TEST(FitTest, The_covariance_is_the_sample_s_with_n_minus_1_plus_the_regularisation) {
  const Gaussian g = fit({.name = "three", .targets = {{0.0, 0.0}, {2.0, 0.0}, {1.0, 3.0}}}, 0.1);
  EXPECT_LT((g.mean - Vec2(1.0, 1.0)).norm(), 1e-15);
  EXPECT_NEAR(g.covariance(0, 0), 1.0 + 0.01, 1e-15);
  EXPECT_NEAR(g.covariance(1, 1), 3.0 + 0.01, 1e-15);
  EXPECT_NEAR(g.covariance(0, 1), 0.0, 1e-15);
}

RC_GTEST_PROP(FitTest, Points_on_a_line_are_a_proper_Gaussian_too, ()) {
  const Vec2 a = any_point();
  const Vec2 b = any_point();
  const Gaussian g = fit({.name = "line", .targets = {a, b, 0.5 * (a + b)}}, 0.15);
  const Eigen::Vector2d variances = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(g.covariance).eigenvalues();
  RC_ASSERT(std::abs(variances[0] - 0.15 * 0.15) < 1e-12);
  RC_ASSERT(g.covariance(0, 1) == g.covariance(1, 0));
}

TEST(HasTargetsTest, Nothing_at_all_is_nothing_to_look_at) { EXPECT_FALSE(Importance{}.has_targets()); }

TEST(HasTargetsTest, Weightless_clusters_and_areas_are_nothing_to_look_at) {
  Importance importance;
  importance.clusters = {{.name = "c", .targets = {{1.0, 1.0}}, .weight = 0.0}};
  importance.areas = {{.name = "a", .outline = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}, .weight = 0.0}};
  EXPECT_FALSE(importance.has_targets());
}

TEST(HasTargetsTest, A_cluster_an_area_or_a_floor_will_do) {
  Importance cluster, area, floor;
  cluster.clusters = {{.name = "c", .targets = {{1.0, 1.0}}}};
  area.areas = {{.name = "a", .outline = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}}};
  floor.uniform_floor = 0.1;
  EXPECT_TRUE(cluster.has_targets());
  EXPECT_TRUE(area.has_targets());
  EXPECT_TRUE(floor.has_targets());
}

}  // namespace
}  // namespace vigil::field
