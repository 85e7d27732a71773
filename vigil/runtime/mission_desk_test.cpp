#include "vigil/runtime/mission_desk.hpp"

#include <gtest/gtest.h>

#include "vigil/runtime/live_world_for_tests.hpp"

namespace vigil::runtime {
namespace {

const TargetName kEast{TargetKind::kCluster, "east"};
const TargetName kWest{TargetKind::kArea, "west"};
const TargetName kMast{TargetKind::kNoFly, "mast"};

std::optional<Refusal> change(MissionDesk& desk, const std::vector<TargetEdit>& edits) {
  return desk.edit(edits, desk.revision(), "Ana");
}

/// Why the change is refused; empty where it is not.
std::string reason(const std::vector<TargetEdit>& edits) {
  MissionDesk desk(small_mission());
  const Mission before = desk.mission();
  const auto refusal = change(desk, edits);
  if (!refusal) return "";
  EXPECT_EQ(desk.mission(), before);
  EXPECT_EQ(desk.revision(), 1U);
  EXPECT_EQ(refusal->code, Refusal::Code::kInvalid);
  return refusal->reason;
}

TEST(MissionDeskTest, Every_kind_of_edit_does_what_it_says) {
  MissionDesk desk(small_mission());
  const std::vector<TargetEdit> edits{
      AddPoint{kEast, {1.0, 11.0}, std::nullopt},
      AddPoint{kEast, {1.1, 11.0}, 0},
      MovePoint{kEast, 1, {1.3, 11.1}},
      RemovePoint{kEast, 2},
      SetWeight{kEast, 3.0},
      SetRevisit{kEast, std::nullopt},
      AddPoint{{TargetKind::kCluster, "new"}, {0.0, 10.5}, std::nullopt},
      RenameEntry{kWest, "far west"},
      SetSoftEdge{{TargetKind::kArea, "far west"}, 0.2},
      SetRevisit{{TargetKind::kArea, "far west"}, 60.0},
      AddEntry{NoFlyEntry{"pond", {{1.5, 10.2}, {1.7, 10.2}, {1.6, 10.4}}}},
      MovePoint{kMast, 0, {0.41, 11.41}},
      SetUniformFloor{0.1},
  };
  ASSERT_FALSE(change(desk, edits)) << change(desk, edits)->reason;
  const Mission& mission = desk.mission();
  ASSERT_EQ(mission.targets.clusters.size(), 2U);
  const ClusterEntry& east = mission.targets.clusters[0];
  EXPECT_EQ(east.points_m, (std::vector<Vec2>{{1.1, 11.0}, {1.3, 11.1}, {1.0, 11.0}}));
  EXPECT_EQ(east.weight, 3.0);
  EXPECT_FALSE(east.revisit_s);
  EXPECT_EQ(mission.targets.clusters[1].name, "new");
  EXPECT_EQ(mission.targets.areas[0].name, "far west");
  EXPECT_EQ(mission.targets.areas[0].soft_edge_m, 0.2);
  EXPECT_EQ(mission.targets.areas[0].revisit_s, 60.0);
  EXPECT_EQ(mission.no_fly.size(), 2U);
  EXPECT_EQ(mission.no_fly[0].outline_m[0], Vec2(0.41, 11.41));
  EXPECT_EQ(mission.targets.uniform_floor, 0.1);
  EXPECT_EQ(desk.revision(), 2U);
  EXPECT_EQ(desk.by(), "Ana");
}

TEST(MissionDeskTest, A_cluster_goes_with_its_last_point) {
  MissionDesk desk(small_mission());
  ASSERT_FALSE(change(desk, {RemovePoint{kEast, 0}, RemovePoint{kEast, 0}}));
  EXPECT_TRUE(desk.mission().targets.clusters.empty());
}

TEST(MissionDeskTest, The_rules_of_mission_files_hold_with_the_entrys_name) {
  const auto refuses = [](const std::vector<TargetEdit>& edits, const std::string& part) {
    const std::string why = reason(edits);
    EXPECT_NE(why.find(part), std::string::npos) << why;
  };
  refuses({MovePoint{kEast, 0, {9.0, 9.0}}}, "cluster east, point 1 = [9, 9]: ");
  refuses({MovePoint{kEast, 0, {9.0, 9.0}}}, "is outside the field");
  refuses({MovePoint{kEast, 0, {0.5, 11.5}}}, "in the no-fly polygon mast");
  refuses({SetWeight{kEast, -1.0}}, "must be in [0, 1000000]");
  refuses({SetWeight{kEast, std::nan("")}}, "must be");
  refuses({RenameEntry{kWest, "east"}}, "is also the name of");
  refuses({RenameEntry{kWest, "two\nlines"}}, "one line");
  refuses({MovePoint{kWest, 0, {0.5, 10.6}}, MovePoint{kWest, 1, {-0.8, 11.0}}}, "crosses or touches itself");
  refuses({RemovePoint{kMast, 0}, RemovePoint{kMast, 0}}, "3 to 1000 points");
  refuses({SetUniformFloor{1.5}}, "must be in [0, 1]");
  refuses({AddEntry{ClusterEntry{"empty", {}, 1.0, {}}}}, "1 to 10000 points");
}

TEST(MissionDeskTest, Refusals_speak_of_what_is_on_the_map_and_not_of_keys_of_a_file) {
  const std::vector<std::pair<std::vector<TargetEdit>, std::string>> refusals{
      {{MovePoint{kEast, 0, {9.0, 9.0}}}, "cluster east, point 1 = [9, 9]: is outside the field"},
      {{MovePoint{kWest, 0, {0.5, 10.6}}, MovePoint{kWest, 1, {-0.8, 11.0}}}, "area west, outline: crosses"},
      {{MovePoint{kMast, 1, {1e9, 0.0}}}, "no-fly polygon mast, corner 2"},
      {{SetWeight{kEast, -1.0}}, "cluster east, weight = -1: must be in [0, 1000000]"},
      {{SetRevisit{kEast, -3.0}}, "cluster east, deadline = -3: "},
      {{SetSoftEdge{kWest, -1.0}}, "area west, soft edge = -1: "},
      {{SetUniformFloor{1.5}}, "share that is spread evenly = 1.5: "},
  };
  for (const auto& [edits, beginning] : refusals) {
    const std::string why = reason(edits);
    EXPECT_EQ(why.substr(0, beginning.size()), beginning) << why;
    for (const char* key : {"targets.", "_m", "[0]", "outside_field", "origin"})
      EXPECT_EQ(why.find(key), std::string::npos) << key << ": " << why;
  }
}

TEST(MissionDeskTest, What_is_not_there_is_said_and_nothing_of_the_change_happens) {
  EXPECT_EQ(reason({SetWeight{kEast, 2.0}, SetWeight{{TargetKind::kCluster, "west"}, 2.0}}),
            "edits[1]: there is no cluster west");
  EXPECT_EQ(reason({MovePoint{kEast, 2, {0, 0}}}), "edits[0]: east has no point 2; its 2 points count from 0");
  EXPECT_EQ(reason({SetWeight{kMast, 2.0}}), "edits[0]: mast has no weight");
  EXPECT_EQ(reason({}).substr(0, 6), "edits:");
  EXPECT_EQ(reason(std::vector<TargetEdit>(2001, SetWeight{kEast, 2.0})).substr(0, 6), "edits:");
}

TEST(MissionDeskTest, Two_people_who_change_different_things_do_not_hinder_each_other) {
  MissionDesk desk(small_mission());
  const std::vector<TargetEdit> hers{SetWeight{kEast, 2.0}};
  const std::vector<TargetEdit> his{SetWeight{kWest, 9.0}};
  const std::vector<TargetEdit> also_east{MovePoint{kEast, 0, {1.0, 11.0}}};
  EXPECT_FALSE(desk.edit(hers, 1, "Ana"));
  EXPECT_FALSE(desk.edit(his, 1, "Ben"));
  const auto refusal = desk.edit(also_east, 1, "Ben");
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, Refusal::Code::kStale);
  EXPECT_FALSE(desk.edit(also_east, desk.revision(), "Ben"));
}

TEST(MissionDeskTest, A_change_of_a_revision_that_is_yet_to_come_is_told_which_is_the_newest) {
  MissionDesk desk(small_mission());
  const std::vector<TargetEdit> edits{SetWeight{kEast, 2.0}};
  const auto refusal = desk.edit(edits, 99, "Ana");
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, Refusal::Code::kStale);
  EXPECT_EQ(refusal->reason, "based_on: there is no revision 99; the newest is 1; look at that and change it again");
}

