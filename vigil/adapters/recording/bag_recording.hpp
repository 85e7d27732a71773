#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/recording/sqlite.hpp"
#include "vigil/runtime/flight_recording.hpp"

namespace vigil::recording {

/// Reads DIRECTORY/recording/ as BagRecorder writes it: whole, cut off, or still being written (then what was there
/// when it was opened). RecordingError with file and reason for anything else; whatever is in the files, nothing worse.
class BagRecording final : public runtime::FlightRecording {
 public:
  explicit BagRecording(const std::filesystem::path& directory);

  [[nodiscard]] const runtime::RecordingHead& head() const override { return head_; }
  [[nodiscard]] std::uint64_t tick_count() const override { return ticks_.size(); }
  void read(std::uint64_t number, runtime::RecordedTick& into) override;
  [[nodiscard]] std::span<const runtime::RecordedTargets> targets() const override { return targets_; }
  [[nodiscard]] std::span<const runtime::LoggedEvent> events() const override { return events_; }
  [[nodiscard]] std::uint64_t missing_ticks() const override;
  [[nodiscard]] const std::string& incomplete_reason() const override { return incomplete_reason_; }

 private:
  /// Topics have other numbers in bags that another program has written anew.
  struct TopicIds {
    std::int64_t mission = 0;
    std::int64_t tick = 0;
    std::int64_t commands = 0;
    std::int64_t targets = 0;
    std::int64_t event = 0;
  };
  struct File {
    std::string path;
    std::unique_ptr<Database> database;
    TopicIds topics{};
    std::unique_ptr<Statement> select{};
    std::string other_version{};  ///< why it may be unreadable; empty where this program's version wrote it
  };
  /// Where a tick is: its message, and the one of the tick before it in the same file.
  struct Place {
    std::uint32_t file = 0;
    std::int64_t after = 0;
    std::int64_t id = 0;
  };

  void open_file(const std::filesystem::path& path);
  void look_through(std::uint32_t number);
  void take_note(const File& file, std::int64_t topic, std::span<const char> message);
  void take_head(std::span<const char> message);
  [[noreturn]] void refuse_as_foreign(const File& file) const;
  void say_why_incomplete(const std::vector<std::string>& missing_files);
  void add_event(runtime::LoggedEvent event);
  void read_messages(File& file, const Place& place, runtime::RecordedTick& into);

  runtime::RecordingHead head_;
  std::vector<char> first_head_;  ///< its message
  bool has_head_ = false;
  bool is_finished_ = false;
  std::uint64_t kept_ticks_ = 0;  ///< as it says at its end
  std::int64_t last_tick_ns_ = std::numeric_limits<std::int64_t>::min();
  std::vector<File> files_;
  std::vector<Place> ticks_;
  std::vector<runtime::RecordedTargets> targets_;
  std::vector<runtime::LoggedEvent> events_;
  std::string incomplete_reason_;
};

}  // namespace vigil::recording
