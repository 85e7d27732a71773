#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "vigil/adapters/recording/bag_file.hpp"

namespace vigil::recording {

/// How a bag is kept.
struct BagOptions {
  std::uint64_t split_bytes = std::uint64_t{2} << 30U;  ///< a new file is begun when one has grown to this; 0: never
  std::uint64_t keep_free_bytes = std::uint64_t{256} << 20U;  ///< writing ends where less is left on the disk
  /// What was committed survives a power cut, too: for flights that cannot be flown again.
  bool must_survive_power = false;
};

/// A rosbag2 directory while it is written: files recording_0.db3, recording_1.db3, ... and metadata.yaml, which is
/// there once write_metadata() was called, so that what was cut off can be opened as well. Failures are
/// RecordingErrors.
class BagWriter {
 public:
  /// Creates the first file. The folder is there.
  BagWriter(std::filesystem::path folder, std::vector<Topic> topics, const BagOptions& options);

  /// Messages of each topic in the order of time.
  void write(std::size_t topic, std::int64_t stamp_ns, std::span<const char> message);
  /// Whether the file has grown to its size: begin_file() is due.
  [[nodiscard]] bool is_full() const;
  void begin_file();
  /// Tells others of the bag's files: when a file's first message was committed.
  void write_metadata() const;
  /// Makes what was written survive this program. RecordingError where the disk has less room than is to be left.
  void commit();
  /// Where much has piled up since the last time.
  void commit_much();
  /// Ends the bag.
  void finish();

 private:
  [[nodiscard]] std::filesystem::path next_name() const;
  void leave_room() const;

  std::filesystem::path folder_;
  std::vector<Topic> topics_;
  BagOptions options_;
  std::vector<BagFileFacts> finished_;
  std::optional<BagFile> file_;
};

}  // namespace vigil::recording
