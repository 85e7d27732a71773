#include "vigil/adapters/recording/sqlite.hpp"

#include <sqlite3.h>

#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {
namespace {

constexpr int kWaitForOthersMs = 2000;
/// Of one text or message, whatever a damaged file claims.
constexpr int kMostBytes = 256 << 20U;

/// A file's name as a URI has it.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#')
      uri += fmt::format("%{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      uri.push_back(c);
  }
  return uri;
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Database::Database(const std::filesystem::path& path, Mode mode)
    : path_(path.string()), is_reading_(mode != Mode::kCreate) {
  if (mode == Mode::kCreate) {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, error)))
      throw RecordingError(fmt::format("{}: cannot create it: is there already; choose another folder", path_));
    open(path_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    return;
  }
  open(uri_of(path_), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  // Where a log of changes cannot be looked into for want of the right to write beside it, only the file itself is
  // left.
  if (sqlite3_exec(handle_.get(), "SELECT 1 FROM sqlite_master", nullptr, nullptr, nullptr) == SQLITE_CANTOPEN)
    open(uri_of(path_) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
}

void Database::open(const std::string& name, int flags) {
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (result != SQLITE_OK) fail();
  sqlite3_busy_timeout(handle, kWaitForOthersMs);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kMostBytes);
}

void Database::fail() const {
  const char* reason = handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
  const int code = handle_ ? sqlite3_errcode(handle_.get()) : SQLITE_NOMEM;
  // What a file says that is empty, cut short, or another program's.
  const bool is_no_recording = code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_ERROR;
  const char* hint = is_reading_ && is_no_recording
                         ? "; it is damaged or no recording: bring it back from a copy, or move it away if it does not "
                           "belong here"
                         : "";
  throw RecordingError(fmt::format("{}: {}{}", path_, reason, hint));
}

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::close() {
  sqlite3* const handle = handle_.release();
  if (sqlite3_close(handle) == SQLITE_OK) return;
  handle_.reset(handle);
  fail();
}

Statement::Statement(const Database& database, std::string_view sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v3(database.handle(), sql.data(), static_cast<int>(sql.size()),
                                        SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  statement_.reset(statement);
  expect(result);
}

void Statement::expect(int result) const {
  if (result != SQLITE_OK) database_->fail();
}

void Statement::bind(int number, std::int64_t value) { expect(sqlite3_bind_int64(statement_.get(), number, value)); }

void Statement::bind(int number, std::string_view text) {
  expect(sqlite3_bind_text(statement_.get(), number, text.data(), static_cast<int>(text.size()), SQLITE_STATIC));
}

void Statement::bind(int number, std::span<const char> bytes) {
  expect(sqlite3_bind_blob(statement_.get(), number, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC));
}

bool Statement::step() {
  const int result = sqlite3_step(statement_.get());
  if (result != SQLITE_ROW && result != SQLITE_DONE) database_->fail();
  return result == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  reset();
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::int64_t Statement::number(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string_view Statement::text(int column) const {
  const std::span<const char> all = bytes(column);
  return {all.data(), all.size()};
}

std::span<const char> Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const char*>(data), data == nullptr ? 0 : static_cast<std::size_t>(size)};
}

}  // namespace vigil::recording
