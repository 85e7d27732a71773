#include "vigil/adapters/recording/bag_recording.hpp"

#include <bit>
#include <limits>

#include "vigil/adapters/recording/bag_folder.hpp"
#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/adapters/recording/flight_for_tests.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/small_disk_for_tests.hpp"
#include "vigil/adapters/recording/sqlite.hpp"
#include "vigil/runtime/recorded_targets.hpp"
#include "vigil/runtime/recording_playback.hpp"

namespace vigil::recording {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr const char* kText = "format: 1\nname: by hand\n";

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

void fly(const std::filesystem::path& directory, std::size_t ticks, std::size_t drones,
         const BagRecorderOptions& options = {}) {
  BagRecorder recorder(directory, kText, options);
  record_flight(recorder, ticks, drones);
}

bool is_same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// An observation with everything that is hard to write down.
swarm::DroneObservation odd_observation() {
  return {.position = {0.1, -0.0},
          .velocity = {kNaN, std::numeric_limits<double>::denorm_min()},
          .height_m = 1.0 / 3.0,
          .age_s = kInfinite,
          .mode = swarm::VehicleMode::kManual,
          .link_age_s = 1e-300,
          .battery = kNaN};
}

swarm::Command odd_target() {
  auto target = std::make_shared<swarm::CoverageTarget>();
  target->phi_k = ergodic::Coefficients::Constant(3, 3, 0.1);
  target->phi_k(1, 2) = -1.0 / 3.0;
  target->has_targets = true;
  target->no_fly.push_back({{0.1, 0.2}, {0.3, 1.0 / 7.0}});
  return {.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = target};
}

TEST(BagRecording, Knows_the_time_of_day_at_which_a_live_flight_began) {
  const TemporaryFolder simulated;
  fly(simulated.path(), 3, 1);
  EXPECT_EQ(BagRecording(simulated.path()).head().began_ns, 0);
  const TemporaryFolder live;
  const auto began = std::chrono::nanoseconds(1'760'000'000'250'000'000);
  fly(live.path(), 3, 1, {.time_of_day = [&] { return began; }});
  EXPECT_EQ(BagRecording(live.path()).head().began_ns, began.count());
}

TEST(BagRecording, Gives_back_every_bit_of_what_a_tick_was_given) {
  const TemporaryFolder folder;
  const std::vector<swarm::DroneObservation> observations{odd_observation()};
  const std::vector<swarm::Command> commands{
      {.kind = swarm::CommandKind::kGoTo, .drone = swarm::DroneId(0), .place = {0.1, 0.2}, .target = {}}, odd_target()};
  {
    BagRecorder recorder(folder.path(), kText);
    recorder.begin(mission_of(1), {});
    recorder.record({snapshot_at(0, 1), observations, commands, {}, {}});
    recorder.finish();
  }
  BagRecording recording(folder.path());
  runtime::RecordedTick tick(1);
  recording.read(0, tick);
  const swarm::DroneObservation& seen = tick.observations.front();
  const swarm::DroneObservation& given = observations.front();
  EXPECT_TRUE(is_same(seen.position.y(), given.position.y()));
  EXPECT_TRUE(is_same(seen.velocity.x(), given.velocity.x()) && is_same(seen.velocity.y(), given.velocity.y()));
  EXPECT_TRUE(is_same(seen.age_s, given.age_s) && is_same(seen.link_age_s, given.link_age_s));
  EXPECT_TRUE(is_same(seen.battery, given.battery));
  EXPECT_EQ(seen.mode, given.mode);
  ASSERT_EQ(tick.commands.size(), 2U);
  EXPECT_EQ(tick.commands[0].drone, commands[0].drone);
  EXPECT_EQ(tick.commands[0].place, commands[0].place);
  EXPECT_EQ(tick.commands[1].target->phi_k, commands[1].target->phi_k);
  EXPECT_EQ(tick.commands[1].target->no_fly.front().b, commands[1].target->no_fly.front().b);
  EXPECT_TRUE(tick.truth.empty());
  EXPECT_FALSE(tick.damage.has_value());
}

TEST(BagRecording, Gives_back_what_a_tick_decided_and_what_was_true) {
  const TemporaryFolder folder;
  swarm::Snapshot snapshot = snapshot_at(3, 2);
  snapshot.drones[1].filter.holding = {{{safety::RowKind::kNoFly, 7, 0.4}, {safety::RowKind::kNeighbour, 0, 0.25}}};
  snapshot.drones[1].filter.holding_count = 2;
  snapshot.drones[1].filter.crowded = true;
  snapshot.drones[1].filter.nearest = 0;
  {
    BagRecorder recorder(folder.path(), kText);
    recorder.begin(mission_of(2), {});
    recorder.record({snapshot, std::vector<swarm::DroneObservation>(2), {}, truth_of(snapshot), {.wall_m = 0.4}});
    recorder.finish();
  }
  BagRecording recording(folder.path());
  runtime::RecordedTick tick(2);
  recording.read(0, tick);
  const swarm::DroneSnapshot& decided = tick.snapshot.drones[1];
  EXPECT_EQ(tick.snapshot.metric, snapshot.metric);
  EXPECT_EQ(decided.u_nom, snapshot.drones[1].u_nom);
  EXPECT_EQ(decided.order.velocity, snapshot.drones[1].order.velocity);
  EXPECT_EQ(decided.filter.holding[0].kind, safety::RowKind::kNoFly);
  EXPECT_EQ(decided.filter.holding[1].distance_m, 0.25);
  EXPECT_TRUE(decided.filter.crowded);
  EXPECT_EQ(decided.filter.nearest, 0);
  EXPECT_EQ(tick.truth[1].position, truth_of(snapshot)[1].position);
  EXPECT_EQ(tick.clearances.wall_m, 0.4);
  EXPECT_EQ(tick.clearances.no_fly_m, kInfinite);
}

TEST(BagRecording, Gives_back_how_the_flight_began) {
  const TemporaryFolder folder;
  runtime::FlightStart start{swarm::Intent::kHold, swarm::SwarmPast{}};
  start.past->ticks = 4711;
  start.past->first_metric = 0.1;
  start.past->has_first_metric = true;
  start.past->coverage.sum = ergodic::Coefficients::Constant(11, 11, 1.0 / 3.0);
  start.past->coverage.past_averages = ergodic::Coefficients::Zero(11, 11);
  BagRecorder recorder(folder.path(), kText);
  recorder.begin(mission_of(2), start);
  recorder.finish();
  const BagRecording recording(folder.path());
  const runtime::RecordingHead& head = recording.head();
  EXPECT_EQ(head.mission_text, kText);
  EXPECT_EQ(head.parameters.drones, 2U);
  EXPECT_EQ(head.parameters.first_intent, swarm::Intent::kHold);
  ASSERT_TRUE(head.start.past.has_value());
  EXPECT_EQ(head.start.past->ticks, 4711U);
  EXPECT_EQ(head.start.past->coverage.sum, start.past->coverage.sum);
}

TEST(BagRecording, Targets_and_events_come_back_in_the_order_of_time) {
  const TemporaryFolder folder;
  fly(folder.path(), 10, 2);
  const BagRecording recording(folder.path());
  ASSERT_EQ(recording.targets().size(), 2U);
  EXPECT_EQ(recording.targets()[0].clusters.front().name, "east, \"far\"");
  EXPECT_EQ(recording.targets()[0].areas.front().outline_m, mission_of(1).targets.areas.front().outline_m);
  EXPECT_TRUE(recording.targets()[1].clusters.empty());
  ASSERT_EQ(recording.events().size(), 2U);
  EXPECT_EQ(recording.events()[0].detail, "said \"go\",\nand went");
  EXPECT_EQ(recording.events()[1].drone, "cf2");
  EXPECT_EQ(recording.incomplete_reason(), "");
}

TEST(BagRecording, The_same_flight_gives_the_same_bytes) {
  const TemporaryFolder a;
  const TemporaryFolder b;
  fly(a.path(), 400, 5);
  fly(b.path(), 400, 5);
  for (const char* name : {"recording/recording_0.db3", "recording/metadata.yaml", "recording/mission.yaml"})
    EXPECT_EQ(contents(a.path() / name), contents(b.path() / name)) << name;
}

TEST(BagRecording, What_was_flushed_is_there_before_the_recording_is_finished) {
  const TemporaryFolder folder;
  BagRecorder recorder(folder.path(), kText);
  recorder.begin(mission_of(2), {});
  for (std::size_t tick = 0; tick < 50; ++tick) record(recorder, snapshot_at(tick, 2));
  EXPECT_EQ(BagRecording(folder.path()).tick_count(), 0U);
  recorder.flush();
  const BagRecording recording(folder.path());
  EXPECT_EQ(recording.tick_count(), 50U);
  EXPECT_NE(recording.incomplete_reason(), "");
}

TEST(BagRecording, Goes_on_in_another_file_when_one_has_its_size) {
  const TemporaryFolder folder;
  BagRecorderOptions options;
  options.bag.split_bytes = 20'000;
  fly(folder.path(), 200, 2, options);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "recording/recording_3.db3"));
  BagRecording recording(folder.path());
  ASSERT_EQ(recording.tick_count(), 200U);
  runtime::RecordedTick tick(2);
  for (std::uint64_t number = 0; number < 200; ++number) {
    recording.read(number, tick);
    EXPECT_EQ(tick.snapshot.tick, number);
  }
  EXPECT_EQ(recording.incomplete_reason(), "");
}

