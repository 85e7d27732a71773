#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vigil/adapters/recording/csv_file.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/runtime/recorder.hpp"

namespace vigil::recording {

/// Writes a flight as tables: DIRECTORY/mission.yaml, ticks.csv, drones.csv, targets.csv, events.csv
/// (docs/recording.md). World frame. Same flight, same bytes. One thread at a time.
class CsvRecorder final : public runtime::Recorder {
 public:
  /// `mission_text`: the effective mission file. `keep_every`: only every so manieth tick is kept (and always the first
  /// and the last), with the least clearances and any fallback of those left out. Precondition: keep_every >= 1.
  CsvRecorder(const std::filesystem::path& directory, std::string mission_text, std::uint64_t keep_every = 1);

  /// RecordingError where the folder or a file cannot be created, or is there already.
  void begin(const runtime::Mission& mission, const runtime::FlightStart& start) override;
  void record(const runtime::TickRecord& tick) noexcept override;
  void log(const runtime::LoggedEvent& event) noexcept override;
  void targets(double time_s, const runtime::MissionTargets& targets) noexcept override;
  /// RecordingError where not all was kept.
  void finish() override;

 private:
  /// The newest tick that was left out, in case it is the last.
  struct Skipped {
    swarm::Snapshot snapshot;
    std::vector<runtime::TruthSample> truth;
  };

  void keep(const swarm::Snapshot& snapshot, std::span<const runtime::TruthSample> truth);
  void skip(const runtime::TickRecord& tick);
  void write_tick(const swarm::Snapshot& snapshot);
  void write_drone(double time_s, std::size_t drone, const swarm::DroneSnapshot& snapshot,
                   const runtime::TruthSample* truth);
  void write_holding(const safety::FilterReport& report);
  void write_truth(const runtime::TruthSample* truth);
  void write_targets(double time_s, const runtime::MissionTargets& targets);
  void write_event(const runtime::LoggedEvent& event);
  void close(CsvFile& file) noexcept;
  template <class Write>
  void guarded(const Write& write) noexcept;

  std::filesystem::path folder_;
  std::string mission_text_;
  std::uint64_t keep_every_;
  field::WorldFrame frame_;
  std::vector<std::string> ids_;
  std::vector<std::string> holders_;  ///< the word for each drone in held_by
  CsvFile ticks_;
  CsvFile drones_;
  CsvFile targets_;
  CsvFile events_;

  std::uint64_t seen_ = 0;          ///< ticks given so far
  runtime::Clearances least_;       ///< since the last kept tick
  bool fallback_ = false;           ///< since the last kept tick
  std::optional<Skipped> skipped_;  ///< sized once
  bool has_skipped_ = false;
  double last_time_s_ = 0.0;
  std::string failure_;  ///< the first one; nothing is written after it
};

}  // namespace vigil::recording
