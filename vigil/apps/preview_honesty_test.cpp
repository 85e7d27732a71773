// Looking ahead must be honest: 20 random missions without faults, in the full simulation.
#include "vigil/runtime/preview_honesty.hpp"

#include <gtest/gtest.h>

#include "vigil/apps/fleet_choice.hpp"

namespace vigil::apps {
namespace {

TEST(PreviewHonestyTest, On_twenty_missions_half_of_all_times_to_cover_are_foreseen_within_a_fifth) {
  const std::vector<runtime::HonestyCase> cases =
      runtime::honesty_cases(20, [](const runtime::Mission& mission) { return simulated_fleet(mission); });
  EXPECT_LE(runtime::median_error(cases, &runtime::AreaPromise::covered), 0.2);
  EXPECT_LE(runtime::median_error(cases, &runtime::AreaPromise::seen), 0.35);  // one look decides, not an average
}

TEST(PreviewHonestyTest, A_promise_that_is_broken_altogether_is_as_wrong_as_can_be) {
  EXPECT_EQ(runtime::relative_error({10.0, 8.0}), 0.25);
  EXPECT_EQ(runtime::relative_error({10.0, std::nullopt}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(runtime::relative_error({std::nullopt, 8.0}), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(runtime::relative_error({std::nullopt, std::nullopt}));
}

}  // namespace
}  // namespace vigil::apps