TEST(MissionDeskTest, A_change_of_a_revision_that_nobody_knows_any_more_is_told_that_all_may_be_new) {
  MissionDesk desk(small_mission());
  const std::vector<TargetEdit> edits{SetWeight{kEast, 2.0}};
  const auto refusal = desk.edit(edits, 0, "Ana");
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->reason, "mission changed it since revision 0: all targets; look at it and change it again");
}

TEST(MissionDeskTest, Undo_and_redo_walk_through_all_changes_and_a_new_one_ends_redo) {
  MissionDesk desk(small_mission());
  const Mission first = desk.mission();
  EXPECT_EQ(desk.undo(desk.revision(), "Ana")->code, Refusal::Code::kNotNow);
  ASSERT_FALSE(change(desk, {SetWeight{kEast, 2.0}}));
  ASSERT_FALSE(change(desk, {RemoveEntry{kMast}}));
  const Mission last = desk.mission();
  EXPECT_EQ(*desk.undo_what(), "mast: removed");
  ASSERT_FALSE(desk.undo(desk.revision(), "Ben"));
  ASSERT_FALSE(desk.undo(desk.revision(), "Ben"));
  EXPECT_EQ(desk.mission(), first);
  EXPECT_EQ(desk.by(), "Ben");
  EXPECT_EQ(desk.what(), "undone: east: weight 2");
  EXPECT_EQ(desk.undo_what(), nullptr);
  ASSERT_FALSE(desk.redo(desk.revision(), "Ben"));
  ASSERT_FALSE(desk.redo(desk.revision(), "Ben"));
  EXPECT_EQ(desk.mission(), last);
  EXPECT_EQ(desk.revision(), 7U);
  ASSERT_FALSE(desk.undo(desk.revision(), "Ana"));
  ASSERT_FALSE(change(desk, {SetWeight{kWest, 1.0}}));
  EXPECT_EQ(desk.redo(desk.revision(), "Ana")->code, Refusal::Code::kNotNow);
}

