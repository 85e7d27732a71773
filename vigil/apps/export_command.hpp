#pragma once

#include <filesystem>

namespace vigil::apps {

/// What `vigil export` is asked to do.
struct ExportOptions {
  std::filesystem::path directory;  ///< that simulate or serve --record wrote
  std::filesystem::path out;        ///< must not exist
  double track_step_s = 1.0;        ///< between the points of a track; positive
};

/// `vigil export`: writes a recording as tables that spreadsheets open, and, where its mission has a datum, as maps
/// (tracks.geojson, tracks.kml). Exit code kDone, or it throws: Failure, RecordingError, MissionError.
[[nodiscard]] int export_recording(const ExportOptions& options);

}  // namespace vigil::apps
