#include "vigil/runtime/deadline_foresight.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

Mission two_areas(std::optional<double> deadline_s) {
  Mission mission;
  mission.targets.areas.push_back({.name = "ridge", .outline_m = {}, .revisit_s = deadline_s});
  mission.targets.areas.push_back({.name = "camp", .outline_m = {}});
  return mission;
}

std::vector<AreaOutlook> outlook(double ridge_s) {
  return {{.what = {TargetKind::kArea, "ridge"}, .worst_age_s = ridge_s, .deadline_s = 100.0},
          {.what = {TargetKind::kArea, "camp"}, .worst_age_s = 1000.0}};
}

TEST(DeadlineForesight, Without_deadlines_nobody_looks_ahead) {
  DeadlineForesight foresight;
  foresight.retarget(two_areas({}));
  for (double time_s = 0.0; time_s < 300.0; time_s += 1.0) EXPECT_FALSE(foresight.is_due(4, time_s));
}

TEST(DeadlineForesight, Looks_when_drones_have_come_or_gone_for_good_and_every_half_minute) {
  DeadlineForesight foresight;
  foresight.retarget(two_areas(100.0));
  EXPECT_EQ(foresight.horizon_s(), 200.0);
  EXPECT_FALSE(foresight.is_due(6, 0.0)) << "they may all be taking off";
  EXPECT_TRUE(foresight.is_due(6, 4.0));
  EXPECT_FALSE(foresight.is_due(6, 5.0));
  EXPECT_FALSE(foresight.is_due(5, 6.0));
  EXPECT_FALSE(foresight.is_due(6, 7.0)) << "it was back before it counted";
  EXPECT_FALSE(foresight.is_due(6, 20.0));
  EXPECT_TRUE(foresight.is_due(6, 34.5));
  EXPECT_FALSE(foresight.is_due(4, 40.0));
  EXPECT_TRUE(foresight.is_due(4, 43.5));
  foresight.retarget(two_areas(50.0));
  EXPECT_TRUE(foresight.is_due(4, 44.0));
}

TEST(DeadlineForesight, A_flight_that_begins_anew_is_looked_at_anew) {
  DeadlineForesight foresight;
  foresight.retarget(two_areas(100.0));
  ASSERT_FALSE(foresight.is_due(4, 500.0));
  ASSERT_TRUE(foresight.is_due(4, 504.0));
  EXPECT_TRUE(foresight.is_due(4, 600.0));
  EXPECT_FALSE(foresight.is_due(3, 601.0));
  EXPECT_TRUE(foresight.is_due(3, 605.0));
}

TEST(DeadlineForesight, Says_once_who_will_be_late_by_how_much_and_once_that_nobody_will) {
  DeadlineForesight foresight;
  foresight.retarget(two_areas(100.0));
  EXPECT_FALSE(foresight.take(outlook(110.0), 6, 6)) << "within what an outlook errs";
  const auto words = foresight.take(outlook(165.0), 4, 6);
  ASSERT_TRUE(words);
  EXPECT_EQ(words->severity, Severity::kWarning);
  EXPECT_EQ(words->text, "with 4 of 6 drones: ridge unseen for up to 165 s, 65 s beyond its deadline");
  EXPECT_NE(words->next.find("protect"), std::string::npos);
  EXPECT_FALSE(foresight.take(outlook(180.0), 4, 6));
  EXPECT_EQ(foresight.foreseen_s({TargetKind::kArea, "ridge"}), 180.0);
  EXPECT_FALSE(foresight.foreseen_s({TargetKind::kArea, "mast"}));
  const auto relief = foresight.take(outlook(90.0), 6, 6);
  ASSERT_TRUE(relief);
  EXPECT_EQ(relief->severity, Severity::kInfo);
}

}  // namespace
}  // namespace vigil::runtime
