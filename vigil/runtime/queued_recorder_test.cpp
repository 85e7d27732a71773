#include "vigil/runtime/queued_recorder.hpp"

#include <condition_variable>
#include <mutex>

#include <gtest/gtest.h>

#include "vigil/runtime/live_world_for_tests.hpp"

namespace vigil::runtime {
namespace {

/// What a disk has kept; a closed gate is a disk that hangs.
struct Kept {
  std::mutex mutex;
  std::condition_variable opened;
  bool is_open = true;
  std::vector<std::uint64_t> ticks;
  std::vector<std::string> events;
  std::vector<double> targets_s;  ///< from when on each list holds
  int finished = 0;

  void open() {
    const std::lock_guard lock(mutex);
    is_open = true;
    opened.notify_all();
  }
};

class GatedRecorder final : public Recorder {
 public:
  explicit GatedRecorder(Kept& kept) : kept_(kept) {}
  void begin(const Mission&, const FlightStart&) override {}
  void record(const TickRecord& tick) noexcept override {
    std::unique_lock lock(kept_.mutex);
    kept_.opened.wait(lock, [this] { return kept_.is_open; });
    kept_.ticks.push_back(tick.snapshot.tick);
  }
  void log(const LoggedEvent& event) noexcept override {
    const std::lock_guard lock(kept_.mutex);
    kept_.events.push_back(event.what);
  }
  void targets(double time_s, const MissionTargets&) noexcept override {
    log({0.0, "", "targets", "", ""});
    kept_.targets_s.push_back(time_s);
  }
  void finish() override { ++kept_.finished; }

 private:
  Kept& kept_;
};

void record_ticks(QueuedRecorder& recorder, std::uint64_t from, std::uint64_t to) {
  swarm::Snapshot snapshot(3);
  for (snapshot.tick = from; snapshot.tick < to; ++snapshot.tick) recorder.record({snapshot, {}, {}, {}, {}});
}

TEST(QueuedRecorderTest, Everything_arrives_in_order) {
  Kept kept;
  QueuedRecorder recorder(std::make_unique<GatedRecorder>(kept), small_mission(), {});
  record_ticks(recorder, 0, 500);
  recorder.log({1.0, "operator", "land", "a", ""});
  recorder.targets(2.0, {});
  recorder.finish();
  ASSERT_EQ(kept.ticks.size(), 500U);
  for (std::uint64_t n = 0; n < 500; ++n) EXPECT_EQ(kept.ticks[n], n);
  EXPECT_EQ(kept.events, (std::vector<std::string>{"land", "targets"}));
  EXPECT_EQ(kept.finished, 1);
  EXPECT_EQ(recorder.lost_ticks(), 0U);
}

/// A tick that is given a new importance map.
void record_retargeted(QueuedRecorder& recorder, std::uint64_t tick,
                       const std::shared_ptr<const swarm::CoverageTarget>& target) {
  swarm::Snapshot snapshot(3);
  snapshot.tick = tick;
  snapshot.time_s = 0.02 * static_cast<double>(tick);
  const swarm::Command command{.kind = swarm::CommandKind::kSetTarget, .drone = {}, .target = target};
  recorder.record({snapshot, {}, std::span(&command, 1), {}, {}});
}

TEST(QueuedRecorderTest, Targets_hold_from_the_tick_on_that_was_given_their_map) {
  Kept kept;
  QueuedRecorder recorder(std::make_unique<GatedRecorder>(kept), small_mission(), {});
  const auto first = std::make_shared<const swarm::CoverageTarget>();
  const auto second = std::make_shared<const swarm::CoverageTarget>();
  const auto never_given = std::make_shared<const swarm::CoverageTarget>();
  recorder.expect(first, {});
  record_retargeted(recorder, 0, first);
  recorder.expect(never_given, {});
  recorder.expect(second, {});
  record_ticks(recorder, 1, 63);
  record_retargeted(recorder, 63, second);
  record_ticks(recorder, 64, 70);
  recorder.finish();
  EXPECT_EQ(kept.targets_s, (std::vector<double>{0.0, 63 * 0.02}));
}

/// Takes so many ticks, and then no more.
class FullRecorder final : public Recorder {
 public:
  explicit FullRecorder(std::uint64_t room) : room_(room) {}
  void begin(const Mission&, const FlightStart&) override {}
  void record(const TickRecord&) noexcept override { is_full_ = ++seen_ > room_; }
  void log(const LoggedEvent&) noexcept override {}
  void targets(double, const MissionTargets&) noexcept override {}
  [[nodiscard]] std::string trouble() const override { return is_full_ ? "the disk is full" : ""; }
  void finish() override {
    if (is_full_) throw std::runtime_error("the disk is full");
  }

 private:
  std::uint64_t room_;
  std::uint64_t seen_ = 0;
  bool is_full_ = false;
};

TEST(QueuedRecorderTest, What_a_full_disk_does_not_take_is_not_counted_as_kept) {
  QueuedRecorder recorder(std::make_unique<FullRecorder>(35), small_mission(), {});
  record_ticks(recorder, 0, 200);
  EXPECT_THROW(recorder.finish(), std::runtime_error);
  EXPECT_EQ(recorder.kept_ticks(), 35U);
  EXPECT_EQ(recorder.lost_ticks(), 0U);
}

TEST(QueuedRecorderTest, A_disk_that_hangs_delays_no_tick_and_what_it_costs_is_counted) {
  Kept kept;
  kept.is_open = false;
  QueuedRecorder recorder(std::make_unique<GatedRecorder>(kept), small_mission(), {});
  record_ticks(recorder, 0, 3000);  // returns, whatever the disk does
  EXPECT_GT(recorder.lost_ticks(), 1000U);
  kept.open();
  EXPECT_THROW(recorder.finish(), std::runtime_error);
  EXPECT_EQ(kept.ticks.size() + recorder.lost_ticks(), 3000U);
  EXPECT_TRUE(std::is_sorted(kept.ticks.begin(), kept.ticks.end()));
  EXPECT_EQ(kept.finished, 1);
}

}  // namespace
}  // namespace vigil::runtime
