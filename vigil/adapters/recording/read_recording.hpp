#pragma once

#include <cstdint>
#include <filesystem>

#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::recording {

/// How much is read at most.
struct ReadLimits {
  std::uintmax_t file_bytes = std::uintmax_t{2} << 30;
};

/// Reads what CsvRecorder wrote to DIRECTORY/recording/. A recording that was cut off, also in the middle of a line, is
/// read up to its last complete tick and says so. RecordingError with file, line, value and advice for anything else,
/// also where there is not one complete tick; other bytes than a recording's never do more than that.
[[nodiscard]] runtime::RecordedFlight read_recording(const std::filesystem::path& directory,
                                                     const ReadLimits& limits = {});

}  // namespace vigil::recording
