#pragma once

#include <filesystem>

namespace vigil::apps {

/// What `vigil replay` is asked to do.
struct ReplayOptions {
  std::filesystem::path directory;  ///< that simulate or serve --record wrote
  bool verify = false;
  bool json = false;
};

/// `vigil replay --verify`: recomputes every tick of a recording and compares what it decided, bit for bit. kDone where
/// all of it is the same, kCheckFailed at the first difference, or where the recording cannot be recomputed to its end.
/// Throws Failure, RecordingError, MissionError.
[[nodiscard]] int replay(const ReplayOptions& options);

}  // namespace vigil::apps
