#include "vigil/adapters/recording/read_recording.hpp"

#include <limits>
#include <random>

#include "vigil/adapters/recording/flight_for_tests.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/core/field/field.hpp"

namespace vigil::recording {
namespace {

using runtime::RecordedFlight;

std::string message_of(const std::filesystem::path& directory, const ReadLimits& limits = {}) {
  try {
    (void)read_recording(directory, limits);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "";
}

void replace_once(const std::filesystem::path& path, const std::string& from, const std::string& to) {
  std::string text = contents(path);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  overwrite(path, text.replace(at, from.size(), to));
}

TEST(ReadRecording, Gives_back_what_was_recorded_to_the_last_bit) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 30, 3);
  const RecordedFlight flight = read_recording(folder.path());
  ASSERT_TRUE(flight.is_complete) << flight.incomplete_reason;
  ASSERT_EQ(flight.tick_count(), 30U);
  EXPECT_EQ(flight.drones, (std::vector<std::string>{"cf1", "cf2", "cf3"}));
  const runtime::Mission mission = mission_of(3);
  const field::WorldFrame frame{mission.field.origin_m, mission.field.yaw_rad};
  for (std::size_t tick = 0; tick < 30; ++tick) {
    const swarm::Snapshot snapshot = snapshot_at(tick, 3);
    EXPECT_EQ(flight.ticks.time_s[tick], snapshot.time_s);
    EXPECT_EQ(flight.ticks.clearances[tick].airborne_pair_m, 0.5 + snapshot.time_s);
    EXPECT_EQ(flight.ticks.clearances[tick].no_fly_m, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t row = flight.row(tick, i);
      EXPECT_EQ(flight.rows.position_m[row], frame.point_to_world(snapshot.drones[i].position));
      EXPECT_EQ(flight.rows.command_m_s[row], frame.vector_to_world(snapshot.drones[i].order.velocity));
      EXPECT_EQ(flight.rows.true_position_m[row], frame.point_to_world(truth_of(snapshot)[i].position));
      EXPECT_TRUE(flight.is_active(tick, i));
    }
  }
  EXPECT_TRUE(std::isnan(flight.ticks.metric[0]));
  EXPECT_EQ(flight.ticks.metric[29], snapshot_at(29, 3).metric);
}

TEST(ReadRecording, Targets_are_the_complete_list_of_each_time) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 3, 1);
  const RecordedFlight flight = read_recording(folder.path());
  const runtime::TargetsSection targets = mission_of(1).targets;
  ASSERT_EQ(flight.targets.size(), 2U);
  EXPECT_EQ(flight.targets[0].clusters, targets.clusters);
  EXPECT_EQ(flight.targets[0].areas, targets.areas);
  EXPECT_EQ(flight.targets[1].time_s, 0.5);
  EXPECT_TRUE(flight.targets[1].clusters.empty());
}

TEST(ReadRecording, Events_come_back_without_the_recorders_own_last_line) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 3, 2);
  const RecordedFlight flight = read_recording(folder.path());
  ASSERT_EQ(flight.events.size(), 2U);
  EXPECT_EQ(flight.events[0].detail, "said \"go\",\nand went");
  EXPECT_EQ(flight.events[1].drone, "cf2");
}

TEST(ReadRecording, What_holds_a_drone_is_read_back) {
  const TemporaryFolder folder;
  CsvRecorder recorder(folder.path(), "");
  recorder.begin(mission_of(2));
  swarm::Snapshot snapshot = snapshot_at(0, 2);
  snapshot.drones[0].filter.holding[0] = {safety::RowKind::kNeighbour, 1, 0.25};
  snapshot.drones[0].filter.holding_count = 1;
  snapshot.drones[1].filter.holding[0] = {safety::RowKind::kNoFly, 7, 0.125};
  snapshot.drones[1].filter.holding_count = 1;
  record(recorder, snapshot);
  recorder.finish();
  const RecordedFlight flight = read_recording(folder.path());
  ASSERT_TRUE(flight.rows.held_by[0] && flight.rows.held_by[1]);
  EXPECT_EQ(flight.rows.held_by[0]->kind, safety::RowKind::kNeighbour);
  EXPECT_EQ(flight.rows.held_by[0]->index, 1);
  EXPECT_EQ(flight.rows.held_by[1]->kind, safety::RowKind::kNoFly);
  EXPECT_EQ(flight.rows.held_by[1]->index, 7);
  EXPECT_EQ(flight.rows.held_by[1]->distance_m, 0.125);
}

TEST(ReadRecording, One_that_was_cut_off_anywhere_is_read_up_to_its_last_complete_tick) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 8, 2);
  const std::string whole = contents(folder.file("drones.csv"));
  std::size_t least = 8;
  for (std::size_t bytes = whole.size() - 1; bytes > whole.size() / 2; --bytes) {
    overwrite(folder.file("drones.csv"), whole.substr(0, bytes));
    const RecordedFlight flight = read_recording(folder.path());
    EXPECT_FALSE(flight.is_complete);
    EXPECT_FALSE(flight.incomplete_reason.empty());
    EXPECT_LE(flight.tick_count(), least);
    EXPECT_EQ(flight.rows.mode.size(), 2 * flight.tick_count());
    EXPECT_EQ(flight.ticks.metric.size(), flight.tick_count());
    least = flight.tick_count();
  }
  EXPECT_LT(least, 5U);
}

