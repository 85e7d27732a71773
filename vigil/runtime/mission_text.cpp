#include "vigil/runtime/mission_text.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "vigil/runtime/mission_error.hpp"

namespace vigil::runtime {
namespace {

constexpr std::string_view kStartFrom = "start from missions/paper.yaml; docs/mission-file.md lists every key";

/// An open file that closes itself.
class Descriptor {
 public:
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait.
  explicit Descriptor(const std::filesystem::path& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void refuse_file(const std::filesystem::path& path, std::string problem, std::string advice) {
  throw MissionError({.place = path.string(),
                      .key = "",
                      .value = "",
                      .problem = std::move(problem),
                      .valid = fmt::format("must be a text file of at most {} bytes", kMostMissionBytes),
                      .advice = std::move(advice)});
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

void require_small_regular_file(const Descriptor& file, const std::filesystem::path& path) {
  struct stat status{};
  if (::fstat(file.number(), &status) != 0) refuse_file(path, "cannot be read: " + reason(errno), "give another file");
  if (S_ISDIR(status.st_mode)) refuse_file(path, "is a directory", "give the path of a mission file in it");
  if (!S_ISREG(status.st_mode)) refuse_file(path, "is not a regular file", "copy the mission into a file first");
  if (status.st_size > static_cast<off_t>(kMostMissionBytes)) {
    refuse_file(path, fmt::format("has {} bytes", status.st_size),
                "is this a mission file? use drone_grid for many drones");
  }
}

/// The number of bytes of the UTF-8 character that starts at text[i], or 0 where none does.
std::size_t character_bytes(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[i + n]); };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return 1;
  const std::size_t bytes = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || i + bytes > text.size()) return 0;
  for (std::size_t n = 1; n < bytes; ++n) {
    if ((byte(n) & 0xC0U) != 0x80U) return 0;
  }
  // Longer than necessary, a surrogate, or above U+10FFFF: the second byte tells.
  const unsigned second = byte(1);
  const bool is_bad = (lead == 0xE0U && second < 0xA0U) || (lead == 0xEDU && second >= 0xA0U) ||
                      (lead == 0xF0U && second < 0x90U) || (lead == 0xF4U && second >= 0x90U);
  return is_bad ? 0 : bytes;
}

/// Where a walk over the text is, counted as an editor does.
struct Cursor {
  std::size_t line = 1;
  std::size_t column = 1;
  bool is_indentation = true;
  bool has_tab = false;

  void step(char character) {
    if (character == '\n') {
      *this = Cursor{.line = line + 1, .column = 1, .is_indentation = true, .has_tab = false};
      return;
    }
    ++column;
    is_indentation = is_indentation && (character == ' ' || character == '\t');
    has_tab = has_tab || (is_indentation && character == '\t');
  }
};

[[noreturn]] void refuse_character(const std::string& name, const Cursor& at, std::string problem, std::string advice) {
  throw MissionError({.place = fmt::format("{}:{}:{}", name, at.line, at.column),
                      .key = "",
                      .value = "",
                      .problem = std::move(problem),
                      .valid = "must be UTF-8 text, indented with spaces",
                      .advice = std::move(advice)});
}

void require_character(std::string_view text, std::size_t i, std::size_t bytes, const Cursor& at,
                       const std::string& name) {
  if (bytes == 0) refuse_character(name, at, "is not UTF-8 text", "save the mission as UTF-8");
  const char character = text[i];
  const bool is_blank = character == ' ' || character == '\t' || character == '\n' || character == '\r';
  const bool is_control = static_cast<unsigned char>(character) < 0x20U || character == '\x7F';
  if (is_control && !is_blank) {
    refuse_character(name, at, fmt::format("has the control character 0x{:02x}", static_cast<unsigned char>(character)),
                     "is this a mission file? save it as plain text");
  }
  if (at.is_indentation && at.has_tab && !is_blank && character != '#') {
    refuse_character(name, at, "has a tab in its indentation", "indent with spaces");
  }
}

}  // namespace

std::string read_mission_text(const std::filesystem::path& path) {
  const Descriptor file(path);
  if (file.number() < 0) refuse_file(path, "cannot be opened: " + reason(errno), "check the path and its permissions");
  require_small_regular_file(file, path);
  std::string text;
  std::array<char, 65536> block{};
  // A file may grow while it is read: never more than one block beyond the limit.
  while (text.size() <= kMostMissionBytes) {
    const ssize_t count = ::read(file.number(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_file(path, "cannot be read: " + reason(errno), "check the file and its disk");
    if (count == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  refuse_file(path, "grew while it was read", "wait until it is complete");
}

void require_plain_text(std::string_view text, const std::string& name) {
  if (text.size() > kMostMissionBytes) {
    refuse_file(name, fmt::format("has {} bytes", text.size()), std::string(kStartFrom));
  }
  Cursor at;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = character_bytes(text, i);
    require_character(text, i, bytes, at, name);
    at.step(text[i]);
    i += bytes;
  }
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace vigil::runtime
