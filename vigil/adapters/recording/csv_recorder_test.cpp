#include "vigil/adapters/recording/csv_recorder.hpp"

#include <algorithm>

#include "vigil/adapters/recording/flight_for_tests.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/small_disk_for_tests.hpp"

namespace vigil::recording {
namespace {

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "";
}

/// What `vigil export` leaves of a flight made by hand.
void export_flight(const std::filesystem::path& folder, std::size_t ticks, std::size_t drones,
                   std::uint64_t keep_every = 1) {
  CsvRecorder recorder(folder / "out", "format: 1\nname: by hand\n", keep_every);
  record_flight(recorder, ticks, drones);
}

TEST(CsvRecorder, Writes_one_line_a_tick_and_one_a_drone_and_tick) {
  const TemporaryFolder folder;
  export_flight(folder.path(), 10, 3);
  EXPECT_EQ(lines_of(contents(folder.file("ticks.csv"))), 1U + 10U);
  EXPECT_EQ(lines_of(contents(folder.file("drones.csv"))), 1U + 30U);
  EXPECT_EQ(contents(folder.file("mission.yaml")), "format: 1\nname: by hand\n");
}

TEST(CsvRecorder, The_same_flight_gives_the_same_bytes) {
  const TemporaryFolder a;
  const TemporaryFolder b;
  export_flight(a.path(), 40, 3);
  export_flight(b.path(), 40, 3);
  for (const char* name : {"mission.yaml", "ticks.csv", "drones.csv", "targets.csv", "events.csv"}) {
    EXPECT_EQ(contents(a.file(name)), contents(b.file(name))) << name;
  }
}

TEST(CsvRecorder, Positions_are_written_in_the_world_frame) {
  const TemporaryFolder folder;
  runtime::Mission mission = mission_of(1);
  mission.field.origin_m = {10.0, -5.0};
  mission.field.yaw_rad = 0.0;
  CsvRecorder recorder(folder.path() / "out", "");
  recorder.begin(mission, {});
  swarm::Snapshot snapshot = snapshot_at(0, 1);
  snapshot.drones[0].position = {0.25, 0.5};
  record(recorder, snapshot);
  recorder.finish();
  EXPECT_NE(contents(folder.file("drones.csv")).find("\n0,cf1,flying,active,10.25,-4.5,0.5,"), std::string::npos);
}

TEST(CsvRecorder, What_is_not_known_leaves_an_empty_cell) {
  const TemporaryFolder folder;
  CsvRecorder recorder(folder.path() / "out", "");
  recorder.begin(mission_of(1), {});
  const swarm::Snapshot snapshot = snapshot_at(0, 1);
  recorder.record({snapshot, {}, {}, {}, {}});
  recorder.finish();
  EXPECT_NE(contents(folder.file("ticks.csv")).find("\n0,,,1,none,0,,,,\n"), std::string::npos);
  EXPECT_NE(contents(folder.file("drones.csv")).find(",0,,,\n"), std::string::npos);
}

TEST(CsvRecorder, Text_with_commas_quotes_and_line_ends_is_quoted) {
  const TemporaryFolder folder;
  export_flight(folder.path(), 2, 1);
  EXPECT_NE(contents(folder.file("events.csv")).find("0,mission,begin,,\"said \"\"go\"\",\nand went\"\n"),
            std::string::npos);
  EXPECT_NE(contents(folder.file("targets.csv")).find("0,cluster,\"east, \"\"far\"\"\",2,,,false,0.7,0.25\n"),
            std::string::npos);
}

TEST(CsvRecorder, A_list_of_targets_tells_deadlines_soft_edges_no_fly_polygons_and_the_floor) {
  const TemporaryFolder folder;
  CsvRecorder recorder(folder.path() / "out", "");
  recorder.begin(mission_of(1), {});
  runtime::MissionTargets targets;
  targets.targets.clusters.push_back({"camp", {{0.5, 0.25}}, 2.0, 60.0, true});
  targets.targets.areas.push_back({"pond", {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}, 3.0, 0.125, {}});
  targets.targets.uniform_floor = 0.5;
  targets.no_fly.push_back({"mast", {{0.0, 0.0}, {2.0, 0.0}, {0.0, 2.0}}});
  recorder.targets(4.0, targets);
  recorder.finish();
  EXPECT_EQ(contents(folder.file("targets.csv")),
            "t_s,kind,name,weight,revisit_s,soft_edge_m,protect,x_m,y_m\n"
            "4,cluster,camp,2,60,,true,0.5,0.25\n"
            "4,area,pond,3,,0.125,false,0,0\n4,area,pond,3,,0.125,false,1,0\n4,area,pond,3,,0.125,false,0,1\n"
            "4,no_fly,mast,,,,,0,0\n4,no_fly,mast,,,,,2,0\n4,no_fly,mast,,,,,0,2\n"
            "4,floor,,0.5,,,,,\n");
}

TEST(CsvRecorder, Keeps_every_third_tick_and_the_first_and_the_last) {
  const TemporaryFolder folder;
  export_flight(folder.path(), 12, 2, 3);
  const std::string ticks = contents(folder.file("ticks.csv"));
  EXPECT_EQ(lines_of(ticks), 1U + 5U);  // 0, 3, 6, 9 and 11
  EXPECT_NE(ticks.find("\n0.22,"), std::string::npos);
  EXPECT_EQ(lines_of(contents(folder.file("drones.csv"))), 1U + 10U);
}

TEST(CsvRecorder, A_close_call_in_a_tick_that_was_left_out_is_kept) {
  const TemporaryFolder folder;
  CsvRecorder recorder(folder.path() / "out", "", 10);
  recorder.begin(mission_of(1), {});
  for (std::size_t tick = 0; tick <= 10; ++tick) {
    swarm::Snapshot snapshot = snapshot_at(tick, 1);
    snapshot.fallback = tick == 4;
    recorder.record({snapshot, {}, {}, {}, {.active_pair_m = tick == 4 ? 0.125 : 0.5}});
  }
  recorder.finish();
  const std::string ticks = contents(folder.file("ticks.csv"));
  EXPECT_NE(ticks.find(",none,1,,0.125,,\n"), std::string::npos);
}

TEST(CsvRecorder, The_nearest_of_what_holds_a_drone_is_named) {
  const TemporaryFolder folder;
  CsvRecorder recorder(folder.path() / "out", "");
  recorder.begin(mission_of(3), {});
  swarm::Snapshot snapshot = snapshot_at(0, 3);
  snapshot.drones[0].filter.holding = {{{safety::RowKind::kWall, 3, 0.4}, {safety::RowKind::kNeighbour, 2, 0.25}}};
  snapshot.drones[0].filter.holding_count = 2;
  snapshot.drones[1].filter.holding[0] = {safety::RowKind::kWall, 0, 0.5};
  snapshot.drones[1].filter.holding_count = 1;
  record(recorder, snapshot);
  recorder.finish();
  const std::string drones = contents(folder.file("drones.csv"));
  EXPECT_NE(drones.find(",drone:cf3,0.25,"), std::string::npos);
  EXPECT_NE(drones.find(",wall:left,0.5,"), std::string::npos);
}

TEST(CsvRecorder, A_folder_that_cannot_be_made_is_refused_at_the_beginning) {
  const TemporaryFolder folder;
  overwrite(folder.path() / "file", "");
  CsvRecorder recorder(folder.path() / "file", "");
  const std::string message = message_of([&] { recorder.begin(mission_of(1), {}); });
  EXPECT_NE(message.find("file: cannot create the folder"), std::string::npos) << message;
}

TEST(CsvRecorder, An_earlier_recording_is_not_overwritten) {
  const TemporaryFolder folder;
  export_flight(folder.path(), 3, 1);
  const std::string before = contents(folder.file("drones.csv"));
  CsvRecorder recorder(folder.path() / "out", "other");
  EXPECT_NE(message_of([&] { recorder.begin(mission_of(1), {}); }), "");
  EXPECT_EQ(contents(folder.file("drones.csv")), before);
}

TEST(CsvRecorder, A_full_disk_does_not_end_the_flight_and_is_told_at_the_end) {
  const TemporaryFolder folder;
  std::string message;
  {
    const SmallDisk disk(1 << 19);
    CsvRecorder recorder(folder.path() / "out", "");
    recorder.begin(mission_of(3), {});
    for (std::size_t tick = 0; tick < 3000; ++tick) record(recorder, snapshot_at(tick, 3));
    message = message_of([&] { recorder.finish(); });
  }
  EXPECT_NE(message.find("drones.csv: cannot write it: File too large"), std::string::npos) << message;
  EXPECT_EQ(contents(folder.file("events.csv")).find("finished"), std::string::npos);
}

TEST(CsvFile, A_device_that_takes_nothing_is_named_with_the_reason) {
  CsvFile file = CsvFile::opened("/dev/full");
  file.cell(std::uint64_t{1});
  file.end_row();
  EXPECT_FALSE(file.close());
  EXPECT_EQ(file.error(), "/dev/full: cannot write it: No space left on device");
}

}  // namespace
}  // namespace vigil::recording
