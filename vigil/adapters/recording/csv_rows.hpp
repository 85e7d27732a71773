#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::recording {

/// The whole of a regular file of at most max_bytes; RecordingError otherwise.
[[nodiscard]] std::string read_text(const std::filesystem::path& path, std::uintmax_t max_bytes);

/// Goes through a file of comma-separated rows (RFC 4180) with a known header. Strict, but for the end: a last line
/// without its line end was cut off, is not returned, and was_cut() is true then. RecordingError with place, value and
/// advice for anything else.
class CsvRows {
 public:
  CsvRows(const std::filesystem::path& path, std::string_view header, std::uintmax_t max_bytes);

  /// Goes to the next row; false at the end. Texts of earlier rows end with it.
  [[nodiscard]] bool next();
  [[nodiscard]] bool was_cut() const { return was_cut_; }
  /// The name and line of the row that next() went to.
  [[nodiscard]] std::string place() const;

  // The cells of the row, by column counted from 0.
  [[nodiscard]] std::string_view text(std::size_t column) const { return cells_[column]; }
  [[nodiscard]] double number(std::size_t column) const;
  [[nodiscard]] double number_or(std::size_t column, double missing) const;
  [[nodiscard]] std::uint64_t count(std::size_t column) const;
  [[nodiscard]] bool flag(std::size_t column) const;
  [[noreturn]] void refuse(std::size_t column, std::string_view expected) const;

 private:
  [[nodiscard]] bool split_row();
  [[nodiscard]] bool split_quoted(std::size_t& at);
  [[noreturn]] void damaged(const std::string& what) const;

  std::string name_;
  std::string content_;
  std::vector<std::string> columns_;
  std::size_t at_ = 0;         ///< where the next row begins
  std::size_t line_ = 0;       ///< of this row
  std::size_t next_line_ = 1;  ///< of the next row; quoted cells may hold line ends
  bool was_cut_ = false;
  std::vector<std::string_view> cells_;
  std::deque<std::string> unquoted_;  ///< cells with doubled quotes, of this row
};

}  // namespace vigil::recording
