#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vigil/adapters/recording/bag_writer.hpp"
#include "vigil/adapters/recording/cdr_writer.hpp"
#include "vigil/adapters/recording/standard_topics.hpp"
#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/recorder.hpp"

namespace vigil::recording {

/// What is written of a flight.
struct BagRecorderOptions {
  /// Only every so manieth tick is kept (and always the first and the last), with the least clearances and any fallback
  /// of those left out. Above 1 nothing can be recomputed from the recording. At least 1.
  std::uint64_t keep_every = 1;
  /// Time since 1970, in a live flight: asked when it begins, and at its first tick. None: a simulated flight begins at
  /// 0.
  std::function<std::chrono::nanoseconds()> time_of_day{};
  BagOptions bag{};
};

/// Writes DIRECTORY/recording/, a rosbag2 directory with mission.yaml beside it (docs/recording.md): all that the ticks
/// were given and decided, bit for bit. Same flight, same bytes. One thread at a time.
class BagRecorder final : public runtime::Recorder {
 public:
  /// `mission_text`: the effective mission file.
  BagRecorder(const std::filesystem::path& directory, std::string mission_text, const BagRecorderOptions& options = {});

  /// RecordingError where the folder or a file cannot be created, or is there already.
  void begin(const runtime::Mission& mission, const runtime::FlightStart& start) override;
  void record(const runtime::TickRecord& tick) noexcept override;
  void log(const runtime::LoggedEvent& event) noexcept override;
  void targets(double time_s, const runtime::MissionTargets& targets) noexcept override;
  void flush() noexcept override;
  [[nodiscard]] std::string trouble() const override { return failure_; }
  /// RecordingError where not all was kept.
  void finish() override;

 private:
  /// The newest tick that was left out, in case it is the last.
  struct Skipped {
    swarm::Snapshot snapshot;
    std::vector<runtime::TruthSample> truth;
  };

  void keep(const runtime::TickRecord& tick);
  void skip(const runtime::TickRecord& tick);
  void write_tick_of(const swarm::Snapshot& snapshot, std::span<const swarm::DroneObservation> observations,
                     std::span<const runtime::TruthSample> truth);
  void write(std::size_t topic, double time_s);
  void write_event_of(const runtime::LoggedEvent& event);
  void begin_in_folder(const runtime::Mission& mission, const runtime::FlightStart& start);
  void leave_nothing();
  void begin_file();
  void write_mission();
  void set_time_of_day();
  [[nodiscard]] std::int64_t stamp_ns(double time_s) const;
  template <class Write>
  void guarded(const Write& write) noexcept;

  std::filesystem::path folder_;
  BagRecorderOptions options_;
  runtime::RecordingHead head_;
  std::int64_t began_ns_ = 0;
  double first_time_s_ = 0.0;
  double last_time_s_ = 0.0;
  CdrWriter writer_;
  std::optional<StandardTopics> standard_;
  std::optional<BagWriter> bag_;

  std::uint64_t seen_ = 0;          ///< ticks given so far
  std::uint64_t kept_ = 0;          ///< of them written
  runtime::Clearances least_;       ///< since the last kept tick
  bool fallback_ = false;           ///< since the last kept tick
  std::optional<Skipped> skipped_;  ///< sized once
  bool has_skipped_ = false;
  std::string failure_;  ///< the first one; nothing is written after it
};

}  // namespace vigil::recording