TEST(BagRecording, Keeps_every_third_tick_and_the_last_with_what_was_known) {
  const TemporaryFolder folder;
  fly(folder.path(), 12, 2, {.keep_every = 3});
  BagRecording recording(folder.path());
  const runtime::RecordedFlight flight = runtime::collect(recording, mission_of(2));
  ASSERT_EQ(flight.tick_count(), 5U);  // 0, 3, 6, 9 and 11
  EXPECT_EQ(flight.ticks.time_s.back(), snapshot_at(11, 2).time_s);
  const field::WorldFrame frame{mission_of(2).field.origin_m, mission_of(2).field.yaw_rad};
  EXPECT_EQ(flight.rows.position_m[flight.row(1, 1)], frame.point_to_world(snapshot_at(3, 2).drones[1].position));
}

TEST(BagRecording, Keeps_the_disk_from_filling_up_and_says_so) {
  const TemporaryFolder folder;
  BagRecorderOptions options;
  options.bag.keep_free_bytes = std::numeric_limits<std::uint64_t>::max();
  BagRecorder recorder(folder.path(), kText, options);
  EXPECT_NE(message_of([&] { recorder.begin(mission_of(1), {}); }).find("are to stay free; make room"),
            std::string::npos);
}

TEST(BagRecording, Where_it_cannot_begin_it_leaves_nothing_behind) {
  const TemporaryFolder folder;
  const std::filesystem::path results = folder.path() / "results";
  BagRecorderOptions options;
  options.bag.keep_free_bytes = std::numeric_limits<std::uint64_t>::max();
  BagRecorder guarded(results, kText, options);
  EXPECT_THROW(guarded.begin(mission_of(1), {}), RecordingError);
  EXPECT_FALSE(std::filesystem::exists(results));
  {
    const SmallDisk disk(1 << 12);
    BagRecorder full(results, kText);
    EXPECT_THROW(full.begin(mission_of(1), {}), RecordingError);
  }
  EXPECT_FALSE(std::filesystem::exists(results));
}

