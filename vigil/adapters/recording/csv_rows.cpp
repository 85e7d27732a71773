#include "vigil/adapters/recording/csv_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {
namespace {

constexpr double kLargest = 1e15;  // more is damage: later arithmetic stays far from overflow

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out;
  for (const char c : text.substr(0, kLongest)) out.push_back(c >= ' ' && c <= '~' ? c : '?');
  return text.size() > kLongest ? out + "..." : out;
}

std::vector<std::string> split(std::string_view header) {
  std::vector<std::string> names;
  while (true) {
    const std::size_t comma = header.find(',');
    names.emplace_back(header.substr(0, comma));
    if (comma == std::string_view::npos) return names;
    header.remove_prefix(comma + 1);
  }
}

}  // namespace

std::string read_text(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  if (!is_file) {
    throw RecordingError(
        fmt::format("{}: no such file; name a folder that `vigil simulate --out` wrote", path.string()));
  }
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes > max_bytes) {
    throw RecordingError(
        fmt::format("{}: {} bytes are more than the {} that are read; record every so manieth tick only", path.string(),
                    bytes, max_bytes));
  }
  std::ifstream file(path, std::ios::binary);
  std::string content(bytes, '\0');
  if (!file.read(content.data(), static_cast<std::streamsize>(bytes))) {
    throw RecordingError(fmt::format("{}: cannot read it; check its permissions", path.string()));
  }
  return content;
}

CsvRows::CsvRows(const std::filesystem::path& path, std::string_view header, std::uintmax_t max_bytes)
    : name_(path.string()), content_(read_text(path, max_bytes)), columns_(split(header)) {
  const std::string_view content = content_;
  const std::size_t end = content.find('\n');
  if (end == std::string_view::npos && header.starts_with(content)) {
    was_cut_ = true;
    at_ = content.size();
    return;
  }
  line_ = 1;
  if (content.substr(0, end) != header) {
    damaged(fmt::format("the header is '{}', expected '{}'", shown(content.substr(0, end)), header));
  }
  at_ = end + 1;
  next_line_ = 2;
}

std::string CsvRows::place() const { return fmt::format("{}:{}", name_, line_); }

void CsvRows::damaged(const std::string& what) const {
  throw RecordingError(fmt::format(
      "{}: {}; the file is damaged here: cut it off before this line to read what comes before", place(), what));
}

void CsvRows::refuse(std::size_t column, std::string_view expected) const {
  damaged(fmt::format("{} is '{}', expected {}", columns_[column], shown(cells_[column]), expected));
}

bool CsvRows::next() {
  line_ = next_line_;
  cells_.clear();
  unquoted_.clear();
  if (at_ == content_.size()) return false;
  if (!split_row()) {
    was_cut_ = true;
    at_ = content_.size();
    return false;
  }
  if (cells_.size() != columns_.size()) {
    damaged(fmt::format("{} cells, expected {}", cells_.size(), columns_.size()));
  }
  return true;
}

// False where the content ends before the row does.
bool CsvRows::split_row() {
  const std::string_view content = content_;
  std::size_t at = at_;
  while (true) {
    if (at < content.size() && content[at] == '"') {
      if (!split_quoted(at)) return false;
    } else {
      const std::size_t end = std::min(content.find_first_of(",\n", at), content.size());
      cells_.push_back(content.substr(at, end - at));
      at = end;
    }
    if (at == content.size()) return false;
    const char separator = content[at++];
    if (separator == '\n') break;
    if (separator != ',') damaged("text after a closing quote");
    if (cells_.size() > columns_.size()) damaged("too many cells");
  }
  ++next_line_;
  at_ = at;
  return true;
}

bool CsvRows::split_quoted(std::size_t& at) {
  std::string& cell = unquoted_.emplace_back();
  for (++at; at < content_.size(); ++at) {
    if (content_[at] == '"') {
      if (at + 1 == content_.size() || content_[at + 1] != '"') {
        ++at;
        cells_.push_back(cell);
        return true;
      }
      ++at;
    }
    if (content_[at] == '\n') ++next_line_;
    cell.push_back(content_[at]);
  }
  return false;
}

double CsvRows::number(std::size_t column) const {
  const std::string_view text = cells_[column];
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= kLargest)) {
    refuse(column, "a number");
  }
  return value;
}

double CsvRows::number_or(std::size_t column, double missing) const {
  return cells_[column].empty() ? missing : number(column);
}

std::uint64_t CsvRows::count(std::size_t column) const {
  const std::string_view text = cells_[column];
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(column, "a whole number, 0 or more");
  return value;
}

bool CsvRows::flag(std::size_t column) const {
  if (cells_[column] != "0" && cells_[column] != "1") refuse(column, "0 or 1");
  return cells_[column] == "1";
}

}  // namespace vigil::recording
