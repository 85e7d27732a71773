#pragma once

#include <filesystem>
#include <memory>

#include "vigil/runtime/flight_recording.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::apps {

/// A recording, and the mission that it began with.
struct ChosenRecording {
  std::unique_ptr<runtime::FlightRecording> recording;
  runtime::Mission mission;
};

/// The recording in a directory that `vigil simulate --out` or `vigil serve --record` wrote. Throws Failure (kBadInput)
/// where there is none, RecordingError, MissionError.
[[nodiscard]] ChosenRecording choose_recording(const std::filesystem::path& directory);

}  // namespace vigil::apps
