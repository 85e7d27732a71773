#include "vigil/adapters/recording/bag_file.hpp"

#include <algorithm>

#include "vigil/adapters/recording/message_definitions.hpp"

namespace vigil::recording {
namespace {

// The distribution tells readers which definitions of standard messages hold; ours are those since Humble.
constexpr const char* kTables = R"sql(
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
  offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema(schema_version, ros_distro) VALUES (4, 'humble');
)sql";

}  // namespace

BagFile::BagFile(const std::filesystem::path& path, const std::vector<Topic>& topics, bool must_survive_power)
    : database_(path, Database::Mode::kCreate), facts_{.name = path.filename().string(), .messages = {}} {
  facts_.messages.assign(topics.size(), 0);
  database_.run("PRAGMA journal_mode=WAL");
  database_.run(must_survive_power ? "PRAGMA synchronous=NORMAL" : "PRAGMA synchronous=OFF");
  database_.run("BEGIN");
  database_.run(kTables);
  add_topics(topics);
  database_.run("COMMIT");
  insert_.emplace(database_, "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)");
}

void BagFile::add_topics(const std::vector<Topic>& topics) {
  Statement topic(database_, "INSERT INTO topics VALUES (?, ?, ?, 'cdr', '', '')");
  Statement definition(database_,
                       "INSERT INTO message_definitions (topic_type, encoding, encoded_message_definition, "
                       "type_description_hash) VALUES (?, 'ros2msg', ?, '')");
  std::vector<std::string> defined;
  for (std::size_t n = 0; n < topics.size(); ++n) {
    topic.bind(1, static_cast<std::int64_t>(n) + 1);
    topic.bind(2, std::string_view(topics[n].name));
    topic.bind(3, std::string_view(topics[n].type));
    topic.run();
    if (std::ranges::find(defined, topics[n].type) != defined.end()) continue;
    defined.push_back(topics[n].type);
    const std::string text = whole_definition(topics[n].type);
    definition.bind(1, std::string_view(topics[n].type));
    definition.bind(2, std::string_view(text));
    definition.run();
  }
}

void BagFile::write(std::size_t topic, std::int64_t stamp_ns, std::span<const char> message) {
  if (!is_in_transaction_) database_.run("BEGIN");
  is_in_transaction_ = true;
  insert_->bind(1, static_cast<std::int64_t>(topic));
  insert_->bind(2, stamp_ns);
  insert_->bind(3, message);
  insert_->run();
  if (facts_.message_count++ == 0) facts_.first_ns = stamp_ns;
  facts_.last_ns = std::max(facts_.last_ns, stamp_ns);
  ++facts_.messages[topic - 1];
  bytes_ += message.size();
  uncommitted_bytes_ += message.size();
}

void BagFile::commit() {
  if (!is_in_transaction_) return;
  database_.run("COMMIT");
  is_in_transaction_ = false;
  uncommitted_bytes_ = 0;
}

void BagFile::close() {
  commit();
  insert_.reset();
  database_.run("PRAGMA wal_checkpoint(TRUNCATE)");
  database_.run("PRAGMA journal_mode=DELETE");
  database_.close();
}

}  // namespace vigil::recording
