#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

/// SQLite, so far as bags need it. Every failure is a RecordingError with the file's name and SQLite's reason.
namespace vigil::recording {

class Database {
 public:
  enum class Mode { kCreate, kRead };

  /// kCreate: the file must not be there. kRead: nothing is changed in the file, also where another program writes to
  /// it, or was ended while it did.
  Database(const std::filesystem::path& path, Mode mode);

  /// Runs statements without results.
  void run(const std::string& sql);
  /// Gives the file back; what SQLite says where that fails.
  void close();
  [[nodiscard]] sqlite3* handle() const { return handle_.get(); }
  [[noreturn]] void fail() const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  void open(const std::string& name, int flags);

  std::string path_;
  bool is_reading_ = false;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. The database outlives it.
class Statement {
 public:
  Statement(const Database& database, std::string_view sql);

  /// Of parameter `number`, counted from 1; valid until it is bound anew. Bytes and texts outlive the next step().
  void bind(int number, std::int64_t value);
  void bind(int number, std::string_view text);
  void bind(int number, std::span<const char> bytes);
  /// To the next row; false at the end.
  [[nodiscard]] bool step();
  /// Runs a statement without rows, and makes it ready to run again.
  void run();
  /// Before it is run again with other values.
  void reset();

  // Of the row, by column counted from 0; valid until the next step().
  [[nodiscard]] std::int64_t number(int column) const;
  [[nodiscard]] std::string_view text(int column) const;
  [[nodiscard]] std::span<const char> bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void expect(int result) const;

  const Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace vigil::recording
