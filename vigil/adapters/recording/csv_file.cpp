#include "vigil/adapters/recording/csv_file.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

#include <fmt/compile.h>

#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::size_t kLongestRow = std::size_t{1} << 12;  // longer ones cost one more allocation, no more

bool needs_quotes(std::string_view text) { return text.find_first_of(",\"\r\n") != std::string_view::npos; }

}  // namespace

const int CsvFile::kCreate = O_CREAT | O_EXCL;

CsvFile::CsvFile(const std::filesystem::path& path, int flags) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (descriptor_ < 0) {
    throw RecordingError(
        fmt::format("{}: cannot create it: {}; choose another folder", path.string(), std::strerror(errno)));
  }
  buffer_.reserve(kPiece + kLongestRow);
}

CsvFile::CsvFile(CsvFile&& other) noexcept { *this = std::move(other); }

CsvFile& CsvFile::operator=(CsvFile&& other) noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  path_ = std::move(other.path_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  row_begun_ = std::exchange(other.row_begun_, false);
  rows_ = std::exchange(other.rows_, 0);
  buffer_ = std::move(other.buffer_);
  error_ = std::move(other.error_);
  return *this;
}

CsvFile::~CsvFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void CsvFile::separate() {
  if (row_begun_) buffer_.push_back(',');
  row_begun_ = true;
}

void CsvFile::cell(double value) {
  separate();
  if (std::isfinite(value)) fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
}

void CsvFile::cell(std::uint64_t value) {
  separate();
  fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
}

void CsvFile::cell(std::string_view text) {
  separate();
  if (!needs_quotes(text)) return raw(text);
  buffer_.push_back('"');
  for (const char c : text) {
    if (c == '"') buffer_.push_back('"');
    buffer_.push_back(c);
  }
  buffer_.push_back('"');
}

void CsvFile::plain_cell(std::string_view prefix, std::string_view text) {
  separate();
  raw(prefix);
  raw(text);
}

void CsvFile::raw(std::string_view text) { buffer_.append(text.data(), text.data() + text.size()); }

void CsvFile::end_row() {
  buffer_.push_back('\n');
  row_begun_ = false;
  ++rows_;
  if (buffer_.size() >= kPiece) write_out();
}

void CsvFile::write_out() {
  const char* next = buffer_.data();
  std::size_t left = error_.empty() ? buffer_.size() : 0;
  while (left > 0) {
    const ssize_t written = ::write(descriptor_, next, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      fail("write", errno);
      break;
    }
    next += written;
    left -= static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

bool CsvFile::close() {
  if (descriptor_ < 0) return error_.empty();
  write_out();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("close", errno);
  return error_.empty();
}

void CsvFile::fail(const char* doing, int number) {
  if (error_.empty()) error_ = fmt::format("{}: cannot {} it: {}", path_.string(), doing, std::strerror(number));
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw RecordingError(
        fmt::format("{}: cannot create the folder: {}; choose another folder", folder.string(), error.message()));
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  CsvFile file(path);
  file.raw(text);
  if (!file.close()) throw RecordingError(file.error());
}

}  // namespace vigil::recording
