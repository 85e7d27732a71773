#include "vigil/core/dynamics/random_stream.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace vigil::dynamics {
namespace {

constexpr int kDraws = 200'000;

TEST(RandomStream, The_same_seed_gives_the_same_numbers) {
  RandomStream a(1, 2, 3);
  RandomStream b(1, 2, 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), b.next());
}

TEST(RandomStream, Seed_drone_and_purpose_each_make_another_stream) {
  EXPECT_NE(RandomStream(1, 2, 3).next(), RandomStream(2, 2, 3).next());
  EXPECT_NE(RandomStream(1, 2, 3).next(), RandomStream(1, 3, 3).next());
  EXPECT_NE(RandomStream(1, 2, 3).next(), RandomStream(1, 2, 4).next());
}

TEST(RandomStream, Uniform_numbers_fill_the_open_unit_interval_evenly) {
  RandomStream random(7, 0, 0);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum_of_squares += u * u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.003);
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0 / 3.0, 0.003);
}

TEST(RandomStream, Normal_numbers_have_the_moments_of_a_normal_distribution) {
  RandomStream random(8, 0, 0);
  Vec2 sum = Vec2::Zero();
  double squares = 0.0;
  double product = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec2 v = random.normal(2.0) / 2.0;
    sum += v;
    squares += v.squaredNorm();
    product += v.x() * v.y();
    fourth += std::pow(v.x(), 4);
  }
  EXPECT_LT((sum / kDraws).norm(), 0.01);
  EXPECT_NEAR(squares / (2.0 * kDraws), 1.0, 0.01);
  EXPECT_NEAR(product / kDraws, 0.0, 0.01);
  EXPECT_NEAR(fourth / kDraws, 3.0, 0.1);
}

TEST(RandomStream, Exponential_numbers_have_their_mean) {
  RandomStream random(9, 0, 0);
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) sum += random.exponential(0.5);
  EXPECT_NEAR(sum / kDraws, 0.5, 0.01);
}

}  // namespace
}  // namespace vigil::dynamics
