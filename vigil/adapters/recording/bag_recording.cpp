#include "vigil/adapters/recording/bag_recording.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "vigil/adapters/recording/bag_folder.hpp"
#include "vigil/adapters/recording/message_definitions.hpp"
#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/own_topics.hpp"
#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/vocabulary.hpp"

namespace vigil::recording {
namespace {

namespace fs = std::filesystem;

/// Why messages may be unreadable: the definition that the bag has of one is not the one that is read here. Empty where
/// all are the same, or the bag has none.
std::string other_version_in_words(const Database& database, const std::vector<Topic>& own) {
  Statement has_definitions(database, "SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'");
  if (!has_definitions.step()) return {};
  Statement select(database, "SELECT encoded_message_definition FROM message_definitions WHERE topic_type = ?");
  for (const Topic& topic : own) {
    select.bind(1, std::string_view(topic.type));
    const bool differs = select.step() && select.text(0) != whole_definition(topic.type);
    select.reset();
    if (differs) return fmt::format("; another version of this program wrote it: its {} has other fields", topic.type);
  }
  return {};
}

/// "recording_1.db3 and recording_2.db3 are missing"
std::string missing_in_words(const std::vector<std::string>& names) {
  if (names.size() == 1) return names.front() + " is missing";
  if (names.size() == 2) return fmt::format("{} and {} are missing", names.front(), names.back());
  return fmt::format("{} files from {} to {} are missing", names.size(), names.front(), names.back());
}

}  // namespace

BagRecording::BagRecording(const fs::path& directory) {
  const BagFolder folder = look_into(directory / kFolder);
  for (const fs::path& path : folder.files) open_file(path);
  for (std::uint32_t n = 0; n < files_.size(); ++n) look_through(n);
  if (!has_head_)
    throw RecordingError(
        fmt::format("{}: the mission's message is missing; it ended before it began", files_.front().path));
  say_why_incomplete(folder.missing);
}

void BagRecording::say_why_incomplete(const std::vector<std::string>& missing_files) {
  std::vector<std::string> reasons;
  if (!missing_files.empty()) reasons.push_back(missing_in_words(missing_files));
  if (!is_finished_ && missing_files.empty())
    reasons.emplace_back("it was not finished: the program was ended, or is still writing");
  if (missing_ticks() > 0)
    reasons.push_back(
        fmt::format("{} of the {} ticks that it kept are not there any more", missing_ticks(), kept_ticks_));
  incomplete_reason_ = fmt::format("{}", fmt::join(reasons, "; "));
}

void BagRecording::open_file(const fs::path& path) {
  File file{.path = path.string(), .database = std::make_unique<Database>(path, Database::Mode::kRead)};
  Statement topics(*file.database, "SELECT id, name FROM topics");
  const std::vector<Topic> own = own_topics();
  while (topics.step()) {
    const std::string_view name = topics.text(1);
    if (name == own[kMissionTopic - 1].name) file.topics.mission = topics.number(0);
    if (name == own[kTickTopic - 1].name) file.topics.tick = topics.number(0);
    if (name == own[kCommandsTopic - 1].name) file.topics.commands = topics.number(0);
    if (name == own[kTargetsTopic - 1].name) file.topics.targets = topics.number(0);
    if (name == own[kEventTopic - 1].name) file.topics.event = topics.number(0);
  }
  if (file.topics.tick == 0)
    throw RecordingError(
        fmt::format("{}: has no topic {}; it is a bag of another program", file.path, own[kTickTopic - 1].name));
  file.select = std::make_unique<Statement>(
      *file.database,
      fmt::format("SELECT topic_id, data FROM messages WHERE id > ? AND id <= ? AND topic_id IN ({}, {}) "
                  "ORDER BY id",
                  file.topics.tick, file.topics.commands));
  file.other_version = other_version_in_words(*file.database, own);
  files_.push_back(std::move(file));
}

/// Where the ticks are, and all that comes now and then.
void BagRecording::look_through(std::uint32_t number) {
  const File& file = files_[number];
  const TopicIds& topics = file.topics;
  Statement all(*file.database,
                fmt::format("SELECT id, topic_id, CASE WHEN topic_id IN ({}, {}, {}) THEN data END, timestamp "
                            "FROM messages WHERE topic_id IN ({}, {}, {}, {}) ORDER BY id",
                            topics.mission, topics.targets, topics.event, topics.tick, topics.mission, topics.targets,
                            topics.event));
  std::int64_t after = 0;
  const std::int64_t before_ns = last_tick_ns_;
  while (all.step()) {
    const std::int64_t id = all.number(0);
    if (all.number(1) != topics.tick) {
      take_note(file, all.number(1), all.bytes(2));
      continue;
    }
    if (ticks_.empty()) head_.began_ns = all.number(3);
    last_tick_ns_ = all.number(3);
    if (after == 0 && last_tick_ns_ <= before_ns) refuse_as_foreign(file);
    ticks_.push_back({number, after, id});
    after = id;
  }
}

void BagRecording::take_note(const File& file, std::int64_t topic, std::span<const char> message) {
  if (topic == file.topics.mission && has_head_ && !std::ranges::equal(message, first_head_)) refuse_as_foreign(file);
  try {
    if (topic == file.topics.mission && !has_head_) take_head(message);
    if (topic == file.topics.targets) targets_.push_back(read_targets(message));
    if (topic == file.topics.event) add_event(read_event(message));
  } catch (const RecordingError& problem) {
    throw RecordingError(fmt::format("{}: {}{}", file.path, problem.what(), file.other_version));
  }
}

/// Every file begins with the same one.
void BagRecording::take_head(std::span<const char> message) {
  head_ = read_head(message);
  first_head_.assign(message.begin(), message.end());
  has_head_ = true;
}

void BagRecording::refuse_as_foreign(const File& file) const {
  throw RecordingError(fmt::format("{}: is of another flight than {}; take it away", file.path,
                                   fs::path(files_.front().path).filename().string()));
}

/// Events are told a little after their time, and not always in their order.
void BagRecording::add_event(runtime::LoggedEvent event) {
  if (event.source == kRecorderSource && event.what == kFinished) {
    is_finished_ = true;
    (void)std::from_chars(event.detail.data(), event.detail.data() + event.detail.size(), kept_ticks_);
    return;
  }
  const auto later = std::ranges::upper_bound(events_, event.time_s, {}, &runtime::LoggedEvent::time_s);
  events_.insert(later, std::move(event));
}

std::uint64_t BagRecording::missing_ticks() const {
  return is_finished_ ? kept_ticks_ - std::min<std::uint64_t>(kept_ticks_, ticks_.size()) : 0;
}

void BagRecording::read(std::uint64_t number, runtime::RecordedTick& into) {
  const Place& place = ticks_.at(number);
  File& file = files_[place.file];
  try {
    read_messages(file, place, into);
  } catch (const RecordingError& problem) {
    file.select->reset();
    throw RecordingError(fmt::format("{}: tick {} of the recording (message {}): {}{}", file.path, number, place.id,
                                     problem.what(), file.other_version));
  }
}

void BagRecording::read_messages(File& file, const Place& place, runtime::RecordedTick& into) {
  into.commands.clear();
  CommandsRead given;
  Statement& select = *file.select;
  select.bind(1, place.after);
  select.bind(2, place.id);
  while (select.step()) {
    if (select.number(0) == file.topics.commands)
      given = read_commands(select.bytes(1));
    else
      read_tick(select.bytes(1), into);
  }
  select.reset();
  if (given.is_damaged && !into.damage) into.damage = {{}, "the commands that the tick was given"};
  // Commands of a tick that is not there itself are nobody's.
  if (given.tick == into.snapshot.tick) into.commands = std::move(given.commands);
}

}  // namespace vigil::recording
