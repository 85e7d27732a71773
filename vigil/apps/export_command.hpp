#pragma once

#include <filesystem>

namespace vigil::apps {

/// What `vigil export` is asked to do.
struct ExportOptions {
  std::filesystem::path directory;  ///< that simulate or serve --record wrote
  std::filesystem::path out;        ///< must not exist
};

/// `vigil export`: writes a recording as tables that spreadsheets open. Exit code kDone, or it throws: Failure,
/// RecordingError, MissionError.
[[nodiscard]] int export_tables(const ExportOptions& options);

}  // namespace vigil::apps
