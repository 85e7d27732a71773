#include "vigil/adapters/recording/bag_writer.hpp"

#include <algorithm>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMuch = std::uint64_t{4} << 20U;

/// Many files as one.
BagFileFacts sum_of(const std::vector<BagFileFacts>& files, std::size_t topics) {
  BagFileFacts sum;
  sum.messages.assign(topics, 0);
  for (const BagFileFacts& file : files) {
    if (file.message_count == 0) continue;
    sum.first_ns = sum.message_count == 0 ? file.first_ns : std::min(sum.first_ns, file.first_ns);
    sum.message_count += file.message_count;
    sum.last_ns = std::max(sum.last_ns, file.last_ns);
    for (std::size_t n = 0; n < topics; ++n) sum.messages[n] += file.messages[n];
  }
  return sum;
}

std::string in_yaml(const BagFileFacts& facts, std::string_view margin) {
  return fmt::format(
      "{0}duration:\n{0}  nanoseconds: {1}\n{0}starting_time:\n{0}  nanoseconds_since_epoch: {2}\n"
      "{0}message_count: {3}\n",
      margin, facts.last_ns - facts.first_ns, facts.first_ns, facts.message_count);
}

/// Version 5 of rosbag2's metadata, which all distributions since Humble read.
std::string metadata_yaml(const std::vector<BagFileFacts>& files, const std::vector<Topic>& topics) {
  const BagFileFacts sum = sum_of(files, topics.size());
  std::string text = "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n";
  text += in_yaml(sum, "  ") + "  topics_with_message_count:\n";
  for (std::size_t n = 0; n < topics.size(); ++n)
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n"
        "        offered_qos_profiles: \"\"\n      message_count: {}\n",
        topics[n].name, topics[n].type, sum.messages[n]);
  text += "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n";
  for (const BagFileFacts& file : files) text += fmt::format("    - {}\n", file.name);
  text += "  files:\n";
  for (const BagFileFacts& file : files) text += fmt::format("    - path: {}\n", file.name) + in_yaml(file, "      ");
  return text;
}

}  // namespace

BagWriter::BagWriter(fs::path folder, std::vector<Topic> topics, const BagOptions& options)
    : folder_(std::move(folder)), topics_(std::move(topics)), options_(options) {
  begin_file();
}

fs::path BagWriter::next_name() const { return folder_ / fmt::format("recording_{}.db3", finished_.size()); }

void BagWriter::leave_room() const {
  std::error_code error;
  const fs::space_info space = fs::space(folder_, error);
  if (error || space.available >= options_.keep_free_bytes) return;
  throw RecordingError(fmt::format("{}: only {} MiB are left on the disk, and {} MiB are to stay free; make room",
                                   folder_.string(), space.available >> 20U, options_.keep_free_bytes >> 20U));
}

void BagWriter::begin_file() {
  if (file_) {
    file_->close();
    finished_.push_back(file_->facts());
    file_.reset();
  }
  leave_room();
  file_.emplace(next_name(), topics_, options_.must_survive_power);
}

bool BagWriter::is_full() const { return options_.split_bytes > 0 && file_->bytes() >= options_.split_bytes; }

void BagWriter::write(std::size_t topic, std::int64_t stamp_ns, std::span<const char> message) {
  file_->write(topic, stamp_ns, message);
}

void BagWriter::commit() {
  file_->commit();
  leave_room();
}

void BagWriter::commit_much() {
  if (file_->uncommitted_bytes() >= kMuch) commit();
}

void BagWriter::finish() {
  file_->close();
  write_metadata();
}

void BagWriter::write_metadata() const {
  std::vector<BagFileFacts> files = finished_;
  files.push_back(file_->facts());
  const fs::path unfinished = folder_ / "metadata.yaml.unfinished";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out << metadata_yaml(files, topics_) << std::flush;
  std::error_code error;
  if (out) fs::rename(unfinished, folder_ / "metadata.yaml", error);
  if (!out || error)
    throw RecordingError(fmt::format("{}: metadata.yaml cannot be written; make room", folder_.string()));
}

}  // namespace vigil::recording