TEST(ReadRecording, Rows_of_drones_without_their_tick_are_left_out) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 8, 2);
  const std::string ticks = contents(folder.file("ticks.csv"));
  overwrite(folder.file("ticks.csv"), ticks.substr(0, ticks.rfind('\n', ticks.size() - 2) + 1));
  const RecordedFlight flight = read_recording(folder.path());
  EXPECT_FALSE(flight.is_complete);
  EXPECT_EQ(flight.tick_count(), 7U);
}

TEST(ReadRecording, One_that_was_never_finished_says_so) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 5, 1);
  const std::string events = contents(folder.file("events.csv"));
  overwrite(folder.file("events.csv"), events.substr(0, events.rfind('\n', events.size() - 2) + 1));
  const RecordedFlight flight = read_recording(folder.path());
  EXPECT_FALSE(flight.is_complete);
  EXPECT_EQ(flight.tick_count(), 5U);
}

TEST(ReadRecording, One_without_a_tick_is_refused) {
  const TemporaryFolder folder;
  {
    CsvRecorder recorder(folder.path(), "");
    recorder.begin(mission_of(1));
  }
  EXPECT_NE(message_of(folder.path()).find("no complete tick"), std::string::npos);
}

TEST(ReadRecording, A_bad_value_is_named_with_file_line_column_and_advice) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 5, 1);
  replace_once(folder.file("drones.csv"), "\n0.04,cf1,flying,active,", "\n0.04,cf1,flying,lazy,");
  const std::string message = message_of(folder.path());
  EXPECT_NE(message.find("drones.csv:4: activity is 'lazy', expected one of active, never_seen"), std::string::npos)
      << message;
  EXPECT_NE(message.find("cut it off before this line"), std::string::npos) << message;
}

TEST(ReadRecording, Numbers_that_are_none_are_refused) {
  for (const char* bad : {"nan", "inf", "1e999", "0x10", "1 ", "--1", "1e16"}) {
    const TemporaryFolder folder;
    record_flight(folder.path(), 5, 1);
    replace_once(folder.file("ticks.csv"), "\n0.04,", std::string("\n") + bad + ",");
    EXPECT_NE(message_of(folder.path()).find("ticks.csv:4: t_s is '"), std::string::npos) << bad;
  }
}

TEST(ReadRecording, Time_that_goes_back_is_refused) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 5, 1);
  replace_once(folder.file("ticks.csv"), "\n0.04,", "\n0.01,");
  EXPECT_NE(message_of(folder.path()).find("ticks.csv:4: t_s is '0.01', expected a later time"), std::string::npos);
}

TEST(ReadRecording, A_file_of_another_kind_is_refused) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 5, 1);
  overwrite(folder.file("targets.csv"), "a,b\n1,2\n");
  EXPECT_NE(message_of(folder.path()).find("targets.csv:1: the header is 'a,b'"), std::string::npos);
}

TEST(ReadRecording, A_missing_file_is_named) {
  const TemporaryFolder folder;
  EXPECT_NE(message_of(folder.path()).find("mission.yaml: no such file"), std::string::npos);
}

TEST(ReadRecording, A_file_over_the_limit_is_refused_before_it_is_read) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 5, 1);
  EXPECT_NE(message_of(folder.path(), {.file_bytes = 100}).find("more than the 100 that are read"), std::string::npos);
}

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t i = 0, edits = 1 + below(4); i < edits; ++i) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text.erase(at, below(60));
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), below(80)));
        break;
      case 3:
        text.resize(at);
        break;
      default:
        if (!text.empty()) text[at] = "\",\n\r\0-.e9"[below(9)];
    }
  }
  return text;
}

TEST(ReadRecording, Damaged_files_give_an_error_or_a_consistent_flight_and_never_more) {
  const TemporaryFolder folder;
  record_flight(folder.path(), 6, 2);
  std::mt19937 random(20240601);
  std::size_t refused = 0;
  for (const char* name : {"ticks.csv", "drones.csv", "targets.csv", "events.csv"}) {
    const std::string whole = contents(folder.file(name));
    for (int trial = 0; trial < 500; ++trial) {
      overwrite(folder.file(name), mutated(whole, random));
      try {
        const RecordedFlight flight = read_recording(folder.path());
        ASSERT_GE(flight.tick_count(), 1U);
        ASSERT_EQ(flight.rows.true_height_m.size(), flight.tick_count() * flight.drones.size());
        ASSERT_EQ(flight.is_complete, flight.incomplete_reason.empty());
      } catch (const RecordingError& error) {
        ++refused;
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
    overwrite(folder.file(name), whole);
  }
  EXPECT_GT(refused, 500U);
}

}  // namespace
}  // namespace vigil::recording
