#include "vigil/adapters/recording/bag_recorder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/recording/csv_file.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/own_topics.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/vocabulary.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/least_clearances.hpp"

namespace vigil::recording {

BagRecorder::BagRecorder(const std::filesystem::path& directory, std::string mission_text,
                         const BagRecorderOptions& options)
    : folder_(directory / kFolder), options_(options) {
  assert(options.keep_every >= 1);
  head_.mission_text = std::move(mission_text);
  head_.keep_every = options.keep_every;
}

void BagRecorder::begin(const runtime::Mission& mission, const runtime::FlightStart& start) {
  const bool is_new = !std::filesystem::exists(folder_);
  create_folder(folder_);
  try {
    begin_in_folder(mission, start);
  } catch (...) {
    if (is_new) leave_nothing();
    throw;
  }
}

/// A flight whose recording could not begin can be asked for again, in the same place.
void BagRecorder::leave_nothing() {
  bag_.reset();
  std::error_code error;
  for (const char* name : {"mission.yaml", "metadata.yaml", "metadata.yaml.unfinished", "recording_0.db3",
                           "recording_0.db3-wal", "recording_0.db3-shm", "recording_0.db3-journal"})
    std::filesystem::remove(folder_ / name, error);
  std::filesystem::remove(folder_, error);
  std::filesystem::remove(folder_.parent_path(), error);
}

void BagRecorder::begin_in_folder(const runtime::Mission& mission, const runtime::FlightStart& start) {
  write_text(folder_ / kMissionFile, head_.mission_text);
  head_.parameters = runtime::swarm_parameters(mission, start);
  head_.start = start;
  if (start.past) first_time_s_ = static_cast<double>(start.past->ticks) * head_.parameters.dt_s;
  last_time_s_ = first_time_s_;
  set_time_of_day();
  skipped_.emplace(Skipped{swarm::Snapshot(mission.drones.size()), {}});
  std::vector<Topic> topics = own_topics();
  standard_.emplace(mission, topics.size());
  std::ranges::copy(standard_->topics(), std::back_inserter(topics));
  bag_.emplace(folder_, std::move(topics), options_.bag);
  write_mission();
}

void BagRecorder::set_time_of_day() {
  if (options_.time_of_day) began_ns_ = options_.time_of_day().count();
}

std::int64_t BagRecorder::stamp_ns(double time_s) const {
  constexpr double kNanoseconds = 1e9;
  return began_ns_ + std::llround((time_s - first_time_s_) * kNanoseconds);
}

void BagRecorder::write(std::size_t topic, double time_s) { bag_->write(topic, stamp_ns(time_s), writer_.message()); }

template <class Write>
void BagRecorder::guarded(const Write& write) noexcept {
  if (!failure_.empty()) return;
  try {
    write();
  } catch (const std::exception& problem) {
    failure_ = problem.what();
  }
}

void BagRecorder::record(const runtime::TickRecord& tick) noexcept {
  guarded([&] {
    least_ = least(least_, tick.clearances);
    fallback_ = fallback_ || tick.snapshot.fallback;
    last_time_s_ = tick.snapshot.time_s;
    if (seen_ == 0) set_time_of_day();
    if (seen_++ % options_.keep_every == 0)
      keep(tick);
    else
      skip(tick);
    bag_->commit_much();
  });
}

void BagRecorder::skip(const runtime::TickRecord& tick) {
  skipped_->snapshot = tick.snapshot;
  skipped_->truth.assign(tick.truth.begin(), tick.truth.end());
  has_skipped_ = true;
}

void BagRecorder::keep(const runtime::TickRecord& tick) {
  if (bag_->is_full()) begin_file();
  // Commands stand before their tick: where a recording ends between them, no tick is without its commands.
  if (!tick.commands.empty() && options_.keep_every == 1) {
    write_commands(writer_, tick.snapshot.tick, tick.commands);
    write(kCommandsTopic, tick.snapshot.time_s);
  }
  write_tick_of(tick.snapshot, tick.observations, tick.truth);
}

void BagRecorder::write_tick_of(const swarm::Snapshot& snapshot, std::span<const swarm::DroneObservation> observations,
                                std::span<const runtime::TruthSample> truth) {
  write_tick(writer_, {.snapshot = snapshot,
                       .observations = observations,
                       .truth = truth,
                       .clearances = least_,
                       .fallback = fallback_,
                       .is_thinned = options_.keep_every > 1});
  write(kTickTopic, snapshot.time_s);
  standard_->write_tick(snapshot, stamp_ns(snapshot.time_s), writer_, *bag_);
  ++kept_;
  least_ = {};
  fallback_ = false;
  has_skipped_ = false;
}

/// Every file begins with the mission, so that it can be understood without the ones before it.
void BagRecorder::begin_file() {
  bag_->begin_file();
  write_mission();
}

void BagRecorder::write_mission() {
  write_head(writer_, head_);
  write(kMissionTopic, last_time_s_);
  bag_->commit();
  bag_->write_metadata();
}

void BagRecorder::log(const runtime::LoggedEvent& event) noexcept {
  guarded([&] { write_event_of(event); });
}

void BagRecorder::write_event_of(const runtime::LoggedEvent& event) {
  write_event(writer_, event);
  write(kEventTopic, last_time_s_);
}

void BagRecorder::targets(double time_s, const runtime::MissionTargets& targets) noexcept {
  guarded([&] {
    write_targets(writer_, time_s, targets);
    write(kTargetsTopic, last_time_s_);
    standard_->write_targets(targets, stamp_ns(last_time_s_), writer_, *bag_);
  });
}

void BagRecorder::flush() noexcept {
  guarded([&] { bag_->commit(); });
}

void BagRecorder::finish() {
  guarded([&] {
    if (has_skipped_) write_tick_of(skipped_->snapshot, {}, skipped_->truth);
  });
  // The event that says "finished" is written last, and only where all the rest was kept.
  guarded([&] {
    write_event_of({last_time_s_, std::string(kRecorderSource), std::string(kFinished), "",
                    fmt::format("{} ticks of {}", kept_, seen_)});
  });
  const bool is_whole = failure_.empty();
  try {
    if (bag_) bag_->finish();
  } catch (const std::exception& problem) {
    if (is_whole) failure_ = problem.what();
  }
  if (!failure_.empty()) throw RecordingError(fmt::format("{}; the recording is not complete", failure_));
}

}  // namespace vigil::recording
