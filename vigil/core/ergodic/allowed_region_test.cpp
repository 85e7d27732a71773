#include "vigil/core/ergodic/allowed_region.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::ergodic {
namespace {

/// A field of 4 x 3 m with a margin of 0.2 m, and 0.1 m kept from a square of 1 m in the middle.
class AllowedRegionTest : public testing::Test {
 protected:
  field::Polygon square_{{{1.5, 1.0}, {2.5, 1.0}, {2.5, 2.0}, {1.5, 2.0}}};
  std::vector<field::Segment> edges_ = field::edges(square_);
  AllowedRegion region_{.field = {4.0, 3.0}, .wall_distance_m = 0.2, .no_fly_distance_m = 0.1, .no_fly = edges_};
};

TEST_F(AllowedRegionTest, A_point_inside_it_stays_where_it_is) {
  const KeptPoint kept = keep_inside(region_, {1.0, 2.7});
  EXPECT_EQ(kept.point, Vec2(1.0, 2.7));
  EXPECT_EQ(kept.slide({0.3, -0.7}), Vec2(0.3, -0.7));
}

TEST_F(AllowedRegionTest, Beyond_a_wall_the_nearest_point_is_taken_and_the_push_against_it_dropped) {
  const KeptPoint kept = keep_inside(region_, {5.0, 1.0});
  EXPECT_EQ(kept.point, Vec2(3.8, 1.0));
  EXPECT_EQ(kept.slide({-1.0, 2.0}), Vec2(0.0, 2.0));  // downhill is to the right: into the wall
  EXPECT_EQ(kept.slide({1.0, 2.0}), Vec2(1.0, 2.0));
}

TEST_F(AllowedRegionTest, Beyond_a_corner_both_walls_hold) {
  const KeptPoint kept = keep_inside(region_, {-1.0, -1.0});
  EXPECT_EQ(kept.point, Vec2(0.2, 0.2));
  EXPECT_EQ(kept.slide({1.0, 2.0}), Vec2(0.0, 0.0));
}

TEST_F(AllowedRegionTest, Near_an_edge_the_point_is_moved_straight_away_from_it) {
  const KeptPoint kept = keep_inside(region_, {1.45, 1.3});
  EXPECT_LT((kept.point - Vec2(1.4, 1.3)).norm(), 1e-15);
  EXPECT_LT((kept.slide({-1.0, 2.0}) - Vec2(0.0, 2.0)).norm(), 1e-15);
}

RC_GTEST_FIXTURE_PROP(AllowedRegionTest, Whatever_comes_in_is_allowed_when_it_leaves, ()) {
  const auto thousandths = rc::gen::inRange(-1000, 5000);
  const Vec2 q(*thousandths / 1000.0 + 1e-5, *thousandths / 1000.0 + 1e-5);
  const Vec2 kept = keep_inside(region_, q).point;
  RC_ASSERT(kept.x() >= 0.2 && kept.x() <= 3.8 && kept.y() >= 0.2 && kept.y() <= 2.8);
  RC_ASSERT(field::signed_distance(square_, kept) >= 0.1 - 1e-12);
}

RC_GTEST_FIXTURE_PROP(AllowedRegionTest, A_slope_that_is_left_never_pushes_outwards, ()) {
  const auto thousandths = rc::gen::inRange(-1000, 5000);
  const Vec2 q(*thousandths / 1000.0 + 1e-5, *thousandths / 1000.0 + 1e-5);
  const Vec2 slope(*rc::gen::inRange(-9, 10), *rc::gen::inRange(-9, 10));
  const KeptPoint kept = keep_inside(region_, q);
  const Vec2 left = kept.slide(slope);
  RC_ASSERT(left.dot(kept.edge_normal) <= 1e-12);
  RC_ASSERT(left.x() * kept.wall_normal.x() <= 0.0 && left.y() * kept.wall_normal.y() <= 0.0);
  RC_ASSERT(left.norm() <= slope.norm() + 1e-12);
}

}  // namespace
}  // namespace vigil::ergodic
