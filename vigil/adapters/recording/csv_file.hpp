#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace vigil::recording {

/// A text file of comma-separated rows (RFC 4180 quoting, lines end in \n), written in large pieces. The first error of
/// the file system is remembered, later rows are dropped, and close() reports it. No allocation once the first piece is
/// full.
class CsvFile {
 public:
  CsvFile() = default;
  /// Creates the file, which must not exist. RecordingError where that fails.
  explicit CsvFile(const std::filesystem::path& path) : CsvFile(path, kCreate) {}
  /// Writes to a file or device that exists.
  [[nodiscard]] static CsvFile opened(const std::filesystem::path& path) { return CsvFile(path, 0); }
  CsvFile(CsvFile&& other) noexcept;
  CsvFile& operator=(CsvFile&& other) noexcept;
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  ~CsvFile();

  /// Shortest digits that read back as the same number; an empty cell where it is not finite.
  void cell(double value);
  void cell(std::uint64_t value);
  /// Text, quoted where needed.
  void cell(std::string_view text);
  /// Two pieces of text that need no quotes, joined.
  void plain_cell(std::string_view prefix, std::string_view text);
  void empty_cell() { separate(); }
  void end_row();
  /// Text as it is, outside any row.
  void raw(std::string_view text);

  /// Hands what was given so far to the system, so that it outlives this program.
  void flush() { write_out(); }

  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  /// Writes what is left. True where all that was given is in the file.
  [[nodiscard]] bool close();
  /// Path and reason of the first error; empty where there is none.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  static const int kCreate;  ///< flags of open(2)
  CsvFile(const std::filesystem::path& path, int flags);

  void separate();
  void write_out();
  void fail(const char* doing, int number);

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool row_begun_ = false;
  std::uint64_t rows_ = 0;
  fmt::memory_buffer buffer_;
  std::string error_;
};

/// Creates a folder, and those around it. RecordingError where that fails.
void create_folder(const std::filesystem::path& folder);
/// Writes a whole text file, which must not exist. RecordingError where that fails.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace vigil::recording