TEST(BagRecording, A_full_disk_does_not_end_the_flight_and_what_was_kept_before_can_be_read) {
  const TemporaryFolder folder;
  BagRecorder recorder(folder.path(), kText);
  {
    const SmallDisk disk(1 << 19);
    recorder.begin(mission_of(3), {});
    for (std::size_t tick = 0; tick < 3000; ++tick) {
      record(recorder, snapshot_at(tick, 3));
      if (tick % 10 == 9) recorder.flush();
    }
    EXPECT_NE(recorder.trouble().find("recording_0.db3"), std::string::npos) << recorder.trouble();
    EXPECT_NE(message_of([&] { recorder.finish(); }).find("not complete"), std::string::npos);
  }
  const BagRecording recording(folder.path());
  EXPECT_GT(recording.tick_count(), 100U);
  EXPECT_NE(recording.incomplete_reason(), "");
}

/// Changes one byte of what the nth tick's message says.
void flip(const std::filesystem::path& directory, std::int64_t tick, std::size_t byte) {
  const std::filesystem::path path = directory / "recording/recording_0.db3";
  std::string message;
  {
    const Database database(path, Database::Mode::kRead);
    Statement select(database, "SELECT data FROM messages WHERE topic_id = 2 ORDER BY id LIMIT 1 OFFSET ?");
    select.bind(1, tick);
    ASSERT_TRUE(select.step());
    message.assign(select.bytes(0).begin(), select.bytes(0).end());
  }
  std::string file = contents(path);
  const std::size_t at = file.find(message.substr(0, 40));
  ASSERT_NE(at, std::string::npos);
  file[at + byte] = static_cast<char>(file[at + byte] ^ 1);
  overwrite(path, file);
}

constexpr std::size_t kHeaderBytes = 4 + 88;  // with the number of observations' numbers, before the first of them

TEST(BagRecording, One_flipped_byte_of_an_observation_is_found_with_its_drone) {
  const TemporaryFolder folder;
  fly(folder.path(), 5, 3);
  constexpr std::size_t kSecondDrone = 8 * sizeof(double);
  flip(folder.path(), 2, kHeaderBytes + 8 + kSecondDrone + 7 * sizeof(double) + 3);  // its battery
  BagRecording recording(folder.path());
  runtime::RecordedTick tick(3);
  for (std::uint64_t number = 0; number < 5; ++number) {
    recording.read(number, tick);
    EXPECT_EQ(tick.damage.has_value(), number == 2) << number;
    EXPECT_EQ(tick.damage ? tick.damage->drone : std::nullopt,
              number == 2 ? std::optional<std::size_t>(1) : std::nullopt);
  }
}

