#include "vigil/runtime/campaign_variation.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/mission_error.hpp"

namespace vigil::runtime {
namespace {

TEST(CampaignVariation, Words_name_what_is_drawn_anew) {
  EXPECT_EQ(parse_variation("seed").kind, VariationKind::kSeed);
  EXPECT_EQ(parse_variation("starts").kind, VariationKind::kStarts);
  EXPECT_EQ(parse_variation("targets").kind, VariationKind::kTargets);
}

TEST(CampaignVariation, Faults_take_a_number_and_their_kinds) {
  EXPECT_EQ(parse_variation("faults").incidents, 3U);
  EXPECT_EQ(parse_variation("faults").kinds.size(), 6U);
  EXPECT_EQ(parse_variation("faults=7").incidents, 7U);
  const std::vector<EventKind> expected{EventKind::kFail, EventKind::kLand};
  EXPECT_EQ(parse_variation("faults=2:lose_link").kinds, std::vector<EventKind>{EventKind::kLoseLink});
  EXPECT_EQ(parse_variation("faults=2:fail,land").kinds, expected);
}

TEST(CampaignVariation, A_range_knows_whether_its_key_takes_whole_numbers) {
  const Variation lag = parse_variation("safety.lag_s=0..1");
  EXPECT_EQ(lag.kind, VariationKind::kRange);
  EXPECT_EQ(lag.key, "safety.lag_s");
  EXPECT_EQ(lag.low, 0.0);
  EXPECT_EQ(lag.high, 1.0);
  EXPECT_FALSE(lag.is_whole);
  EXPECT_TRUE(parse_variation("control.basis_max_index=5..20").is_whole);
  EXPECT_FALSE(parse_variation("drones[0].start_m[1]=-1..-0.5").is_whole);
}

TEST(CampaignVariation, Choices_are_taken_as_they_are_written) {
  const Variation barrier = parse_variation("safety.barrier=paper|lag_aware");
  EXPECT_EQ(barrier.kind, VariationKind::kChoice);
  EXPECT_EQ(barrier.choices, (std::vector<std::string>{"paper", "lag_aware"}));
}

class RefusedVariation : public testing::TestWithParam<const char*> {};

TEST_P(RefusedVariation, Is_refused_by_its_text) {
  try {
    static_cast<void>(parse_variation(GetParam()));
    FAIL() << GetParam();
  } catch (const MissionError& error) {
    EXPECT_NE(std::string(error.what()).find(std::string("--vary ") + GetParam()), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Of_every_form, RefusedVariation,
                         testing::Values("", "start", "=1..2", "safety.lag_s=", "safety.lag_s=0.3", "safety.lag_s=2..1",
                                         "safety.lag_s=a..b", "safety.lag_s=0..", "safety.barrier=paper|", "faults=",
                                         "faults=-1", "faults=1.5", "faults=1001", "faults=2:", "faults=2:take_off"));

}  // namespace
}  // namespace vigil::runtime
