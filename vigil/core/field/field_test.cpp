#include "vigil/core/field/field.hpp"

#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace vigil::field {
namespace {

constexpr Field kField{.length_x = 3.0, .length_y = 2.0};

double metres() { return *rc::gen::inRange(-5000, 5000) * 1e-3; }

TEST(FieldTest, The_border_belongs_to_the_field) {
  EXPECT_TRUE(kField.contains({0.0, 0.0}));
  EXPECT_TRUE(kField.contains({3.0, 2.0}));
  EXPECT_FALSE(kField.contains({-1e-9, 1.0}));
  EXPECT_FALSE(kField.contains({1.0, 2.0 + 1e-9}));
}

TEST(FieldTest, The_shorter_side_is_found_on_either_axis) {
  EXPECT_EQ(kField.shorter_side(), 2.0);
  EXPECT_EQ((Field{1.0, 4.0}.shorter_side()), 1.0);
  EXPECT_EQ(kField.area(), 6.0);
}

RC_GTEST_PROP(FieldTest, No_point_of_the_field_is_closer_than_the_clamped_one, ()) {
  const Vec2 p(metres(), metres());
  const Vec2 other = kField.clamp({metres(), metres()});
  const Vec2 clamped = kField.clamp(p);
  RC_ASSERT(kField.contains(clamped));
  RC_ASSERT((clamped - p).norm() <= (other - p).norm());
  RC_ASSERT(!kField.contains(p) || clamped == p);
}

TEST(WorldFrameTest, The_corner_of_the_field_lies_at_the_origin_and_its_x_axis_along_the_yaw) {
  const WorldFrame frame{.origin_W = {1.0, -2.0}, .yaw_rad = std::numbers::pi / 2.0};
  EXPECT_LT((frame.point_to_world({0.0, 0.0}) - Vec2(1.0, -2.0)).norm(), 1e-15);
  EXPECT_LT((frame.point_to_world({1.0, 0.0}) - Vec2(1.0, -1.0)).norm(), 1e-15);
  EXPECT_LT((frame.vector_to_world({0.0, 1.0}) - Vec2(-1.0, 0.0)).norm(), 1e-15);
}

RC_GTEST_PROP(WorldFrameTest, There_and_back_is_the_same_point_and_lengths_stay, ()) {
  const WorldFrame frame{.origin_W = {metres(), metres()}, .yaw_rad = metres()};
  const Vec2 p_F(metres(), metres());
  RC_ASSERT((frame.point_to_field(frame.point_to_world(p_F)) - p_F).norm() < 1e-13);
  RC_ASSERT((frame.vector_to_field(frame.vector_to_world(p_F)) - p_F).norm() < 1e-13);
  RC_ASSERT(std::abs(frame.vector_to_world(p_F).norm() - p_F.norm()) < 1e-13);
}

}  // namespace
}  // namespace vigil::field
