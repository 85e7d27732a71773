#include "vigil/swarm/protection.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "vigil/core/field/density.hpp"

namespace vigil::swarm {
namespace {

constexpr double kDt = 0.1;

/// Two places of the same weight, of which one is protected, and a tenth for everywhere.
class ProtectionTest : public ::testing::Test {
 protected:
  ProtectionTest() {
    map.clusters.push_back({.name = "kept", .targets = {{0.5, 0.5}}, .weight = 1.0, .is_protected = true});
    map.clusters.push_back({.name = "rest", .targets = {{2.5, 1.5}}, .weight = 1.0});
    map.uniform_floor = 0.1;
    map.sigma_min_m = 0.2;
    phi_k = ergodic::target_coefficients(basis, *field::rasterise(basis.field(), map, {128, 128}));
    kept_k = ergodic::target_coefficients(basis, *field::rasterise_protected(basis.field(), map, {128, 128}));
    protection.retarget(phi_k, kept_k);
  }

  void follow(std::size_t active, std::size_t drones, double seconds, double remembered = 1.0) {
    for (double time_s = 0.0; time_s < seconds; time_s += kDt) protection.follow(active, drones, kDt, remembered);
  }

  ergodic::Basis basis{{3.0, 2.0}, 8, 1.5};
  field::Importance map;
  ergodic::Coefficients phi_k;
  ergodic::Coefficients kept_k;
  Protection protection{basis};
};

TEST_F(ProtectionTest, With_all_drones_the_target_is_what_was_said_to_the_bit) {
  follow(6, 6, 30.0);
  EXPECT_EQ(protection.asked_k(), phi_k);
  EXPECT_NEAR(protection.share().usual, 0.45, 1e-3);
  EXPECT_EQ(protection.share().now, protection.share().usual);
}

TEST_F(ProtectionTest, With_fewer_the_protected_part_keeps_its_drones_and_the_rest_shares_what_is_left) {
  follow(4, 6, 200.0);
  const double usual = protection.share().usual;
  EXPECT_NEAR(4.0 * protection.share().now, 6.0 * usual, 1e-6);
  const ergodic::Coefficients wanted = 1.5 * kept_k + (1.0 - 1.5 * usual) / (1.0 - usual) * (phi_k - kept_k);
  EXPECT_TRUE(protection.asked_k().isApprox(wanted, 1e-6));
  EXPECT_NEAR(protection.asked_k()(0, 0), phi_k(0, 0), 1e-12) << "all attention is still given away once";
}

TEST_F(ProtectionTest, It_never_takes_all) {
  follow(1, 6, 200.0);
  EXPECT_EQ(protection.share().now, Protection::kMost);
}

TEST_F(ProtectionTest, A_drone_more_or_less_changes_the_target_little_by_little) {
  const ergodic::Coefficients before = protection.asked_k();
  protection.follow(3, 6, kDt, 1.0);
  EXPECT_LT((protection.asked_k() - before).norm(), 0.02 * before.norm());
  follow(3, 6, 2.0 * Protection::kFollowsInS);
  EXPECT_GT(protection.share().now, 0.85 * 2.0 * protection.share().usual);
}

TEST_F(ProtectionTest, The_past_is_held_against_what_was_asked_for_then) {
  constexpr double kRemembered = kDt / 600.0;  // of ten minutes
  follow(3, 6, 600.0, kRemembered);
  const double half_forgotten = 1.0 - std::exp(-1.0);
  const double usual = protection.share().usual;
  EXPECT_NEAR(protection.share().now, 0.9, 2e-3);
  const ergodic::Coefficients& asked = protection.asked_k();
  // The protected part's share of what is asked, by its overlap with it.
  const double kept = (asked - phi_k).norm() / (kept_k / usual - (phi_k - kept_k) / (1.0 - usual)).norm();
  EXPECT_NEAR(kept, half_forgotten * (0.9 - usual), 0.02);
  protection.start_afresh();
  EXPECT_GT((protection.asked_k() - phi_k).norm(), 1.5 * kept * (kept_k / usual - phi_k).norm());
}

TEST_F(ProtectionTest, To_protect_something_when_drones_are_lost_already_changes_what_is_asked_from_then_on) {
  protection.retarget(phi_k, {});
  follow(3, 6, 60.0, 0.001);
  protection.retarget(phi_k, kept_k);
  EXPECT_EQ(protection.asked_k(), phi_k) << "the past was asked for no more";
  EXPECT_NEAR(protection.share().now, 0.9, 0.01);
}

TEST_F(ProtectionTest, Where_nobody_covers_nothing_changes) {
  follow(4, 6, 5.0);
  const double now = protection.share().now;
  follow(0, 6, 60.0);
  EXPECT_EQ(protection.share().now, now);
}

TEST_F(ProtectionTest, Without_protected_parts_all_suffer_in_proportion) {
  protection.retarget(phi_k, {});
  follow(1, 6, 60.0);
  EXPECT_EQ(protection.asked_k(), phi_k);
  EXPECT_EQ(protection.share().usual, 0.0);
}

TEST_F(ProtectionTest, Where_everything_is_protected_nobody_can_be_preferred) {
  map.clusters[1].is_protected = true;
  map.uniform_floor = 0.0;
  phi_k = ergodic::target_coefficients(basis, *field::rasterise(basis.field(), map, {128, 128}));
  kept_k = ergodic::target_coefficients(basis, *field::rasterise_protected(basis.field(), map, {128, 128}));
  protection.retarget(phi_k, kept_k);
  follow(2, 6, 60.0);
  EXPECT_TRUE(protection.asked_k().isApprox(phi_k, 1e-9));
}

TEST_F(ProtectionTest, What_lies_in_a_no_fly_polygon_is_not_there_to_be_protected) {
  map.no_fly.push_back({{{0.0, 0.0}, {1.5, 0.0}, {1.5, 2.0}, {0.0, 2.0}}});
  const auto kept = field::rasterise_protected(basis.field(), map, {128, 128});
  EXPECT_TRUE(!kept || kept->integral() < 1e-3);
}

}  // namespace
}  // namespace vigil::swarm