TEST(BagRecording, Gives_back_deadlines_soft_edges_and_no_fly_polygons) {
  const TemporaryFolder folder;
  const std::vector<Vec2> outline{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0 / 3.0}};
  runtime::MissionTargets given;
  given.targets.clusters.push_back({"camp", {{0.1, 0.2}}, 2.0, 45.0});
  given.targets.areas.push_back({"pond", outline, 3.0, 0.25, {}});
  given.targets.uniform_floor = 0.125;
  given.no_fly.push_back({"mast", outline});
  {
    BagRecorder recorder(folder.path(), kText);
    recorder.begin(mission_of(1), {});
    recorder.targets(0.5, given);
    recorder.finish();
  }
  const BagRecording recording(folder.path());
  ASSERT_EQ(recording.targets().size(), 1U);
  EXPECT_EQ(runtime::with({}, recording.targets().front()), given);
}

BagRecorderOptions small_files() {
  BagRecorderOptions options;
  options.bag.split_bytes = 20'000;
  return options;
}

std::string incomplete_without(const char* name) {
  const TemporaryFolder folder;
  fly(folder.path(), 200, 2, small_files());
  EXPECT_TRUE(std::filesystem::remove(folder.path() / "recording" / name));
  return BagRecording(folder.path()).incomplete_reason();
}

TEST(BagRecording, Says_which_of_its_files_are_missing) {
  EXPECT_NE(incomplete_without("recording_0.db3").find("recording_0.db3 is missing"), std::string::npos);
  EXPECT_NE(incomplete_without("recording_2.db3").find("recording_2.db3 is missing"), std::string::npos);
  const TemporaryFolder folder;
  fly(folder.path(), 200, 2, small_files());
  const BagFolder bag = look_into(folder.path() / "recording");
  const std::string last = bag.files.back().filename().string();
  EXPECT_TRUE(bag.missing.empty());
  EXPECT_EQ(incomplete_without(last.c_str()), last + " is missing");
  const TemporaryFolder empty;
  std::filesystem::create_directory(empty.path() / "recording");
  std::filesystem::copy_file(folder.path() / "recording/metadata.yaml", empty.path() / "recording/metadata.yaml");
  EXPECT_NE(message_of([&] { const BagRecording none(empty.path()); }).find("recording_0.db3 is missing"),
            std::string::npos);
  overwrite(folder.path() / "recording/metadata.yaml", "{ no: yaml");
  EXPECT_EQ(BagRecording(folder.path()).incomplete_reason(), "");
}

std::string refused_with(const std::filesystem::path& folder, const char* name, const std::filesystem::path& foreign) {
  std::filesystem::copy_file(foreign, folder / "recording" / name, std::filesystem::copy_options::overwrite_existing);
  return message_of([&] { const BagRecording mixed(folder); });
}

TEST(BagRecording, A_file_of_another_flight_is_refused) {
  const TemporaryFolder folder;
  const TemporaryFolder other;
  fly(folder.path(), 200, 2, small_files());
  fly(other.path(), 10, 3);
  EXPECT_NE(refused_with(folder.path(), "recording_1.db3", other.path() / "recording/recording_0.db3")
                .find("recording_1.db3: is of another flight than recording_0.db3"),
            std::string::npos);
  EXPECT_NE(refused_with(folder.path(), "recording_1.db3", folder.path() / "recording/recording_0.db3")
                .find("recording_1.db3: is of another flight than recording_0.db3"),
            std::string::npos)
      << "a file twice";
}

/// Changes the last character of each `text` in the recording's file.
void misspell(const std::filesystem::path& directory, const std::string& text) {
  const std::filesystem::path path = directory / "recording/recording_0.db3";
  std::string file = contents(path);
  std::size_t at = file.find(text);
  ASSERT_NE(at, std::string::npos);
  for (; at != std::string::npos; at = file.find(text)) file[at + text.size() - 1] = '#';
  overwrite(path, file);
}

TEST(BagRecording, Says_where_another_version_wrote_what_cannot_be_read) {
  const TemporaryFolder folder;
  fly(folder.path(), 5, 2);
  misspell(folder.path(), "# Where to look and");
  EXPECT_EQ(message_of([&] { const BagRecording readable(folder.path()); }), "");
  misspell(folder.path(), "pond");
  EXPECT_NE(message_of([&] {
              const BagRecording other(folder.path());
            }).find("another version of this program wrote it: its vigil_msgs/msg/Targets has other fields"),
            std::string::npos);
}

TEST(BagRecording, Files_of_others_are_refused_with_their_name) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "recording");
  EXPECT_NE(message_of([&] { const BagRecording none(folder.path()); }).find("no recording here"), std::string::npos);
  overwrite(folder.path() / "recording/recording_0.db3", "no database at all, but long enough to look like one?");
  EXPECT_NE(message_of([&] {
              const BagRecording other(folder.path());
            }).find("recording_0.db3: file is not a database; it is damaged or no recording: bring it back"),
            std::string::npos);
}

}  // namespace
}  // namespace vigil::recording