TEST(MissionDeskTest, Nobody_takes_back_a_change_that_they_have_not_seen) {
  MissionDesk desk(small_mission());
  ASSERT_FALSE(change(desk, {SetWeight{kEast, 2.0}}));
  ASSERT_FALSE(change(desk, {RemoveEntry{kMast}}));
  const Mission last = desk.mission();
  const auto undo = desk.undo(2, "Ben");
  ASSERT_TRUE(undo);
  EXPECT_EQ(undo->code, Refusal::Code::kStale);
  EXPECT_NE(undo->reason.find("mast: removed"), std::string::npos) << undo->reason;
  EXPECT_EQ(desk.mission(), last);
  ASSERT_FALSE(desk.undo(3, "Ben"));
  EXPECT_EQ(desk.redo(3, "Ben")->code, Refusal::Code::kStale);
  EXPECT_FALSE(desk.redo(4, "Ben"));
}

TEST(MissionDeskTest, History_is_bounded) {
  MissionDesk desk(small_mission());
  for (std::size_t n = 0; n < MissionDesk::kMostUndo + 10; ++n)
    ASSERT_FALSE(change(desk, {SetWeight{kEast, static_cast<double>(n)}}));
  std::size_t undone = 0;
  while (!desk.undo(desk.revision(), "Ana")) ++undone;
  EXPECT_EQ(undone, MissionDesk::kMostUndo);
}

TEST(MissionDeskTest, A_draft_shows_what_an_edit_would_do_and_changes_nothing) {
  const MissionDesk desk(small_mission());
  const std::vector<TargetEdit> edits{SetWeight{kEast, 2.0}};
  const auto draft = desk.draft(edits, 1);
  ASSERT_TRUE(std::holds_alternative<Mission>(draft));
  EXPECT_EQ(std::get<Mission>(draft).targets.clusters[0].weight, 2.0);
  EXPECT_EQ(desk.mission().targets.clusters[0].weight, 1.0);
}

TEST(MissionDeskTest, An_event_of_a_mission_file_is_an_edit_like_an_operators) {
  MissionDesk desk(small_mission());
  const MissionTargets targets{desk.mission().targets, desk.mission().no_fly};
  EventEntry event;
  event.what = EventKind::kSetWeight;
  event.cluster = "west";
  event.weight = 4.0;
  ASSERT_FALSE(change(desk, {edit_of(targets, event)}));
  EXPECT_EQ(desk.mission().targets.areas[0].weight, 4.0);
  event.what = EventKind::kRemoveTarget;
  event.cluster = "east";
  event.target = 2;  // people count from 1
  ASSERT_FALSE(change(desk, {edit_of(targets, event)}));
  EXPECT_EQ(desk.mission().targets.clusters[0].points_m, std::vector<Vec2>{Vec2(1.2, 11.0)});
}

}  // namespace
}  // namespace vigil::runtime
