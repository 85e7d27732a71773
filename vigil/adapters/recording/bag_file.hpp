#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vigil/adapters/recording/sqlite.hpp"

namespace vigil::recording {

/// What a bag has messages of. Its number in a list of topics, counted from 1, is its id in the file.
struct Topic {
  std::string name;  ///< "/vigil/tick"
  std::string type;  ///< "vigil_msgs/msg/Tick"
};

/// What is in a file, as metadata.yaml tells it.
struct BagFileFacts {
  std::string name;
  std::int64_t first_ns = 0;  ///< of the first message; 0 without one
  std::int64_t last_ns = 0;
  std::uint64_t message_count = 0;
  std::vector<std::uint64_t> messages;  ///< of each topic
};

/// One SQLite file of a rosbag2 directory, while it is written: tables as rosbag2's own storage has them (schema 4).
/// What was committed survives the program's death whenever it comes, by SQLite's write-ahead log.
class BagFile {
 public:
  /// `must_survive_power`: also the machine's, at the cost of waiting for the disk now and then.
  BagFile(const std::filesystem::path& path, const std::vector<Topic>& topics, bool must_survive_power);
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// Precondition: 1 <= topic <= as many as there are.
  void write(std::size_t topic, std::int64_t stamp_ns, std::span<const char> message);
  /// Makes what was written so far survive.
  void commit();
  /// Commits, and leaves one plain file without a log.
  void close();

  [[nodiscard]] const BagFileFacts& facts() const { return facts_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }  ///< of messages, written so far
  [[nodiscard]] std::uint64_t uncommitted_bytes() const { return uncommitted_bytes_; }

 private:
  void add_topics(const std::vector<Topic>& topics);

  Database database_;
  std::optional<Statement> insert_;
  BagFileFacts facts_;
  std::uint64_t bytes_ = 0;
  std::uint64_t uncommitted_bytes_ = 0;
  bool is_in_transaction_ = false;
};

}  // namespace vigil::recording
